#include "apps/view/wave_choice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swell::view {
namespace {

scene::Scene windy() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 12.0;
  scene.sea.wind_from_rad = 0.5;
  return scene;
}

TEST(WaveChoice, ReadsTheModelFromTheScene) {
  scene::Scene scene = windy();
  EXPECT_EQ(wave_choice(scene), (WaveChoice{WaveModel::kSpectrum, 12.0, 0.5}));
  scene.sea.sines = {{.amplitude_m = 1.0}};
  EXPECT_EQ(wave_choice(scene).model, WaveModel::kBoth);
  scene.sea.spectrum = false;
  EXPECT_EQ(wave_choice(scene).model, WaveModel::kSines);
}

TEST(WaveChoice, TheScenesOwnChoiceChangesNothing) {
  scene::Scene scene = windy();
  scene.sea.sines = {{.amplitude_m = 1.0, .wavelength_m = 40.0}};
  const scene::Scene same = with_waves(scene, wave_choice(scene));
  EXPECT_EQ(same.sea.spectrum, scene.sea.spectrum);
  EXPECT_EQ(same.sea.wind_speed_mps, scene.sea.wind_speed_mps);
  ASSERT_EQ(same.sea.sines.size(), 1u);
  EXPECT_EQ(same.sea.sines[0].wavelength_m, 40.0);
}

TEST(WaveChoice, EachModelHasExactlyItsWaves) {
  const auto sea_of = [](WaveModel model) { return with_waves(windy(), {model, 8.0, 1.0}).sea; };
  EXPECT_TRUE(sea_of(WaveModel::kSpectrum).spectrum);
  EXPECT_TRUE(sea_of(WaveModel::kSpectrum).sines.empty());
  EXPECT_FALSE(sea_of(WaveModel::kSines).spectrum);
  EXPECT_FALSE(sea_of(WaveModel::kSines).sines.empty());
  EXPECT_TRUE(sea_of(WaveModel::kBoth).spectrum);
  EXPECT_FALSE(sea_of(WaveModel::kBoth).sines.empty());
}

TEST(WaveChoice, ASeaStateMakesTheSeaOfItsSceneFile) {
  for (int code = 0; code <= 9; ++code) {
    const scene::Scene file =
        scene::parse_scene("sea.douglas = " + std::to_string(code) + "\n", "state.toml");
    WaveChoice choice = wave_choice(scene::Scene());
    choice.sea_state = code;
    const scene::Scene chosen = with_waves(scene::Scene(), choice);
    EXPECT_EQ(chosen.sea, file.sea) << code;
    EXPECT_EQ(chosen.douglas, code);
    EXPECT_EQ(wind_speed_mps(scene::Scene(), choice), file.sea.wind_speed_mps);
  }
}

TEST(WaveChoice, AWindTakesThePlaceOfASeaState) {
  const scene::Scene rough = scene::parse_scene("sea.douglas = 5\n", "state.toml");
  WaveChoice choice = wave_choice(rough);
  EXPECT_EQ(choice.sea_state, 5);
  EXPECT_EQ(with_waves(rough, choice).sea, rough.sea);
  choice.sea_state.reset();
  choice.wind_speed_mps = 3.0;
  const scene::Scene calm = with_waves(rough, choice);
  EXPECT_EQ(calm.douglas, std::nullopt);
  EXPECT_EQ(calm.sea.wind_speed_mps, 3.0);
  EXPECT_EQ(scene::parse_scene(scene::dump_scene(calm), "calm.toml").sea, calm.sea);
}

TEST(WaveChoice, NamesSayWhatTheSceneHas) {
  scene::Scene scene = windy();
  EXPECT_STREQ(wave_names(scene)[WaveModel::kSpectrum], "spectrum");
  scene.coast.model = scene::CoastModel::kBlend;
  EXPECT_STREQ(wave_names(scene)[WaveModel::kSpectrum], "spectrum") << "no terrain, no coast";
  scene.terrain.emplace();
  EXPECT_STREQ(wave_names(scene)[WaveModel::kSpectrum], "spectrum and trains");
  EXPECT_STREQ(wave_names(scene)[WaveModel::kSines], "sines and trains");
  scene.coast.model = scene::CoastModel::kTrains;
  EXPECT_STREQ(wave_names(scene)[WaveModel::kSpectrum], "trains, spectrum beyond");
}

TEST(WaveChoice, NoChoiceTakesTheCoastAway) {
  scene::Scene scene = windy();
  scene.terrain.emplace();
  scene.coast = {.model = scene::CoastModel::kBlend, .trains = 7, .seed = 9};
  for (const WaveModel model : {WaveModel::kSpectrum, WaveModel::kSines, WaveModel::kBoth})
    EXPECT_EQ(with_waves(scene, {model, 5.0, 2.0}).coast, scene.coast);
}

TEST(WaveChoice, WavesOfASceneWithoutAnyRunWithTheWindAndDoNotBreak) {
  const double from_rad = 1.0;
  for (const ocean::SineWave& wave :
       with_waves(windy(), {WaveModel::kSines, 8.0, from_rad}).sea.sines) {
    EXPECT_LT(std::cos(wave.to_rad - from_rad), -0.8);
    EXPECT_LT(2.0 * wave.amplitude_m / wave.wavelength_m, 0.142);  // height over length, Michell
  }
}

}  // namespace
}  // namespace swell::view
