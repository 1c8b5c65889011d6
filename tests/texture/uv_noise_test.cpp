#include "texture/uv_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "math/simd_target.h"

namespace swell::texture {
namespace {

struct Frame {
  std::vector<float> cos, sin;
  bool operator==(const Frame&) const = default;
};

Frame frame_of(UvNoise& noise, int size, double t) {
  Frame frame{std::vector<float>(size * size), std::vector<float>(size * size)};
  noise.evaluate(t, frame.cos, frame.sin);
  return frame;
}

double smooth(double t) { return t * t * (3 - 2 * t); }

// The noise's angle in double from the lattice values alone.
double reference_angle(const UvNoiseOptions& options, int i, int j, double t) {
  const PerlinNoise lattice(options.seed);
  double total = 0.0, sum = 0.0;
  for (int octave = 0; octave < options.octaves; ++octave) {
    const int cells = options.cells << octave;
    const double p[3] = {static_cast<double>(i) * cells / options.size,
                         static_cast<double>(j) * cells / options.size, t * std::exp2(octave)};
    double value = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      int at[3];
      for (int axis = 0; axis < 3; ++axis) {
        const double w = smooth(p[axis] - std::floor(p[axis]));
        const int step = corner >> axis & 1;
        weight *= step == 1 ? w : 1 - w;
        at[axis] = static_cast<int>(std::floor(p[axis])) + step;
      }
      value += weight * lattice.lattice3(at[0] % cells, at[1] % cells, at[2]);
    }
    total += std::pow(options.persistence, octave) * value;
    sum += std::pow(options.persistence, octave);
  }
  return options.angle_turns * 2 * kPiRef * total / sum;
}

TEST(UvNoise, IsTheCosineAndSineOfPerlinNoise) {
  for (const UvNoiseOptions& options :
       {UvNoiseOptions{}, UvNoiseOptions{.size = 32, .cells = 4, .octaves = 3, .persistence = 0.7},
        UvNoiseOptions{.size = 8, .cells = 1, .octaves = 1, .angle_turns = 2.0, .seed = 9}}) {
    UvNoise noise(options);
    for (const double t : {0.0, 0.37, 17.9, 255.6, -3.25, 1e5}) {
      const Frame frame = frame_of(noise, options.size, t);
      for (int n = 0; n < options.size * options.size; n += 3) {
        const double angle = reference_angle(options, n % options.size, n / options.size, t);
        ASSERT_NEAR(frame.cos[n], std::cos(angle), 5e-6 * (1 + std::abs(options.angle_turns)));
        ASSERT_NEAR(frame.sin[n], std::sin(angle), 5e-6 * (1 + std::abs(options.angle_turns)));
      }
    }
  }
}

TEST(UvNoise, MovesSmoothlyInTime) {
  UvNoise noise({});
  // With lattice values in [-1, 1] the angle's speed is at most 12.6 a unit of time and its
  // acceleration 75, so the sine's second derivative is below 12.6^2 + 75 = 234.
  const double step = 1.0 / 64;
  for (double t = 3.0; t < 6.0; t += step) {
    const Frame before = frame_of(noise, 64, t - step), now = frame_of(noise, 64, t),
                after = frame_of(noise, 64, t + step);
    for (std::size_t n = 0; n < now.sin.size(); n += 7) {
      ASSERT_LT(std::abs(after.sin[n] - now.sin[n]), 12.6 * step);
      ASSERT_LT(std::abs(after.sin[n] - 2 * now.sin[n] + before.sin[n]), 234 * step * step);
    }
  }
}

TEST(UvNoise, HasNoSeam) {
  UvNoise noise({});
  const Frame frame = frame_of(noise, 64, 1.3);
  double inside = 0.0, across = 0.0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 63; ++x) {
      inside =
          std::max(inside, double{std::abs(frame.sin[64 * y + x + 1] - frame.sin[64 * y + x])});
    }
    across = std::max(across, double{std::abs(frame.sin[64 * y] - frame.sin[64 * y + 63])});
    across = std::max(across, double{std::abs(frame.sin[y] - frame.sin[64 * 63 + y])});
  }
  EXPECT_LE(across, inside);
  EXPECT_GT(across, 0.0);
}

TEST(UvNoise, DependsOnTheTimeAlone) {
  UvNoise used({}), fresh({});
  frame_of(used, 64, 100.0);
  frame_of(used, 64, 2.0);
  EXPECT_EQ(frame_of(used, 64, 0.7), frame_of(fresh, 64, 0.7));
  EXPECT_EQ(frame_of(used, 64, 0.75), frame_of(used, 64, 256.75));
}

Frame looping_frame(UvNoise& noise, double t, int loop_cells) {
  Frame frame{std::vector<float>(64 * 64), std::vector<float>(64 * 64)};
  noise.evaluate_looping(t, loop_cells, frame.cos, frame.sin);
  return frame;
}

// Only the way from the last lattice time of an octave to the first is not what it is without a
// loop.
TEST(UvNoise, ALoopEndsWhereItBegan) {
  UvNoise noise({});
  for (const int cells : {2, 5, 256, 300}) {
    const Frame first = looping_frame(noise, 0.0, cells);
    EXPECT_EQ(looping_frame(noise, cells, cells), first) << cells;
    for (const double t : {0.0, 0.3, 0.75, cells - 1.25, cells - 1.0})
      EXPECT_EQ(looping_frame(noise, t, cells), frame_of(noise, 64, t)) << t << " " << cells;
    // Continuous at the end.
    const double step = 1.0 / 256;
    const Frame last = looping_frame(noise, cells - step, cells);
    for (std::size_t n = 0; n < first.sin.size(); n += 7)
      ASSERT_LT(std::abs(last.sin[n] - first.sin[n]), 12.6 * step) << cells;
    EXPECT_NE(looping_frame(noise, 0.5 * cells, cells), first) << cells;
  }
}

TEST(UvNoise, TargetsGiveTheSameBits) {
  if (!simd_target_available(SimdTarget::kAvx512)) GTEST_SKIP() << "this CPU lacks AVX-512";
  UvNoise noise({});
  select_simd_target(simd_targets().front());
  const Frame narrow = frame_of(noise, 64, 12.34);
  select_simd_target(SimdTarget::kAvx512);
  EXPECT_EQ(frame_of(noise, 64, 12.34), narrow);
}

TEST(UnitVectors, WorkForEveryCount) {
  for (const std::size_t count : {0u, 1u, 7u, 8u, 17u, 100u}) {
    std::vector<float> turns(count), cos(count), sin(count);
    for (std::size_t n = 0; n < count; ++n) {
      turns[n] = static_cast<float>(random_uniform(1, n) * 20 - 10);
    }
    write_unit_vectors(turns, cos, sin);
    for (std::size_t n = 0; n < count; ++n) {
      ASSERT_NEAR(cos[n], std::cos(2 * kPiRef * turns[n]), 3e-7);
      ASSERT_NEAR(sin[n], std::sin(2 * kPiRef * turns[n]), 3e-7);
    }
  }
}

}  // namespace
}  // namespace swell::texture
