// Waves measured in what is drawn: the depth buffer of cameras that look straight down, over time.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "constants.h"
#include "ocean/coast/coast.h"
#include "render/shot.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

// A row or a column of pixels that looks straight down from (x, y, height), north on top, `reach_m`
// to either side along its longer axis.
View look_down(glm::dvec3 eye, double reach_m, int width_px, int height_px) {
  const double up = reach_m / eye.z * std::min(1.0, height_px / static_cast<double>(width_px));
  return make_view(eye, 0.0, -0.5 * std::numbers::pi, 2.0 * std::atan(up), 0.25f, width_px,
                   height_px);
}

// Draws frames and tells where in the world the surface of a pixel is.
struct Film : Shot {
  Film(const scene::Scene& scene, const View& seen) : world(scene), camera(seen) {}

  void draw(double t_s) { Shot::draw(world, camera, t_s, {.water_triangles = 20000}); }

  glm::dvec3 surface_at(int x_px, int y_px) const {
    const VisibilityBuffer& seen = state().visibility;
    const int side = seen.grid.tile_size_px;
    const int tile = (y_px / side) * seen.grid.tiles_x + x_px / side;
    const std::size_t in_tile = static_cast<std::size_t>(y_px % side * side + x_px % side);
    const double depth_m = view.near_m / static_cast<double>(seen.depth_of(tile)[in_tile]);
    const float x = static_cast<float>(x_px) + 0.5f, y = static_cast<float>(y_px) + 0.5f;
    return view.eye_world + depth_m * glm::dvec3(view.ray(x, y));
  }

  World world;
  View camera;
};

// Where f is largest in [low, high].
template <class F>
double find_maximum(double low, double high, F f) {
  for (int round = 0; round < 5; ++round) {
    double best = low, best_value = -std::numeric_limits<double>::infinity();
    const double step = (high - low) / 30.0;
    for (int n = 0; n <= 30; ++n) {
      const double value = f(low + n * step);
      if (value > best_value) best_value = value, best = low + n * step;
    }
    low = best - step, high = best + step;
  }
  return 0.5 * (low + high);
}

// Hann's window, so that a wave's neighbours do not disturb it.
double window(int n, int count) { return 1.0 - std::cos(kTurn * (n + 0.5) / count); }

// Heights of `places` at `times` times, dt_s apart.
struct Record {
  double dt_s;
  std::vector<std::vector<double>> z;  // by time, by place

  std::complex<double> swing(double omega, std::size_t place) const {
    std::complex<double> sum = 0.0;
    for (std::size_t n = 0; n < z.size(); ++n)
      sum += window(static_cast<int>(n), static_cast<int>(z.size())) * z[n][place] *
             std::polar(1.0, omega * dt_s * static_cast<double>(n));
    return sum;
  }
};

// Height by linear interpolation of a line of surface points, ascending along `axis`.
double height_on_line(const std::vector<glm::dvec3>& line, int axis, double at) {
  std::size_t n = 1;
  while (n + 1 < line.size() && line[n][axis] < at) ++n;
  const double f = (at - line[n - 1][axis]) / (line[n][axis] - line[n - 1][axis]);
  return line[n - 1].z + f * (line[n].z - line[n - 1].z);
}

// Two swells that run east over each other: each has the period and the speed of deep water.
TEST(DrawnWaves, SinesHaveThePeriodAndSpeedOfDeepWater) {
  scene::Scene scene;
  scene.sea.spectrum = false;
  const double east = 0.5 * std::numbers::pi;
  scene.sea.sines = {{0.8, 60.0, east, 0.3, 0.0}, {0.3, 22.0, east, 1.0, 0.0}};
  scene.area.size_m = {10000.0, 10000.0};
  Film film(scene, look_down({20.0, 10.0, 100.0}, 200.0, 512, 4));
  Record record{0.4, {}};
  constexpr int kPlaces = 360;
  for (int n = 0; n < 128; ++n) {  // 51 s
    film.draw(record.dt_s * n);
    std::vector<glm::dvec3> row;
    for (int x = 0; x < 512; ++x) row.push_back(film.surface_at(x, 2));
    auto& z = record.z.emplace_back();
    for (int i = 0; i < kPlaces; ++i) z.push_back(height_on_line(row, 0, -160.0 + i));
  }
  for (const ocean::SineWave& sine : scene.sea.sines) {
    const double k_scene = kTurn / sine.wavelength_m, omega_deep = std::sqrt(kG * k_scene);
    const double omega = find_maximum(0.8 * omega_deep, 1.2 * omega_deep, [&](double w) {
      return std::abs(record.swing(w, 100)) + std::abs(record.swing(w, 200));
    });
    std::vector<std::complex<double>> swings;
    for (int i = 0; i < kPlaces; ++i) swings.push_back(record.swing(omega, i));
    const double k = find_maximum(0.8 * k_scene, 1.2 * k_scene, [&](double q) {
      std::complex<double> sum = 0.0;
      for (int i = 0; i < kPlaces; ++i)
        sum += window(i, kPlaces) * swings[i] * std::polar(1.0, -q * i);
      return std::abs(sum);
    });
    EXPECT_NEAR(k / k_scene, 1.0, 0.01) << sine.wavelength_m;
    EXPECT_NEAR(omega / std::sqrt(kG * k), 1.0, 0.01) << sine.wavelength_m;
    EXPECT_NEAR(omega / k / std::sqrt(kG / k_scene), 1.0, 0.01) << sine.wavelength_m;
  }
}

// One train on a beach of 1:40 that deepens to the north, seen as one column of pixels: the same
// period everywhere, and at each depth the wave number and speed of the dispersion relation.
TEST(DrawnWaves, ATrainHasThePeriodAndSpeedOfItsDepth) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 6.0;
  scene.area.size_m = {10000.0, 10000.0};
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-1000.0, 0.0}, {1000.0, 0.0}};
  scene.terrain->beach_slope = 0.025;
  scene.terrain->beach_size_m = 2400.0;  // trains end within three tenths of its rim
  scene.coast.grid_spacing_m = 4.5;
  scene.terrain->floor_depth_m = 30.0;
  scene.terrain->centre_m = {0.0, 400.0};
  scene.coast.model = scene::CoastModel::kTrains;
  scene.coast.trains = 1;
  Film film(scene, look_down({0.0, 200.0, 150.0}, 200.0, 16, 640));
  Record record{0.4, {}};
  const std::vector<double> depths_m = {8.0, 5.0, 3.0, 1.5};
  constexpr double kStep_m = 2.5;
  for (int n = 0; n < 80; ++n) {  // 32 s
    film.draw(record.dt_s * n);
    std::vector<glm::dvec3> west, east;
    for (int y = 639; y >= 0; --y) {
      west.push_back(film.surface_at(0, y));
      east.push_back(film.surface_at(15, y));
    }
    auto& z = record.z.emplace_back();
    for (const double depth_m : depths_m) {
      const double y = 40.0 * depth_m;
      z.push_back(height_on_line(west, 1, y));
      z.push_back(height_on_line(east, 1, y));
      z.push_back(height_on_line(east, 1, y - kStep_m));
      z.push_back(height_on_line(east, 1, y + kStep_m));
    }
  }
  const double width_m = film.surface_at(15, 320).x - film.surface_at(0, 320).x;
  const double omega_train = kTurn / film.world.state().coast->trains.period_s.front();
  for (std::size_t i = 0; i < depths_m.size(); ++i) {
    const auto swing = [&](double omega, std::size_t n) { return record.swing(omega, 4 * i + n); };
    const double omega = find_maximum(0.8 * omega_train, 1.2 * omega_train,
                                      [&](double w) { return std::abs(swing(w, 0)); });
    EXPECT_NEAR(omega / omega_train, 1.0, 1e-3) << depths_m[i];
    const double k_x = std::arg(swing(omega, 1) / swing(omega, 0)) / width_m;
    const double k_y = std::arg(swing(omega, 3) / swing(omega, 2)) / (2.0 * kStep_m);
    const double k = std::hypot(k_x, k_y);
    EXPECT_NEAR(kG * k * std::tanh(k * depths_m[i]) / (omega * omega), 1.0, 0.01) << depths_m[i];
  }
}

}  // namespace
}  // namespace swell::render
