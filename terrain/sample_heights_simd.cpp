#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "terrain/sample_heights.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/sample_heights_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::terrain {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// In doubles.
using DD = hn::ScalableTag<double>;
using VD = hn::Vec<DD>;
using MD = hn::Mask<DD>;

struct Points {
  VD x, y;
};

HWY_INLINE VD Clamp01(VD x) { return Min(Max(x, 0.0), 1.0); }
HWY_INLINE VD SmoothBlend(VD t) { return t * t * (3.0 - 2.0 * t); }

// The map, bilinear between its samples, with those of the border beyond it.
class Map {
 public:
  explicit Map(const HeightGrid& heights)
      : samples_(heights.height_m.data()),
        row_(heights.grid.samples_x),
        spacing_m_(heights.grid.spacing_m),
        low_(heights.grid.min_world),
        high_(low_ + heights.grid.extent_m()),
        last_cell_(heights.grid.samples_x - 2, heights.grid.samples_y - 2) {}

  HWY_INLINE MD Holds(const Points& p) const {
    return (p.x >= low_.x) & (p.y >= low_.y) & (p.x <= high_.x) & (p.y <= high_.y);
  }
  HWY_INLINE Points Nearest(const Points& p) const {
    return {Min(Max(p.x, low_.x), high_.x), Min(Max(p.y, low_.y), high_.y)};
  }
  HWY_INLINE Points FromLow(const Points& p) const { return {p.x - low_.x, p.y - low_.y}; }
  HWY_INLINE Points FromMiddle(const Points& p) const {
    const glm::dvec2 middle = 0.5 * (low_ + high_);
    return {p.x - middle.x, p.y - middle.y};
  }

  HWY_INLINE VD At(VD x, VD y) const {
    const hn::Rebind<float, DD> df;
    const auto [i, fx] = CellAt(x, low_.x, last_cell_.x);
    const auto [j, fy] = CellAt(y, low_.y, last_cell_.y);
    const auto south = j * row_ + i, north = south + row_;
    const auto sample = [&](auto at) HWY_ATTR {
      return hn::PromoteTo(DD(), hn::GatherIndex(df, samples_, at));
    };
    const VD h00 = sample(south), h10 = sample(south + 1);
    const VD h01 = sample(north), h11 = sample(north + 1);
    const VD low = h00 + fx * (h10 - h00), high = h01 + fx * (h11 - h01);
    return low + fy * (high - low);
  }

 private:
  using DI32 = hn::Rebind<std::int32_t, DD>;
  struct Cell {
    hn::Vec<DI32> number;
    VD part;
  };
  HWY_INLINE Cell CellAt(VD x, double low, int last_cell) const {
    const VD from_low = (x - low) / spacing_m_;
    const VD u = Min(IfThenElseZero(from_low > 0.0, from_low), static_cast<double>(last_cell + 1));
    const auto number = Min(hn::DemoteTo(DI32(), u), last_cell);
    return {number, u - hn::PromoteTo(DD(), number)};
  }

  const float* samples_;
  std::int32_t row_;
  double spacing_m_;
  glm::dvec2 low_, high_;
  glm::ivec2 last_cell_;
};

// A smooth wave of period 1 in [-1, 1] at a tenth of a sine's cost: water's vertices ask for
// depths.
HWY_INLINE VD Wave(VD turns) {
  const VD x = turns - Floor(turns), hump = x * (1.0 - x);
  return 32.0 * hump * hump - 1.0;
}

// Bays and points, in [0.56, 1]: waves of three lengths, bent by one another. q: in aprons' widths.
HWY_INLINE VD Bays(VD x, VD y) {
  const VD bend = Wave(0.37 * x - 0.49 * y + 0.06);
  const VD waves = Wave(0.59 * x + 0.30 * y + 0.22 * bend + 0.21) +
                   0.6 * Wave(-0.46 * x + 1.07 * y + 0.27 * bend) +
                   0.4 * Wave(1.64 * x - 1.29 * y - 0.33 * bend);
  return 0.78 + 0.22 / 2.0 * waves;
}

// Where the ground sinks from and where it is all floor, as parts of the apron.
struct Slope {
  VD from, to;
};

// q: from the map's middle, outside the map. A square's corners are further from its middle than
// its sides: beyond them the ground sinks at once, before the sides later, so that it ends about
// round.
HWY_INLINE Slope SlopeAt(const Points& q, VD bays) {
  const VD xx = q.x * q.x, yy = q.y * q.y, rr = xx + yy;
  const VD sin2 = 4.0 * xx * yy / (rr * rr);  // of twice the azimuth, squared
  const VD side = 1.0 - sin2 * sin2;          // 1 before a side's middle, 0 at a corner
  const VD from = 0.36 * side * bays;
  return {from, from + (0.38 + 0.22 * side) * bays};
}

// What mirrors the height `inner` in the border's height, between the floor and the top.
HWY_INLINE VD Turned(VD border, VD inner, double floor, double top) {
  const VD rise = border - inner;
  const VD room = IfThenElse(rise > 0.0, top - border, border - floor);
  const VD turned = border + rise * room / (Abs(rise) + room);
  return IfThenElse(hn::Not(rise == hn::Zero(DD())) & (room > 0.0), turned, border);
}

// The map turned about its border, at p, and further out the border's height; `near` is the
// border's point nearest to p, `part` of the apron away.
HWY_INLINE VD GoesOn(const Map& map, const Points& p, const Points& near, VD part, MD mask,
                     double floor, double top) {
  constexpr double kGoesOnPart = 0.6;  // of the apron
  const DD dd;
  const VD level = map.At(near.x, near.y);
  const MD beside_x = hn::Not(p.x == near.x), beside_y = hn::Not(p.y == near.y);
  const auto along_x = [&](VD border, VD y) HWY_ATTR {
    if (hn::AllFalse(dd, beside_x & mask)) return border;
    const VD inner = map.At(near.x + near.x - p.x, y);
    return IfThenElse(beside_x, Turned(border, inner, floor, top), border);
  };
  VD ground = along_x(level, near.y);
  if (!hn::AllFalse(dd, beside_y & mask)) {
    const VD y = near.y + near.y - p.y;
    const VD inner = along_x(map.At(near.x, y), y);
    ground = IfThenElse(beside_y, Turned(ground, inner, floor, top), ground);
  }
  return ground + (level - ground) * SmoothBlend(Clamp01(part / kGoesOnPart));
}

// Beyond the map (terrain/apron.h), where `mask` holds.
HWY_INLINE VD OnApron(const HeightGrid& heights, const Map& map, const Points& p, MD mask) {
  const DD dd;
  const double width_m = heights.apron.width_m, floor = heights.apron.floor_m;
  const VD floors = hn::Set(dd, floor);
  const Points near = map.Nearest(p);
  const VD x = p.x - near.x, y = p.y - near.y;
  const VD part = Sqrt(x * x + y * y) / width_m;
  mask = mask & (part < 1.0);  // what is no place is far
  if (hn::AllFalse(dd, mask)) return floors;
  const Points corner = map.FromLow(p);
  const Slope slope = SlopeAt(map.FromMiddle(p), Bays(corner.x / width_m, corner.y / width_m));
  mask = mask & (part < slope.to);
  if (hn::AllFalse(dd, mask)) return floors;
  const double top = std::max<double>(heights.highest_m, floor);
  const VD ground = GoesOn(map, p, near, part, mask, floor, top);
  const VD down = Max(part - slope.from, 0.0) / (slope.to - slope.from);
  return IfThenElse(mask, ground + (floor - ground) * SmoothBlend(down * down), floors);
}

void SampleHeights(const HeightGrid& heights, std::span<const glm::dvec2> p_world,
                   std::span<double> height_m) {
  const DD dd;
  constexpr std::size_t kWidth = hn::MaxLanes(DD());
  const Map map(heights);
  const bool has_apron = heights.apron.width_m > 0.0;
  for (std::size_t n = 0; n < p_world.size(); n += kWidth) {
    const std::size_t count = std::min(kWidth, p_world.size() - n);
    Points p;
    if (count == kWidth) {
      hn::LoadInterleaved2(dd, &p_world[n].x, p.x, p.y);
    } else {
      std::array<glm::dvec2, kWidth> some;
      for (std::size_t i = 0; i < kWidth; ++i) some[i] = p_world[n + std::min(i, count - 1)];
      hn::LoadInterleaved2(dd, &some[0].x, p.x, p.y);
    }
    const MD outside = hn::Not(map.Holds(p));
    VD height = map.At(p.x, p.y);
    if (has_apron && !hn::AllFalse(dd, outside))
      height = IfThenElse(outside, OnApron(heights, map, p, outside), height);
    if (count == kWidth) {
      hn::StoreU(height, dd, &height_m[n]);
    } else {
      HWY_ALIGN std::array<double, kWidth> some;
      hn::Store(height, dd, some.data());
      std::copy_n(some.data(), count, &height_m[n]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::terrain
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::terrain {

HWY_EXPORT(SampleHeights);

void sample_doubles(const HeightGrid& heights, std::span<const glm::dvec2> p_world,
                    std::span<double> height_m) {
  HWY_DYNAMIC_DISPATCH(SampleHeights)(heights, p_world, height_m);
}

}  // namespace swell::terrain
#endif
