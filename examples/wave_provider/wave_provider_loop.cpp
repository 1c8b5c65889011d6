// A simulator's loop in small: a raft of four floats rides the waves with a fixed step.
//   wave_provider_loop SCENE.toml [SECONDS]
// Fails if the waves in between the provider's steps are off by more than 5 mm.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "wave_provider.h"

namespace {

constexpr double kStep_s = 1.0 / 250.0;  // of the physics
constexpr double kGravity_mps2 = 9.81;

// A raft that goes up and down only, carried by floats at its corners.
struct Raft {
  double height_m = 0.0, rise_mps = 0.0;
  static constexpr double kMass_kg = 400.0, kDamping_kg_s = 900.0;
  static constexpr double kFloatArea_m2 = 0.25;  // of each of the four

  void step(const std::vector<WaterSample>& water) {
    double force_n = -kMass_kg * kGravity_mps2;
    for (const WaterSample& w : water) {
      const double depth_m = std::clamp(w.elevation_m - height_m + 0.4, 0.0, 0.8);
      force_n += 1025.0 * kGravity_mps2 * kFloatArea_m2 * depth_m;
      if (depth_m > 0.0) force_n += 0.25 * kDamping_kg_s * (w.velocity_mps[2] - rise_mps);
    }
    rise_mps += force_n / kMass_kg * kStep_s;
    height_m += rise_mps * kStep_s;
  }
};

int run(const char* scene, double seconds) {
  WaveProvider waves(scene);
  WaveProvider exact(scene, 0.0, kStep_s);  // steps where the physics has its own
  const std::vector<Point> corners = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
  Raft raft;
  double most_off_m = 0.0;
  const auto start = std::chrono::steady_clock::now();
  const long steps = std::lround(seconds / kStep_s);
  for (long k = 0; k < steps; ++k) {
    const double t_s = static_cast<double>(k) * kStep_s;  // not summed up: no drift
    raft.step(waves.samples(corners, t_s));
    if (k % 250 == 0)
      std::printf("t %6.2f s: water %+.2f m, raft %+.2f m, 3 m down the water rises by %+.2f m/s\n",
                  t_s, waves.elevation(0, 0, t_s), raft.height_m,
                  waves.velocities_below({{0, 0, -3}}, t_s)[0][2]);
  }
  const double took_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (long k = 0; k < 40; ++k) {
    const double t_s = static_cast<double>(k) * kStep_s;
    most_off_m =
        std::max(most_off_m, std::abs(waves.elevation(3, 4, t_s) - exact.elevation(3, 4, t_s)));
  }
  std::printf("%ld steps of %.0f ms in %.2f s: %.1f times real time; blending is off by %.2f mm\n",
              steps, 1e3 * kStep_s, took_s, seconds / took_s, 1e3 * most_off_m);
  return most_off_m < 0.005 && std::abs(raft.height_m) < 10.0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "wave_provider_loop SCENE.toml [SECONDS]\n"), 2;
  try {
    return run(argv[1], argc > 2 ? std::atof(argv[2]) : 10.0);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "error: %s\n", error.what()), 1;
  }
}
