#include "ocean/open_sea/small_sea.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "math/random.h"
#include "ocean/spectrum/fft.h"

namespace swell::ocean {
namespace {

constexpr double kTension = 0.0728 / 1000.0;  // of water over its density [m^3/s^2]

int cycles_of(const SmallSea& sea, double k_rad_m) {
  const double omega2 = k_rad_m * (sea.gravity_mps2 + kTension * k_rad_m * k_rad_m);
  const double cycles = std::sqrt(omega2) * sea.loop_s / (2.0 * kPi);
  const double most = std::max(1, sea.frames / 10);
  return static_cast<int>(std::clamp(std::nearbyint(cycles), 1.0, most));
}

// Part of a wave's height by its direction: cos^2 of half the angle to the wind.
double spread(const SmallSea& sea, double i, double j, double waves) {
  const double travel = sea.wind_from_rad + kPi;
  return 0.5 * (1.0 + (i * sin(travel) + j * cos(travel)) / waves);
}

// One transform makes two frames: the waves' amplitudes at the time of the one, and i times those
// at the time of the other.
struct TwoFrames {
  double first, second;  // parts of the loop
};

void add_wave(const SmallWave& wave, const TwoFrames& at, double sign, float& re, float& im) {
  const auto term = [&](double part) {
    const SinCos c = sin_cos_turns(sign * (wave.phase - wave.cycles * part));
    return SinCos{0.5 * wave.amplitude * c.sin, 0.5 * wave.amplitude * c.cos};
  };
  const SinCos a = term(at.first), b = term(at.second);
  re = static_cast<float>(a.cos - b.sin);
  im = static_cast<float>(a.sin + b.cos);
}

}  // namespace

std::vector<SmallWave> small_sea_waves(const SmallSea& sea) {
  std::vector<SmallWave> waves;
  for (int j = -kMostSmallWaves; j <= kMostSmallWaves; ++j)
    for (int i = -kMostSmallWaves; i <= kMostSmallWaves; ++i) {
      const double count = std::sqrt(static_cast<double>(i * i + j * j));
      if (count < kLeastSmallWaves || count > kMostSmallWaves) continue;
      const double part = spread(sea, i, j, count);
      // Its twin, which goes the other way, has the smaller part.
      if (part < 0.5 || (part == 0.5 && (j < 0 || (j == 0 && i < 0)))) continue;
      const auto number = static_cast<std::uint64_t>((j + kMostSmallWaves) * 1024 + i + 512);
      const int cycles = cycles_of(sea, 2.0 * kPi * count / sea.length_m);
      // Steepness k a in rings of k dk: a^2 k^2 k^2 is the same at all k.
      waves.push_back({i, j, cycles, part / (count * count), random_uniform(sea.seed, number)});
    }
  return waves;
}

std::vector<std::vector<float>> small_sea_heights(const SmallSea& sea, Workers& workers) {
  SWELL_CHECK(sea.size >= 128 && sea.size <= kMaxFftSize && sea.frames >= 2, "size={} frames={}",
              sea.size, sea.frames);
  const FftPlan plan = make_fft_plan(sea.size);
  const std::vector<SmallWave> waves = small_sea_waves(sea);
  const std::size_t texels = static_cast<std::size_t>(sea.size) * sea.size;
  std::vector<std::vector<float>> heights(static_cast<std::size_t>(sea.frames));
  for (std::vector<float>& frame : heights) frame.resize(texels);
  std::vector<float> planes;
  for (int frame = 0; frame < sea.frames; frame += 2) {
    const bool has_second = frame + 1 < sea.frames;
    const TwoFrames at = {static_cast<double>(frame) / sea.frames,
                          static_cast<double>(frame + 1) / sea.frames};
    const auto fill = [&](int, int column0, float* re, float* im) {
      std::fill_n(re, sea.size * kFftBatch, 0.0f);
      std::fill_n(im, sea.size * kFftBatch, 0.0f);
      bool any = false;
      for (const SmallWave& wave : waves)
        for (const int sign : {1, -1}) {
          const int column = (sign * wave.i) & (sea.size - 1),
                    row = (sign * wave.j) & (sea.size - 1);
          if (column < column0 || column >= column0 + kFftBatch) continue;
          const int n = plan.slot[static_cast<std::size_t>(row)] * kFftBatch + column - column0;
          add_wave(wave, at, sign, re[n], im[n]);
          any = true;
        }
      return any;
    };
    const auto n = static_cast<std::size_t>(frame);
    const FftOutput output = {heights[n].data(), has_second ? heights[n + 1].data() : nullptr};
    inverse_fft_2d(plan, fill, std::span(&output, 1), planes, workers);
  }
  return heights;
}

}  // namespace swell::ocean
