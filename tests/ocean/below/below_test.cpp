// The water below its surface: linear theory in closed form, the direct sum of all waves, and what
// has to hold between velocity, acceleration and pressure.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "ocean/below/sea_below.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/simd_targets.h"
#include "ocean/train_sea.h"
#include "terrain/sea_floor.h"

namespace swell::ocean {
namespace {

constexpr double kPa_m = kSeaDensity_kg_m3 * kG;

// ---- One wave

SeaDescription one_sine(double amplitude_m, double wavelength_m) {
  SeaDescription sea;
  sea.spectrum = false;
  sea.sines = {{amplitude_m, wavelength_m, kPiRef / 3.0, 0.4, 0.0}};
  return sea;
}

TEST(Below, OneWaveOfDeepWaterDecaysAsAiryAndWheelerSay) {
  const double a = 0.7, k = kTurn / 40.0, omega = std::sqrt(kG * k);
  const Sea sea(one_sine(a, 40.0));
  const glm::dvec2 to(std::sin(kPiRef / 3.0), std::cos(kPiRef / 3.0));
  for (const double t_s : {-20.0, 3.3}) {
    SeaBelow now({&sea}, t_s);
    for (int i = 0; i < 40; ++i) {
      const glm::dvec2 p(3.7 * i, -1.9 * i);
      const double phase = k * glm::dot(to, p) - omega * t_s + 0.4, eta = a * std::sin(phase);
      for (const double s : {0.0, 0.5, 3.0, 10.0, 30.0}) {
        const WaterMotion m = now.motion({p, eta - s - 1e-6});
        const double d = std::exp(-k * s), off = 0.002 * a;
        EXPECT_NEAR(m.velocity_mps.x, omega * eta * d * to.x, off * omega);
        EXPECT_NEAR(m.velocity_mps.y, omega * eta * d * to.y, off * omega);
        EXPECT_NEAR(m.velocity_mps.z, -omega * a * std::cos(phase) * d, off * omega);
        const double rate = -omega * omega * a * std::cos(phase) * d;
        EXPECT_NEAR(m.acceleration_mps2.x, rate * to.x, off * omega * omega);
        EXPECT_NEAR(m.acceleration_mps2.y, rate * to.y, off * omega * omega);
        EXPECT_NEAR(m.acceleration_mps2.z, -omega * omega * eta * d, off * omega * omega);
        EXPECT_NEAR(m.pressure_pa, kPa_m * eta * d, off * kPa_m);
      }
    }
  }
}

// A train over a floor of one depth, alone on the sea.
struct FlatCoast {
  explicit FlatCoast(double depth_m, const WaveTrain& train) : sea(calm()) {
    floor =
        terrain::make_sea_floor({{0.0, 0.0}, 10.0, 101, 61}, [=](glm::dvec2) { return depth_m; });
    Workers workers(1);
    coast = make_coast_sea(floor, make_wind_sea(8.0, 0.0, kG), std::vector{train},
                           PhaseMethod::kEikonal, false, workers);
  }
  static SeaDescription calm() {
    SeaDescription sea;
    sea.spectrum = false;
    return sea;
  }
  WaterParts parts() const { return {&sea, {}, &floor, &coast}; }

  Sea sea;
  terrain::HeightGrid floor;
  CoastSea coast;
};

TEST(Below, OneWaveOverAFloorDecaysAsAirySays) {
  const double depth_m = 14.0, omega = kTurn / 6.0, k = bisected_wave_number(6.0, depth_m);
  ASSERT_LT(std::tanh(k * depth_m), 0.95);
  const glm::dvec2 to(0.8, 0.6);
  const FlatCoast coast(depth_m, {0.5, 6.0, to, 0.0});
  double a = 0.0;
  for (int n = 0; n < 600; ++n)
    a = std::max(a, height_at(coast.coast.trains, 0.01 * n, {500.0, 300.0}));
  ASSERT_GT(a, 0.4);
  for (const double t_s : {0.0, 2.5}) {
    SeaBelow now(coast.parts(), t_s);
    for (int i = 0; i < 40; ++i) {
      const glm::dvec2 p(480.0 + 1.7 * i, 300.0 - 1.1 * i);
      const double phase = k * glm::dot(to, p) - omega * t_s, eta = now.surface().height(p);
      EXPECT_NEAR(eta, a * std::cos(phase), 0.01 * a);
      for (const double part : {0.001, 0.1, 0.3, 0.6, 0.999}) {
        const double z = eta - part * (depth_m + eta);  // stretched: part of the depth
        const WaterMotion m = now.motion({p, z});
        const double up = k * depth_m * (1.0 - part), off = 0.01 * a;
        const double c = std::cosh(up) / std::sinh(k * depth_m);
        const double w = std::sinh(up) / std::sinh(k * depth_m);
        EXPECT_NEAR(m.velocity_mps.x, a * omega * c * to.x * std::cos(phase), off * omega);
        EXPECT_NEAR(m.velocity_mps.y, a * omega * c * to.y * std::cos(phase), off * omega);
        EXPECT_NEAR(m.velocity_mps.z, a * omega * w * std::sin(phase), off * omega);
        const double rate = a * omega * omega * std::sin(phase) * c;
        EXPECT_NEAR(m.acceleration_mps2.x, rate * to.x, off * omega * omega);
        EXPECT_NEAR(m.acceleration_mps2.y, rate * to.y, off * omega * omega);
        EXPECT_NEAR(m.acceleration_mps2.z, -a * omega * omega * w * std::cos(phase),
                    off * omega * omega);
        EXPECT_NEAR(m.pressure_pa,
                    kPa_m * a * std::cos(phase) * std::cosh(up) / std::cosh(k * depth_m),
                    off * kPa_m);
      }
    }
  }
}

// ---- Many waves

SeaDescription small_sea() {
  SeaDescription sea;
  sea.wind_speed_mps = 9.0;
  sea.resolution = 16;
  sea.patch_lengths_m = {60.0};
  sea.tiling = false;
  return sea;
}

// What all waves of the patch add up to at a place and depth, one by one, in double.
std::array<double, kMotionFields> direct_sum(const PatchWaves& waves, double t_s, glm::dvec2 p,
                                             double below_m) {
  std::array<double, kMotionFields> sum{};
  for (int j = 0; j < waves.size; ++j)
    for (int i = 0; i < waves.size; ++i) {
      const std::size_t at = wave_position(i, j, waves.size);
      const glm::dvec2 k = wave_vector(i, j, waves.size, waves.length_m);
      const double wave_number = glm::length(k);
      if (wave_number == 0.0) continue;
      const double omega = kTurn * waves.turns_per_s[at];
      const std::complex<double> i_unit(0.0, 1.0);
      const std::complex<double> cos_part(waves.cos_re[at], waves.cos_im[at]);
      const std::complex<double> sin_part(waves.sin_re[at], waves.sin_im[at]);
      const double c = std::cos(omega * t_s), s = std::sin(omega * t_s);
      const std::complex<double> here =
          std::exp(i_unit * glm::dot(k, p)) * std::exp(-wave_number * below_m);
      const std::complex<double> h = (cos_part * c + sin_part * s) * here;
      const std::complex<double> rate = omega * (sin_part * c - cos_part * s) * here;
      const std::complex<double> rate2 = -omega * omega * h;
      sum[kHead] += h.real();
      sum[kVelocityZ] += rate.real();
      sum[kAccelerationZ] += rate2.real();
      for (int axis = 0; axis < 2; ++axis) {
        const std::complex<double> to = i_unit * k[axis] / wave_number;
        sum[static_cast<std::size_t>(kVelocityX + axis)] += (to * rate).real();
        sum[static_cast<std::size_t>(kAccelerationX + axis)] += (to * rate2).real();
      }
    }
  return sum;
}

std::array<double, kMotionFields> numbers_of(const WaterMotion& m) {
  return {m.velocity_mps.x,      m.velocity_mps.y,      m.velocity_mps.z,     m.acceleration_mps2.x,
          m.acceleration_mps2.y, m.acceleration_mps2.z, m.pressure_pa / kPa_m};
}

// At the places of samples, where nothing is interpolated but the depth.
TEST(Below, TheSeaIsTheDirectSumOfItsWaves) {
  SeaDescription looping = small_sea();
  looping.loop_s = 20.0;
  for (const SeaDescription& description : {small_sea(), looping}) {
    const Sea sea(description);
    const PatchWaves& waves = sea.state().patches[0];
    const double t_s = 7.25;
    SeaBelow now({&sea}, t_s);
    std::array<double, kMotionFields> largest{}, worst{};
    for (int n = 0; n < 60; ++n) {
      const glm::dvec2 p = glm::dvec2(n % 16, (5 * n) % 16) * (60.0 / 16.0);
      for (const double s : {0.0, 0.013, 0.3, 1.0, 4.0, 17.0}) {
        const double surface = now.surface().height(p);
        const auto got = numbers_of(now.motion({p, surface - s}));
        const auto expected = direct_sum(waves, t_s, p, s);
        for (std::size_t f = 0; f < kMotionFields; ++f) {
          largest[f] = std::max(largest[f], std::abs(expected[f]));
          worst[f] = std::max(worst[f], std::abs(got[f] - expected[f]));
        }
      }
    }
    for (std::size_t f = 0; f < kMotionFields; ++f) {
      EXPECT_GT(largest[f], 0.1) << f;
      EXPECT_LT(worst[f], 0.002 * largest[f]) << f;
    }
  }
}

// Waves so low that what is of second order, the stretching, counts for nothing.
SeaDescription low_sea() {
  SeaDescription sea;
  sea.wind_speed_mps = 9.0;
  sea.resolution = 64;
  sea.patch_lengths_m = {300.0, 60.0};
  sea.amplitude_scale = 1e-3;
  sea.sines = {{1e-3, 25.0, 1.0, 0.0, 0.0}};
  return sea;
}

std::vector<glm::dvec3> scattered_below(int count, double least_m, double most_m) {
  std::vector<glm::dvec3> p;
  for (int n = 0; n < count; ++n) {
    const auto u = [&](int c) { return random_uniform(3, static_cast<std::uint64_t>(3 * n + c)); };
    p.emplace_back(300.0 * u(0), 300.0 * u(1), -least_m - (most_m - least_m) * u(2));
  }
  return p;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += x * x;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(Below, AccelerationIsTheRateOfTheVelocity) {
  SeaDescription looping = low_sea();
  looping.loop_s = 30.0;
  for (const SeaDescription& description : {low_sea(), looping}) {
    const Sea sea(description);
    const double dt_s = 0.01;
    SeaBelow before({&sea}, 5.0 - dt_s), now({&sea}, 5.0), after({&sea}, 5.0 + dt_s);
    const auto p = scattered_below(300, 0.1, 12.0);
    const auto early = before.motions(p), here = now.motions(p), late = after.motions(p);
    std::vector<double> off, size;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const glm::dvec3 rate =
          (glm::dvec3(late[i].velocity_mps) - glm::dvec3(early[i].velocity_mps)) / (2.0 * dt_s);
      for (int c = 0; c < 3; ++c) {
        off.push_back(rate[c] - static_cast<double>(here[i].acceleration_mps2[c]));
        size.push_back(rate[c]);
      }
    }
    EXPECT_LT(rms(off), 0.005 * rms(size));
  }
}

// The derivative along an axis by differences over four neighbours.
template <class Value>
double derivative(glm::dvec3 p, int axis, double step_m, const Value& value) {
  const auto at = [&](double steps) {
    glm::dvec3 q = p;
    q[axis] += steps * step_m;
    return value(q);
  };
  return (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step_m);
}

// The linearised momentum, dp/dx = -rho du/dt in all directions, and no divergence: at places of
// samples, deep enough for waves of few samples to be gone.
TEST(Below, PressureDrivesTheWaterAndNoWaterIsLost) {
  SeaDescription description = low_sea();
  description.resolution = 128;
  description.patch_lengths_m = {160.0};
  description.tiling = false;
  const Sea sea(description);
  SeaBelow now({&sea}, 12.0);
  std::vector<double> off, size, divergence, shear;
  for (int n = 0; n < 200; ++n) {
    const glm::dvec3 p(1.25 * (7 * n % 128), 1.25 * (11 * n % 128), -3.0 - 0.05 * n);
    const glm::dvec3 acceleration(now.motion(p).acceleration_mps2);
    double lost = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double step_m = axis == 2 ? 0.4 : 1.25;
      const double force = -derivative(p, axis, step_m, [&](glm::dvec3 q) {
        return static_cast<double>(now.motion(q).pressure_pa) / kSeaDensity_kg_m3;
      });
      off.push_back(force - acceleration[axis]);
      size.push_back(force);
      const double along = derivative(p, axis, step_m, [&](glm::dvec3 q) {
        return static_cast<double>(now.motion(q).velocity_mps[axis]);
      });
      lost += along;
      shear.push_back(along);
    }
    divergence.push_back(lost);
  }
  EXPECT_LT(rms(off), 0.03 * rms(size));
  EXPECT_LT(rms(divergence), 0.03 * rms(shear));
}

// ---- All sources together

SeaDescription sharp_sea() {
  SeaDescription sea;
  sea.wind_speed_mps = 10.0;
  sea.resolution = 64;
  sea.patch_lengths_m = {180.0, 27.0};
  sea.choppiness = 0.8;
  sea.sines = {{0.3, 31.0, 0.7, 0.0, 5.0}};
  return sea;
}

// A beach of 1:10 with the sea in the north, trains on it, and wakes of a hull and a drop.
struct Beach {
  Beach() : sea(sharp_sea()) {
    const terrain::Grid grid{{-400.0, -400.0}, 10.0, 81, 81};
    floor = terrain::make_plane_beach(grid, {{{-1.0, -150.0}, {0.0, -150.0}}, 0.1, 40.0});
    Workers workers(2);
    coast = make_coast_sea(floor, make_wind_sea(8.0, 0.0, kG), 3, 1, PhaseMethod::kEikonal, true,
                           workers);
    Disturbance hull, drop;
    hull.kind = DisturbanceKind::kHull;
    hull.path_m = {{-300.0, 100.0}, {300.0, 100.0}};
    hull.path_closed = false;
    hull.speed_mps = 5.0;
    hull.depth_m = 8.0;
    drop.t_s = 57.0;
    drop.radius_m = 2.0;
    drop.height_m = 1.0;
    wakes = {hull, drop};
  }
  WaterParts parts() const { return {&sea, {{0.0, 0.0}, {700.0, 700.0}}, &floor, &coast}; }
  // Over water and land, from above the surface to the ground and into it.
  std::vector<glm::dvec3> points(int count) const {
    std::vector<glm::dvec3> p;
    for (int n = 0; n < count; ++n) {
      const auto u = [&](int c) {
        return random_uniform(8, static_cast<std::uint64_t>(3 * n + c));
      };
      const glm::dvec2 at(600.0 * u(0) - 300.0, 600.0 * u(1) - 250.0);
      p.emplace_back(at, 2.0 - u(2) * (3.0 - std::min(terrain::height_at(floor, at), 0.0)));
    }
    return p;
  }

  Sea sea;
  terrain::HeightGrid floor;
  CoastSea coast;
  std::vector<Disturbance> wakes;
};

TEST(Below, TheSurfaceMovesAsItIsSaidToMove) {
  const Beach beach;
  SeaBelow now(beach.parts(), 60.0, 1, beach.wakes);
  ASSERT_EQ(now.frame.wakes.count, 2u);
  std::vector<glm::dvec2> p;
  for (const glm::dvec3& q : beach.points(2000)) p.emplace_back(q);
  std::vector<float> z(p.size());
  std::vector<glm::vec3> v(p.size());
  now.surface().heights(p, z);
  now.surface().velocities(p, now.velocity, v);
  std::vector<glm::dvec3> at;
  for (std::size_t i = 0; i < p.size(); ++i) at.emplace_back(p[i], static_cast<double>(z[i]));
  const auto motion = now.motions(at);
  int wet = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (motion[i].place != MotionPlace::kInWater) continue;
    ++wet;
    ASSERT_EQ(motion[i].velocity_mps, v[i]) << i;
    ASSERT_NEAR(motion[i].pressure_pa, kPa_m * static_cast<double>(z[i]), 1e-4 * kPa_m);
  }
  EXPECT_GT(wet, 1000);
}

TEST(Below, PlacesOutOfTheWaterSayWhereTheyAre) {
  const Beach beach;
  SeaBelow now(beach.parts(), 60.0, 1, beach.wakes);
  const auto p = beach.points(3000);
  const auto motion = now.motions(p);
  std::array<int, 3> count{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::dvec2 at(p[i]);
    const double surface = now.surface().height(at);
    float ground = 0.0f;
    terrain::sample_heights(beach.floor, {&at, 1}, {&ground, 1});
    const MotionPlace expected = p[i].z < static_cast<double>(ground) ? MotionPlace::kInGround
                                 : p[i].z > surface                   ? MotionPlace::kAbove
                                                                      : MotionPlace::kInWater;
    ASSERT_EQ(motion[i].place, expected);
    ++count[static_cast<std::size_t>(expected)];
    if (expected == MotionPlace::kInWater) continue;
    ASSERT_TRUE(motion[i] == (WaterMotion{expected, {}, {}, 0.0f}));
  }
  for (const int some : count) EXPECT_GT(some, 200);
}

TEST(Below, AnyOrderThreadsAndSimdTargetGiveTheSameBits) {
  const Beach beach;
  const auto p = beach.points(700);
  std::vector<WaterMotion> first;
  for_each_simd_target([&] {
    for (const int threads : {1, 3}) {
      SeaBelow now(beach.parts(), 60.0, threads, beach.wakes);
      const auto motion = now.motions(p);
      if (first.empty()) first = motion;
      EXPECT_TRUE(std::ranges::equal(motion, first, operator==));
    }
  });
  SeaBelow apart(beach.parts(), 60.0, 1, beach.wakes);  // one by one, from behind
  for (std::size_t i = p.size(); i-- > 0;) ASSERT_TRUE(apart.motion(p[i]) == first[i]) << i;
}

TEST(Below, AskedForLessItGivesTheSame) {
  const Beach beach;
  const auto p = beach.points(300);
  SeaBelow now(beach.parts(), 60.0, 1, beach.wakes), apart(beach.parts(), 60.0, 1, beach.wakes);
  const auto all = now.motions(p);
  const auto pressure = apart.motions(p, {false, false, true});
  const auto acceleration = apart.motions(p, {false, true, false});
  const auto velocity = apart.motions(p, {true, false, false});
  for (std::size_t i = 0; i < p.size(); ++i) {
    ASSERT_EQ(pressure[i].pressure_pa, all[i].pressure_pa);
    ASSERT_EQ(acceleration[i].acceleration_mps2, all[i].acceleration_mps2);
    ASSERT_EQ(velocity[i].velocity_mps, all[i].velocity_mps);
  }
}

// Sharp crests are of second order: below a quarter of a wavelength the water moves as under
// linear waves.
TEST(Below, SharpCrestsAreGoneFurtherDown) {
  SeaDescription sharp = one_sine(1.0, 40.0), round = sharp;
  sharp.choppiness = 1.0;
  const Sea sharp_sea(sharp), round_sea(round);
  SeaBelow a({&sharp_sea}, 2.0), b({&round_sea}, 2.0);
  double near = 0.0, deep = 0.0;
  for (int i = 0; i < 40; ++i) {
    const auto off = [&](double z) {
      const glm::dvec3 p(1.3 * i, 0.9 * i, z);
      return static_cast<double>(glm::length(a.motion(p).velocity_mps - b.motion(p).velocity_mps));
    };
    near = std::max(near, off(-1.2));
    deep = std::max(deep, off(-20.0));
  }
  EXPECT_GT(near, 0.02);
  EXPECT_LT(deep, 0.005);
}

// The water of a wake does not go through the floor that the wake has.
TEST(Below, WakesKeepToTheirDepth) {
  SeaDescription calm;
  calm.spectrum = false;
  const Sea sea(calm);
  Disturbance hull;
  hull.kind = DisturbanceKind::kHull;
  hull.path_m = {{-300.0, 0.0}, {300.0, 0.0}};
  hull.path_closed = false;
  hull.hull_m = {6.0, 30.0, 2.0};
  hull.speed_mps = 6.0;
  hull.depth_m = 5.0;
  SeaBelow now({&sea}, 50.0, 1, {&hull, 1});
  double along = 0.0, up = 0.0, middle = 0.0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec2 p(-0.7 * i, 0.2 * i);
    const double surface = now.surface().height(p);
    const WaterMotion floor = now.motion({p, surface - 5.0}), half = now.motion({p, surface - 2.0});
    along = std::max(along, static_cast<double>(std::abs(floor.velocity_mps.x)));
    up = std::max(up, static_cast<double>(std::abs(floor.velocity_mps.z)));
    middle = std::max(middle, static_cast<double>(std::abs(half.velocity_mps.z)));
  }
  EXPECT_GT(along, 0.05);
  EXPECT_GT(middle, 0.02);
  EXPECT_LT(up, 0.05 * middle);
}

TEST(Below, IsStillFarDown) {
  const Sea sea(small_sea());
  SeaBelow now({&sea}, 3.0);
  for (const double z : {-1e3, -1e5, -1e7}) {
    const WaterMotion m = now.motion({10.0, 20.0, z});
    EXPECT_EQ(m.place, MotionPlace::kInWater);
    EXPECT_LT(glm::length(m.velocity_mps), 1e-6f);
    EXPECT_LT(std::abs(m.pressure_pa), 1e-2f);
  }
}

}  // namespace
}  // namespace swell::ocean
