#include "render/picture/sensor_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "math/random.h"

namespace swell::render {
namespace {

// A number of mean 0 and variance 1, as stated.
double nearly_normal(std::uint64_t seed, std::uint64_t counter) {
  std::uint64_t sum = 0;
  for (std::uint64_t half = 0; half < 2; ++half) {
    const std::uint64_t bits = random_bits(seed, 2 * counter + half);
    for (unsigned shift = 0; shift < 64; shift += 16) sum += bits >> shift & 0xffff;
  }
  // Eight uniform numbers 0 ... 65535: mean 8 (65535 / 2), variance 8 (65536^2 - 1) / 12.
  constexpr double kMean = 4.0 * 65535.0, kDeviation = 53509.91992145;
  return (static_cast<double>(sum) - kMean) / kDeviation;
}

}  // namespace

double electrons_of_unit_light(const scene::SensorNoise& noise) {
  return noise.full_well_e * (100.0 / noise.iso) / kFullLight;
}

void add_sensor_noise(const scene::SensorNoise& noise, double t_s, float exposure,
                      std::size_t first_pixel, std::span<float> light) {
  const double per_light = electrons_of_unit_light(noise) * static_cast<double>(exposure);
  const double most = electrons_of_unit_light(noise) * kFullLight;
  const double read_variance = noise.read_noise_e * noise.read_noise_e;
  const std::uint64_t seed = random_bits(noise.seed, std::bit_cast<std::uint64_t>(t_s + 0.0));
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double signal = std::clamp(static_cast<double>(light[i]) * per_light, 0.0, most);
    const double off = std::sqrt(signal + read_variance) * nearly_normal(seed, 3 * first_pixel + i);
    light[i] = static_cast<float>(std::min(signal + off, most) / per_light);
  }
}

}  // namespace swell::render
