// The water's velocity: circles under one wave, the rate of the heights under many.
#include "ocean/velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "constants.h"

namespace swell::ocean {
namespace {

struct Snapshot {
  Snapshot(const Sea& sea, double t_s) : workers(1) {
    advance(sea, t_s, frame, workers);
    advance_velocity(sea, frame, velocity, workers);
  }
  Workers workers;
  SeaFrame frame;
  VelocityFrame velocity;
};

TEST(Velocity, OneWaveMovesTheWaterOnCircles) {
  SeaDescription description;
  description.spectrum = false;
  description.sines = {{0.7, 40.0, std::numbers::pi / 3.0, 0.4, 0.0}};
  const double k = kTurn / 40.0, omega = std::sqrt(9.81 * k);
  const glm::dvec2 to(std::sin(std::numbers::pi / 3.0), std::cos(std::numbers::pi / 3.0));
  const Sea sea(description);
  for (const double t_s : {-20.0, 0.0, 3.3, 500.0}) {
    const Snapshot now(sea, t_s);
    for (int i = 0; i < 50; ++i) {
      const glm::dvec2 p(3.7 * i, -1.9 * i);
      glm::vec3 v;
      sample_velocities(now.velocity, {&p, 1}, {&v, 1});
      const double phase = k * glm::dot(to, p) - omega * t_s + 0.4;
      EXPECT_NEAR(v.x, 0.7 * omega * to.x * std::sin(phase), 2e-6);
      EXPECT_NEAR(v.y, 0.7 * omega * to.y * std::sin(phase), 2e-6);
      EXPECT_NEAR(v.z, -0.7 * omega * std::cos(phase), 2e-6);
    }
  }
}

SeaDescription windy() {
  SeaDescription description;
  description.resolution = 64;
  description.patch_lengths_m = {640.0, 97.0, 17.0};
  return description;
}

TEST(Velocity, TheUpwardPartIsTheRateOfTheHeights) {
  const Sea sea(windy());
  const double dt_s = 0.005;
  const Snapshot before(sea, 40.0 - dt_s), now(sea, 40.0), after(sea, 40.0 + dt_s);
  for (std::size_t p = 0; p < 3; ++p) {
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < now.frame.patches[p].height_m.size(); ++i) {
      const double rate = (static_cast<double>(after.frame.patches[p].height_m[i]) -
                           before.frame.patches[p].height_m[i]) /
                          (2.0 * dt_s);
      const double got = now.velocity.z.patches[p].height_m[i];
      error += (got - rate) * (got - rate);
      size += rate * rate;
    }
    EXPECT_LT(std::sqrt(error / size), 1e-3) << "patch " << p;
  }
}

// Linear theory at the surface: du/dx + dv/dy + dw/dz = 0 with dw/dz = |k| w, so that the drift's
// divergence is -|k| h', and the drift has no curl. In variance: drift and rise are equal.
TEST(Velocity, DriftAndRiseHaveTheSameEnergyAndDriftHasNoCurl) {
  const Sea sea(windy());
  const Snapshot now(sea, 7.0);
  for (std::size_t p = 0; p < 2; ++p) {
    const PatchFrame &x = now.velocity.x.patches[p], &y = now.velocity.y.patches[p],
                     &z = now.velocity.z.patches[p];
    const int n = x.resolution;
    const auto at = [n](const PatchFrame& f, int i, int j) {
      return static_cast<double>(f.height_m[((j + n) % n) * n + (i + n) % n]);
    };
    double drift = 0.0, rise = 0.0, curl = 0.0, shear = 0.0;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        drift += at(x, i, j) * at(x, i, j) + at(y, i, j) * at(y, i, j);
        rise += at(z, i, j) * at(z, i, j);
        // Around a square of 2 x 2 cells.
        double around = 0.0, apart = 0.0;
        for (int s = -1; s <= 1; ++s) {
          const double weight = s == 0 ? 2.0 : 1.0;  // not to alias the shortest waves
          around += weight * (at(y, i + 1, j + s) - at(y, i - 1, j + s));
          around -= weight * (at(x, i + s, j + 1) - at(x, i + s, j - 1));
          apart += weight * (at(x, i + 1, j + s) - at(x, i - 1, j + s));
          apart += weight * (at(y, i + s, j + 1) - at(y, i + s, j - 1));
        }
        curl += around * around;
        shear += apart * apart;
      }
    }
    // One time is not the mean over times: standing parts exchange drift and rise.
    EXPECT_NEAR(drift / rise, 1.0, 0.2) << "patch " << p;
    EXPECT_LT(curl / shear, 0.05) << "patch " << p;
  }
}

// On the crests the water goes with the wind.
TEST(Velocity, CrestsMoveWithTheWaves) {
  SeaDescription description = windy();
  description.wind_from_rad = std::numbers::pi;  // from the south
  const Snapshot now(Sea(description), 7.0);
  double east = 0.0, north = 0.0;
  for (std::size_t i = 0; i < now.frame.patches[0].height_m.size(); ++i) {
    const double height = now.frame.patches[0].height_m[i];
    east += height * now.velocity.x.patches[0].height_m[i];
    north += height * now.velocity.y.patches[0].height_m[i];
  }
  EXPECT_GT(north, 0.0);
  EXPECT_LT(std::abs(east), 0.3 * north);
}

}  // namespace
}  // namespace swell::ocean
