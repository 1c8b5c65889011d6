// The noise of sensors: mean and variance against the model, and what it depends on.
#include "render/picture/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/shot.h"

namespace swell::render {
namespace {

constexpr std::size_t kPatch = 40000;  // pixels

struct Moments {
  double mean = 0.0, variance = 0.0;
};

Moments moments_of(const std::vector<float>& values) {
  Moments m;
  for (const float value : values) m.mean += static_cast<double>(value);
  m.mean /= static_cast<double>(values.size());
  for (const float value : values)
    m.variance += (static_cast<double>(value) - m.mean) * (static_cast<double>(value) - m.mean);
  m.variance /= static_cast<double>(values.size());
  return m;
}

std::vector<float> noisy(float light, float exposure, const scene::SensorNoise& noise,
                         double t_s = 1.0) {
  std::vector<float> patch(3 * kPatch, light);
  add_sensor_noise(noise, t_s, exposure, 0, patch);
  return patch;
}

double correlation(const std::vector<float>& a, const std::vector<float>& b, std::size_t shift) {
  const Moments ma = moments_of(a), mb = moments_of(b);
  double sum = 0.0;
  for (std::size_t i = 0; i + shift < a.size(); ++i)
    sum += (static_cast<double>(a[i]) - ma.mean) * (static_cast<double>(b[i + shift]) - mb.mean);
  return sum / static_cast<double>(a.size()) / std::sqrt(ma.variance * mb.variance);
}

// Electrons e: mean e, variance e + read^2, in light over what an electron is worth.
TEST(SensorNoise, OfAFlatPatchHasTheModelsMeanAndVariance) {
  const float exposure = 1.6f;
  for (const double iso : {100.0, 800.0})
    for (const float light : {0.002f, 0.1f, 0.6f, 2.0f}) {
      const scene::SensorNoise noise = {
          .full_well_e = 20000.0, .iso = iso, .read_noise_e = 4.0, .seed = 3};
      const double per_light = 20000.0 / 8.0 * 100.0 / iso * static_cast<double>(exposure);
      EXPECT_DOUBLE_EQ(electrons_of_unit_light(noise), 20000.0 / 8.0 * 100.0 / iso);
      const double electrons = static_cast<double>(light) * per_light;
      const double variance = (electrons + 16.0) / (per_light * per_light);
      const Moments found = moments_of(noisy(light, exposure, noise));
      EXPECT_NEAR(found.mean, static_cast<double>(light), 4.0 * std::sqrt(variance / 120000.0))
          << light;
      EXPECT_NEAR(found.variance, variance, 0.02 * variance) << light;
    }
}

TEST(SensorNoise, NeverExceedsTheFullWell) {
  const scene::SensorNoise noise = {
      .full_well_e = 1000.0, .iso = 100.0, .read_noise_e = 3.0, .seed = 1};
  for (const float light : noisy(100.0f, 2.0f, noise)) EXPECT_LE(light, 4.0f);
}

TEST(SensorNoise, OfOtherSeedsTimesPixelsAndChannelsIsAnother) {
  scene::SensorNoise noise = {.full_well_e = 5000.0, .iso = 100.0, .read_noise_e = 3.0, .seed = 1};
  const std::vector<float> one = noisy(0.5f, 1.0f, noise);
  EXPECT_EQ(noisy(0.5f, 1.0f, noise), one);
  EXPECT_NEAR(correlation(one, noisy(0.5f, 1.0f, noise, 1.0 + 1e-9), 0), 0.0, 0.015);
  noise.seed = 2;
  EXPECT_NEAR(correlation(one, noisy(0.5f, 1.0f, noise), 0), 0.0, 0.015);
  for (const std::size_t shift : {1u, 2u, 3u, 6u, 300u})
    EXPECT_NEAR(correlation(one, one, shift), 0.0, 0.015) << shift;
}

TEST(SensorNoise, IsThatOfThePixelsPlaceInThePicture) {
  const scene::SensorNoise noise = {
      .full_well_e = 5000.0, .iso = 200.0, .read_noise_e = 3.0, .seed = 1};
  const std::vector<float> whole = noisy(0.5f, 1.0f, noise);
  std::vector<float> part(300, 0.5f);
  add_sensor_noise(noise, 1.0, 1.0f, 1000, part);
  for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(part[i], whole[3000 + i]);
}

TEST(SensorNoise, OfAPictureIsAddedToItsLightAlone) {
  const World& world = shipped_world("buoys");
  const View view = view_of(world, 4.0, 96, 54);
  FrameOptions options;
  options.keep_linear = true;
  options.labels = LabelSet::all();
  const Shot clean(world, view, 4.0, options);
  options.noise =
      scene::SensorNoise{.full_well_e = 8000.0, .iso = 400.0, .read_noise_e = 5.0, .seed = 9};
  const Shot drawn(world, view, 4.0, options), again(world, view, 4.0, options, 3);
  std::vector<float> expected = clean.target.linear;
  add_sensor_noise(*options.noise, 4.0, clean.target.exposure, 0, expected);
  EXPECT_EQ(drawn.target.linear, expected);
  EXPECT_EQ(drawn.target.labels.depth_m, clean.target.labels.depth_m);
  EXPECT_EQ(drawn.target.labels.normal, clean.target.labels.normal);
  EXPECT_EQ(picture_hash(drawn.target), picture_hash(again.target));
  EXPECT_NE(picture_hash(drawn.target), picture_hash(clean.target));
}

TEST(SensorNoise, OfNoFullWellIsNone) {
  scene::Scene scene = load_shipped("buoys");
  const World quiet(scene);
  scene.camera.noise = {.full_well_e = 0.0, .iso = 6400.0, .read_noise_e = 50.0, .seed = 4};
  const World same(scene, quiet, 2);
  scene.camera.noise.full_well_e = 3000.0;
  const World loud(scene, quiet, 2);
  const View view = view_of(quiet, 4.0, 96, 54);
  const std::uint64_t hash = picture_hash(Shot(quiet, view, 4.0).target);
  EXPECT_EQ(picture_hash(Shot(same, view, 4.0).target), hash);
  const Shot noisy_shot(loud, view, 4.0);
  EXPECT_NE(picture_hash(noisy_shot.target), hash);
  EXPECT_TRUE(noisy_shot.target.linear.empty());
  FrameOptions options;
  options.noise = scene::SensorNoise{};
  options.shading = scene::ShadingRate::kAdaptive;
  EXPECT_EQ(picture_hash(Shot(loud, view, 4.0, options).target),
            picture_hash(Shot(quiet, view, 4.0, options).target));
}

}  // namespace
}  // namespace swell::render
