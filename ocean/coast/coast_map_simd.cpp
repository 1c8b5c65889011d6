#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/check.h"
#include "ocean/coast/coast_map.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/coast/coast_map_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/elementary-inl.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

using D = hn::CappedTag<float, kMapGroup>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;

HWY_INLINE V LoadUnsigned(const std::uint16_t* from) {
  const hn::Rebind<std::uint16_t, D> d16;
  return hn::ConvertTo(D(), hn::PromoteTo(DI(), hn::LoadU(d16, from)));
}

HWY_INLINE V LoadSigned(const std::uint16_t* from) {
  const hn::Rebind<std::int16_t, D> d16;
  const auto* bytes = reinterpret_cast<const std::int16_t*>(from);
  return hn::ConvertTo(D(), hn::PromoteTo(DI(), hn::LoadU(d16, bytes)));
}

// Slopes in units of CoastMap::slope_unit, and the sum of the trains' foam.
struct Sum {
  V slope_x, slope_y, foam;
};

// Adds a train's waves; `wave` as in CoastMap, time in 2^-16 cycles.
HWY_INLINE void AddTrain(const std::uint16_t* wave, std::int32_t time_fx16, Sum& sum) {
  const D d;
  const DI di;
  const hn::Rebind<std::uint16_t, D> d16;
  const auto theta = hn::PromoteTo(di, hn::LoadU(d16, wave));
  const auto turns = (theta - time_fx16) & 0xFFFF;
  const V u = hn::ConvertTo(d, turns) * (1.0f / 65536.0f);
  // The profile's derivative: that of cos(2 pi u) in deep water, of 8 (u - 1/2)^2 - 1 at the shore.
  V sine, cosine_unused;
  swell::HWY_NAMESPACE::SinCosTurns(d, u, sine, cosine_unused);
  const V deep = sine * -6.2831853f;
  const V shore = MulAdd(u, 16.0f, -8.0f);
  const V part = LoadUnsigned(wave + 3 * kMapGroup) * (1.0f / 65536.0f);
  const V rate = MulAdd(part, shore - deep, deep);
  sum.slope_x = MulAdd(rate, LoadSigned(wave + kMapGroup), sum.slope_x);
  sum.slope_y = MulAdd(rate, LoadSigned(wave + 2 * kMapGroup), sum.slope_y);
  // Before the crest, and behind it.
  const V before = NegMulAdd(u, 12.0f, 1.0f);
  sum.foam = sum.foam + Max(u * u * u, before);
}

// The points from `first` of one group, as many as a vector has.
HWY_INLINE void BakePacket(const CoastMap& map, std::size_t group, std::size_t first,
                           const std::int32_t* time_fx16, float* slope_x, float* slope_y,
                           float* foam) {
  const D d;
  const std::size_t trains = map.period_s.size();
  const std::uint16_t* wave = map.wave.data() + group * trains * 4 * kMapGroup + first;
  Sum sum = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (std::size_t i = 0; i < trains; ++i) AddTrain(wave + 4 * kMapGroup * i, time_fx16[i], sum);
  const std::size_t at = group * kMapGroup + first;
  const V unit = hn::Set(d, map.slope_unit);
  hn::StoreU(sum.slope_x * unit, d, slope_x + at);
  hn::StoreU(sum.slope_y * unit, d, slope_y + at);
  const V mean = sum.foam * (1.0f / static_cast<float>(trains));
  const V stretched = MulAdd(mean, kFoamGain, kFoamBias);
  const V amount = Min(Max(stretched, 0.0f), 1.0f);
  const V surf = LoadUnsigned(map.surf.data() + at) * (1.0f / 65536.0f);
  hn::StoreU(amount * surf, d, foam + at);
}

void BakeRow(const CoastMap& map, std::size_t row, const std::int32_t* time_fx16, float* slope_x,
             float* slope_y, float* foam) {
  const D d;
  const std::size_t groups = static_cast<std::size_t>(map.size) / kMapGroup;
  for (std::size_t group = row * groups; group < (row + 1) * groups; ++group) {
    for (std::size_t first = 0; first < kMapGroup; first += hn::Lanes(d)) {
      if (map.has_sea[group] != 0) {
        BakePacket(map, group, first, time_fx16, slope_x, slope_y, foam);
        continue;
      }
      const std::size_t at = group * kMapGroup + first;
      for (float* out : {slope_x, slope_y, foam}) hn::StoreU(hn::Zero(d), d, out + at);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {

HWY_EXPORT(BakeRow);

void bake_coast(const CoastMap& map, double t_s, std::span<float> slope_x, std::span<float> slope_y,
                std::span<float> foam, Workers& workers) {
  const auto n = static_cast<std::size_t>(map.size);
  SWELL_CHECK(slope_x.size() == n * n && slope_y.size() == n * n && foam.size() == n * n,
              "size={}, {} and {} slopes, {} foam", n, slope_x.size(), slope_y.size(), foam.size());
  SWELL_CHECK(map.period_s.size() <= kMaxTrains, "trains={}", map.period_s.size());
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  std::array<std::int32_t, kMaxTrains> time_fx16{};
  for (std::size_t i = 0; i < map.period_s.size(); ++i) {
    const double cycles = t_s / map.period_s[i];
    time_fx16[i] = static_cast<std::int32_t>(std::floor((cycles - std::floor(cycles)) * 65536.0));
  }
  constexpr std::size_t kRows = 8;  // a task
  workers.for_each((n + kRows - 1) / kRows, [&](std::size_t task, int) {
    for (std::size_t row = task * kRows; row < std::min(n, (task + 1) * kRows); ++row)
      HWY_DYNAMIC_DISPATCH(BakeRow)
    (map, row, time_fx16.data(), slope_x.data(), slope_y.data(), foam.data());
  });
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
