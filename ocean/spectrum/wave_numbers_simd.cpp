#include <algorithm>
#include <array>
#include <cstddef>

#include "math/check.h"
#include "ocean/spectrum/wave_numbers.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/spectrum/wave_numbers_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// All below is written operation by operation as math/elementary.cpp and
// ocean/spectrum/dispersion.cpp have it, without fused ones, and so gives their bits.
using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

HWY_INLINE V Constant(double x) { return hn::Set(D(), x); }

// exp(x) for x in [-708, 0].
HWY_INLINE V Exp(V x) {
  constexpr double kLn2Hi = 0x1.62e42fee00000p-1, kLn2Lo = 0x1.a39ef35793c76p-33;
  const V k = hn::Round(x * (1.0 / (kLn2Hi + kLn2Lo)));
  const V r = x - k * kLn2Hi - k * kLn2Lo;
  // 1 / n!, n = 14, 13, ... 0.
  constexpr std::array<double, 15> kFactorials = {
      87178291200.0, 6227020800.0, 479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0,
      720.0,         120.0,        24.0,        6.0,        2.0,       1.0,      1.0};
  V sum = Constant(1.0 / kFactorials[0]);
  for (std::size_t n = 1; n < kFactorials.size(); ++n) sum = sum * r + 1.0 / kFactorials[n];
  // 2^k: the last bits of k + 1.5 * 2^52 are those of the integer k.
  const hn::RebindToUnsigned<D> bits;
  const auto exponent = hn::BitCast(bits, k + 0x1.8p52) + hn::Set(bits, 1023);
  return sum * hn::BitCast(D(), hn::ShiftLeft<52>(exponent));
}

// tanh(x) for x >= 0.
HWY_INLINE V Tanh(V x) {
  const V one = Constant(1.0), q = x * x;
  V series = Constant(62.0 / 2835);
  for (const double c : {-17.0 / 315, 2.0 / 15, -1.0 / 3, 1.0}) series = c + q * series;
  const V e = Exp(-2.0 * Min(x, 20.0));
  const V quotient = (one - e) / (one + e);
  const V far = IfThenElse(x > 20.0, one, quotient);
  return IfThenElse(x < 0.02, x * series, far);
}

// kh for y = omega^2 h / g.
HWY_INLINE V HuntDepthInRadians(V y) {
  V sum = Constant(1.0), power = sum;
  for (const double c :
       {0.6666666666, 0.3555555555, 0.1608465608, 0.0632098765, 0.0217540484, 0.0065407983}) {
    power = power * y;
    sum = sum + c * power;
  }
  return Sqrt(y * y + y / sum);
}

HWY_INLINE V NewtonStep(V x, V y) {
  const V t = Tanh(x);
  const V slope = t + x * (1.0 - t * t);
  return x - (x * t - y) / slope;
}

void WaveNumbers(double k_deep, const double* depth_m, double* k_rad_m, std::size_t count) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(D())) {
    const V depth = hn::LoadU(D(), depth_m + i);
    const V y = k_deep * depth;
    const auto is_deep = y > 25.0;
    V k = Constant(k_deep);
    if (!hn::AllTrue(D(), is_deep)) {
      const V kh = NewtonStep(NewtonStep(HuntDepthInRadians(y), y), y);
      k = IfThenElse(is_deep, k, kh / depth);
    }
    hn::StoreU(k, D(), k_rad_m + i);
  }
}

void ShoalingCoefficients(const double* k_rad_m, const double* depth_m, double* coefficient,
                          std::size_t count) {
  const V one = Constant(1.0), half = Constant(0.5);
  for (std::size_t i = 0; i < count; i += hn::Lanes(D())) {
    const V kh = hn::LoadU(D(), k_rad_m + i) * hn::LoadU(D(), depth_m + i);
    const V t = Tanh(kh);
    const V ratio = kh * (one - t * t) / t;
    const V group = IfThenElse(kh > 25.0, half, half * (one + ratio));
    const V flux = 2.0 * group * t;
    hn::StoreU(one / Sqrt(flux), D(), coefficient + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {
HWY_EXPORT(WaveNumbers);
HWY_EXPORT(ShoalingCoefficients);

namespace {

constexpr std::size_t kPacket = 8;  // a whole number of vectors on every target

// The last samples, fewer than a packet, in a packet.
std::array<double, kPacket> last_packet(std::span<const double> values) {
  std::array<double, kPacket> packet;
  packet.fill(1.0);
  std::ranges::copy(values.subspan(values.size() / kPacket * kPacket), packet.begin());
  return packet;
}

void store_last(const std::array<double, kPacket>& packet, std::span<double> values) {
  std::copy_n(packet.begin(), values.size() % kPacket,
              values.end() - static_cast<std::ptrdiff_t>(values.size() % kPacket));
}

}  // namespace

void wave_numbers(double omega_rad_s, double gravity_mps2, std::span<const double> depth_m,
                  std::span<double> k_rad_m) {
  SWELL_CHECK(depth_m.size() == k_rad_m.size(), "{} depths, {} numbers", depth_m.size(),
              k_rad_m.size());
  SWELL_CHECK(omega_rad_s > 0.0, "omega_rad_s={}", omega_rad_s);
  const double k_deep = omega_rad_s * omega_rad_s / gravity_mps2;
  const auto depth = last_packet(depth_m);
  std::array<double, kPacket> last;
  const std::size_t whole = depth_m.size() / kPacket * kPacket;
  HWY_DYNAMIC_DISPATCH(WaveNumbers)(k_deep, depth_m.data(), k_rad_m.data(), whole);
  HWY_DYNAMIC_DISPATCH(WaveNumbers)(k_deep, depth.data(), last.data(), kPacket);
  store_last(last, k_rad_m);
}

void shoaling_coefficients(std::span<const double> k_rad_m, std::span<const double> depth_m,
                           std::span<double> coefficient) {
  SWELL_CHECK(k_rad_m.size() == depth_m.size() && k_rad_m.size() == coefficient.size(),
              "{} numbers, {} depths, {} coefficients", k_rad_m.size(), depth_m.size(),
              coefficient.size());
  const auto k = last_packet(k_rad_m), depth = last_packet(depth_m);
  std::array<double, kPacket> last;
  const std::size_t whole = depth_m.size() / kPacket * kPacket;
  HWY_DYNAMIC_DISPATCH(ShoalingCoefficients)
  (k_rad_m.data(), depth_m.data(), coefficient.data(), whole);
  HWY_DYNAMIC_DISPATCH(ShoalingCoefficients)(k.data(), depth.data(), last.data(), kPacket);
  store_last(last, coefficient);
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
