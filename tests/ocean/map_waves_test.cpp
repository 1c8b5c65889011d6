// Maps as the sea's waves: the sum of their layers, its slopes, its velocities, its loop.
#include "ocean/open_sea/map_waves.h"

#include <gtest/gtest.h>
#include <kiss_fft.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "constants.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/small_recipe.h"
#include "ocean/velocity.h"
#include "ocean/water.h"
#include "scratch_folder.h"

namespace swell::ocean {
namespace {

// A file of a small map.
std::string map_file(const MapRecipe& recipe, const ScratchFolder& folder) {
  return folder.write("waves.map", encode_map(make_periodic_map(recipe))).string();
}

SeaDescription sea_of(std::vector<MapLayer> layers) {
  SeaDescription description;
  description.spectrum = false;
  description.maps = std::move(layers);
  description.tiling = false;
  return description;
}

SeaDescription sea_of_set(MapSet set) {
  SeaDescription description;
  description.spectrum = false;
  description.map_set = set;
  return description;
}

float height_at(const SeaFrame& frame, glm::dvec2 p) {
  float z = 0.0f;
  sample_heights(frame, {&p, 1}, {&z, 1});
  return z;
}

// The sum of the formula, straight from the codes: bilinear in place, the four frames'
// cubic in time.
double reference_height(const MapLayer& layer, const PeriodicMap& map, double period_s,
                        glm::dvec2 p, double t_s) {
  const auto bilinear = [&](int frame) {
    const auto code = [&](int i, int j) {
      const auto wrapped = [&](int x) { return ((x % map.size) + map.size) % map.size; };
      return static_cast<double>(map.height[static_cast<std::size_t>(
          (frame * map.size + wrapped(j)) * map.size + wrapped(i))]);
    };
    const glm::dvec2 at = (p + layer.offset_m) / layer.length_m * static_cast<double>(map.size);
    const double u = at.x, v = at.y;
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    const double x = u - i, y = v - j;
    return (1 - y) * ((1 - x) * code(i, j) + x * code(i + 1, j)) +
           y * ((1 - x) * code(i, j + 1) + x * code(i + 1, j + 1));
  };
  const double at = (t_s + layer.offset_s) / period_s * map.frames;
  const double f = std::floor(at), s = at - f;
  const auto frame = [&](int by) {
    const int n = static_cast<int>(f) + by;
    return bilinear(((n % map.frames) + map.frames) % map.frames);
  };
  const double a = frame(-1), b = frame(0), c = frame(1), d = frame(2);
  const double h = 0.5 * (2 * b + (c - a) * s + (2 * a - 5 * b + 4 * c - d) * s * s +
                          (3 * b - 3 * c + d - a) * s * s * s);
  return 0.25 * layer.hs_m / std::sqrt(map.variance) * h * static_cast<double>(map.height_scale);
}

TEST(MapWaves, HeightsAreTheSumOfTheLayers) {
  const ScratchFolder folder;
  const std::string file = map_file(small_recipe(), folder);
  const PeriodicMap map = read_map(file);
  // Offsets of whole samples: 96 m and 32 samples, 64 and 40 m and 32.
  const std::vector<MapLayer> layers = {{file, glm::dvec2(96.0), 31.0, 1.5, {27.0, -6.0}, 2.5},
                                        {file, {64.0, 40.0}, 17.0, 0.8, {-130.0, 5.0}, -40.0}};
  const Sea sea(sea_of(layers));
  Workers workers(2);
  SeaFrame frame;
  for (const double t_s : {0.0, 3.7, -250.0}) {
    advance(sea, t_s, frame, workers);
    for (int n = 0; n < 40; ++n) {
      const glm::dvec2 p(-300.0 + 17.3 * n, 211.0 - 9.1 * n);
      double expected = 0.0;
      for (const MapLayer& layer : layers)
        expected += reference_height(layer, map, layer.period_s, p, t_s);
      EXPECT_NEAR(height_at(frame, p), expected, 1e-4) << t_s << " " << n;
    }
  }
}

TEST(MapWaves, HeightAndLengthAreThoseAskedFor) {
  const ScratchFolder folder;
  const std::string file = map_file(small_recipe(), folder);
  SeaDescription description = sea_of({{file, glm::dvec2(80.0), 0.0, 2.0}});
  description.amplitude_scale = 0.5;
  const Sea sea(description);
  EXPECT_NEAR(sea.significant_height_m(), 1.0, 1e-3);
  Workers workers(1);
  SeaFrame frame;
  advance(sea, 12.0, frame, workers);
  ASSERT_EQ(frame.patches.size(), 1u);
  const PatchFrame& patch = frame.patches[0];
  EXPECT_EQ(patch.length_m, glm::dvec2(80.0));
  EXPECT_EQ(patch.resolution, 32);
  double height2 = 0.0, slope2 = 0.0, most = 0.0;
  for (std::size_t i = 0; i < patch.height_m.size(); ++i) {
    height2 += static_cast<double>(patch.height_m[i]) * patch.height_m[i];
    slope2 += static_cast<double>(patch.slope_x[i]) * patch.slope_x[i] +
              static_cast<double>(patch.slope_y[i]) * patch.slope_y[i];
    most = std::max(most, static_cast<double>(std::abs(patch.height_m[i])));
  }
  EXPECT_NEAR(height2 / 1024.0, 1.0 / 16.0, 0.005);
  EXPECT_NEAR(slope2 / 1024.0, patch.slope_variance, 0.15 * patch.slope_variance);
  EXPECT_LE(most, 1.01 * sea.height_bound_m());
}

// A long wave alone runs as fast as in deep water.
TEST(MapWaves, TheDefaultPeriodIsThatOfDeepWater) {
  MapRecipe recipe = small_recipe();
  recipe.first = FirstDisturbance::kHeights;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i)
      recipe.heights.push_back(static_cast<float>(std::cos(kTurn * 2 * i / 32.0)));
  const ScratchFolder folder;
  const std::string file = map_file(recipe, folder);
  const Sea sea(sea_of({{file, glm::dvec2(100.0), 0.0, 1.0}}));
  const MapWaves& waves = sea.state().maps[0];
  EXPECT_NEAR(waves.wave_number_rad_m(), kTurn / 50.0, 0.01 * kTurn / 50.0);
  const double speed_mps = std::sqrt(9.81 * 50.0 / kTurn);
  EXPECT_NEAR(waves.map->travel * 100.0 * waves.loops_per_s, speed_mps, 0.01 * speed_mps);
}

struct Moment {
  Moment(const Sea& sea, double t_s, int threads = 1) : workers(threads) {
    advance(sea, t_s, frame, workers);
    advance_velocity(sea, frame, velocity, workers);
  }
  Workers workers;
  SeaFrame frame;
  VelocityFrame velocity;
};

TEST(MapWaves, TheUpwardVelocityIsTheRateOfTheHeights) {
  const Sea sea(sea_of_set(MapSet::kOcean));
  const double dt_s = 0.002;
  const Moment before(sea, 7.0 - dt_s), now(sea, 7.0), after(sea, 7.0 + dt_s);
  double error = 0.0, size = 0.0, drift = 0.0, drift2 = 0.0, height2 = 0.0;
  for (int n = 0; n < 500; ++n) {
    const glm::dvec2 p(13.1 * n, 7.7 * n);
    glm::vec3 v;
    sample_velocities(now.velocity, {&p, 1}, {&v, 1});
    const double rate = (height_at(after.frame, p) - height_at(before.frame, p)) / (2.0 * dt_s);
    error += (rate - v.z) * (rate - v.z);
    size += rate * rate;
    // The wind comes from the north: on crests the water goes south.
    const double z = height_at(now.frame, p);
    drift += -static_cast<double>(v.y) * z;
    drift2 += static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y;
    height2 += z * z;
  }
  EXPECT_LT(std::sqrt(error / size), 0.01);
  EXPECT_GT(drift / std::sqrt(drift2 * height2), 0.5);
  // Circles: as fast to the side as up and down.
  EXPECT_NEAR(std::sqrt(drift2 / size), 1.0, 0.15);
}

TEST(MapWaves, SlopesAreThoseOfTheSurface) {
  const Sea sea(sea_of_set(MapSet::kCoast));
  const Moment now(sea, 3.0);
  double error = 0.0, size = 0.0;
  for (int n = 0; n < 400; ++n) {
    const glm::dvec2 p(5.3 * n, -3.1 * n), dx(0.05, 0.0), dy(0.0, 0.05);
    float x = 0.0f, y = 0.0f;
    sample_slopes(now.frame, {&p, 1}, {&x, 1}, {&y, 1});
    const double to_x = (height_at(now.frame, p + dx) - height_at(now.frame, p - dx)) / 0.1;
    const double to_y = (height_at(now.frame, p + dy) - height_at(now.frame, p - dy)) / 0.1;
    error += (to_x - x) * (to_x - x) + (to_y - y) * (to_y - y);
    size += to_x * to_x + to_y * to_y;
  }
  // Heights are bilinear between samples, slopes are not.
  EXPECT_LT(std::sqrt(error / size), 0.2);
}

TEST(MapWaves, ThreadsAndLoopsGiveTheSameBits) {
  SeaDescription description = sea_of_set(MapSet::kLake);
  description.loop_s = 25.0;
  const Sea sea(description);
  const Moment alone(sea, 3.25), together(sea, 3.25, 4), later(sea, 3.25 + 4 * 25.0);
  for (const Moment* other : {&together, &later})
    for (std::size_t p = 0; p < alone.frame.patches.size(); ++p) {
      EXPECT_EQ(alone.frame.patches[p].height_m, other->frame.patches[p].height_m);
      EXPECT_EQ(alone.frame.patches[p].slope_y, other->frame.patches[p].slope_y);
      EXPECT_EQ(alone.velocity.x.patches[p].height_m, other->velocity.x.patches[p].height_m);
      EXPECT_EQ(alone.velocity.z.patches[p].height_m, other->velocity.z.patches[p].height_m);
    }
}

TEST(MapWaves, StandBesideTheSpectrum) {
  SeaDescription description = sea_of_set(MapSet::kLake);
  description.tiling = false;
  const Sea maps(description);
  description.spectrum = true;
  description.patch_lengths_m = {200.0};
  description.resolution = 32;
  const Sea both(description);
  description.map_set = MapSet::kNone;
  const Sea spectrum(description);
  const Moment b(both, 9.0), s(spectrum, 9.0), m(maps, 9.0);
  ASSERT_EQ(b.frame.patches.size(), 8u);
  for (int n = 0; n < 50; ++n) {
    const glm::dvec2 p(3.3 * n, 1.1 * n);
    EXPECT_NEAR(height_at(b.frame, p), height_at(s.frame, p) + height_at(m.frame, p), 1e-5);
    glm::vec3 vb, vs, vm;
    sample_velocities(b.velocity, {&p, 1}, {&vb, 1});
    sample_velocities(s.velocity, {&p, 1}, {&vs, 1});
    sample_velocities(m.velocity, {&p, 1}, {&vm, 1});
    EXPECT_LT(glm::length(vb - vs - vm), 1e-5f);
  }
  EXPECT_NEAR(both.height_bound_m(), spectrum.height_bound_m() + maps.height_bound_m(), 1e-9);
}

TEST(MapWaves, BadLayersAreRefused) {
  const ScratchFolder folder;
  const std::string file = map_file(small_recipe(), folder);
  const auto refused = [&](auto change) {
    MapLayer layer{file};
    change(layer);
    EXPECT_THROW(Sea{sea_of({layer})}, std::invalid_argument);
  };
  refused([](MapLayer& layer) { layer.file = "/none/such.map"; });
  refused([](MapLayer& layer) { layer.length_m = glm::dvec2(0.0); });
  refused([](MapLayer& layer) { layer.length_m.y = -20.0; });
  refused([](MapLayer& layer) { layer.length_m.x = NAN; });
  refused([](MapLayer& layer) { layer.period_s = -1.0; });
  refused([](MapLayer& layer) { layer.hs_m = NAN; });
  refused([](MapLayer& layer) { layer.offset_m.y = INFINITY; });
  SeaDescription many = sea_of_set(MapSet::kLake);
  many.maps = {MapLayer{file}};
  EXPECT_NO_THROW(Sea{many});
  many.maps.push_back(MapLayer{file});
  EXPECT_THROW(Sea{many}, std::invalid_argument);
  many.maps.clear();
  many.spectrum = true;
  EXPECT_THROW(Sea{many}, std::invalid_argument);
}

// ---- PER-04

using Spectrum = std::vector<kiss_fft_cpx>;

// The normalised autocorrelation along lines of `count` points that go by `step_m`, in the mean
// over some lines: unbiased, by lag.
std::vector<double> autocorrelation(const SeaFrame& frame, glm::dvec2 step_m, std::size_t count) {
  const int lines = static_cast<int>(std::clamp<std::size_t>(200000 / count, 2, 24));
  const std::size_t padded = 2 * count;
  const auto plan = [&](int inverse) {
    return kiss_fft_alloc(static_cast<int>(padded), inverse, nullptr, nullptr);
  };
  const kiss_fft_cfg forward = plan(0), backward = plan(1);
  std::vector<double> sums(count);
  for (int line = 0; line < lines; ++line) {
    std::vector<glm::dvec2> p(count);
    const glm::dvec2 aside(-step_m.y, step_m.x);
    for (std::size_t i = 0; i < count; ++i)
      p[i] = step_m * static_cast<double>(i) + aside * (97.3 * line);
    std::vector<float> z(count);
    sample_heights(frame, p, z);
    Spectrum values(padded, {0.0f, 0.0f}), spectrum(padded);
    for (std::size_t i = 0; i < count; ++i) values[i].r = z[i];
    kiss_fft(forward, values.data(), spectrum.data());
    for (kiss_fft_cpx& c : spectrum) c = {c.r * c.r + c.i * c.i, 0.0f};
    kiss_fft(backward, spectrum.data(), values.data());
    for (std::size_t lag = 0; lag < count; ++lag)
      sums[lag] += static_cast<double>(values[lag].r) / static_cast<double>(count - lag);
  }
  kiss_fft_free(forward);
  kiss_fft_free(backward);
  const double first = sums[0];
  for (double& sum : sums) sum /= first;
  return sums;
}

// The largest correlation from three of the mean wavelengths on to 4 km, along axes, on which the
// maps' periods lie, and across them.
double largest_repetition(const Sea& sea, const SeaFrame& frame) {
  const double wavelength_m = sea.mean_wavelength_m(), step_m = wavelength_m / 6.0;
  const auto most = static_cast<std::size_t>(4000.0 / step_m);
  std::size_t count = 1024;
  while (count < 2 * most) count *= 2;
  double largest = 0.0;
  for (const glm::dvec2& direction : {glm::dvec2(1.0, 0.0), {0.0, 1.0}, {0.7071, 0.7071}}) {
    const std::vector<double> by_lag = autocorrelation(frame, step_m * direction, count);
    for (std::size_t lag = 18; lag <= most; ++lag) largest = std::max(largest, by_lag[lag]);
  }
  return largest;
}

TEST(MapWaves, TheSetsDoNotShowTheirPeriods) {
  for (const MapSet set : {MapSet::kRiver, MapSet::kLake, MapSet::kCoast, MapSet::kOcean}) {
    SeaDescription description = sea_of_set(set);
    const Sea tiled(description);
    description.tiling = false;
    const Sea plain(description);
    EXPECT_LE(largest_repetition(tiled, Moment(tiled, 20.0).frame), 0.2) << static_cast<int>(set);
    // What the measure says of the same layers one beside the other without end.
    EXPECT_GT(largest_repetition(plain, Moment(plain, 20.0).frame), 0.5) << static_cast<int>(set);
  }
}

}  // namespace
}  // namespace swell::ocean
