// Kinds of sea water against published tables.
#include "scene/water_types.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "math/elementary.h"
#include "scene/scene.h"

namespace swell::scene {
namespace {

// attenuation: of daylight at 650, 550 and 450 nm [1/m]. Source: Jerlov, Marine Optics, 1976.
// secchi_m and colour (pi times the reflectance, linear sRGB, of whole spectra) by the theories
// that the functions name, worked out elsewhere.
struct Known {
  WaterType type;
  glm::dvec3 attenuation;
  double secchi_m;
  glm::dvec3 colour;
};

constexpr std::array<Known, 10> kKnown = {{
    {WaterType::kI, {0.360, 0.063, 0.019}, 37.0, {0.0, 0.0019, 0.0160}},
    {WaterType::kIA, {0.370, 0.067, 0.026}, 33.0, {0.0, 0.0021, 0.0132}},
    {WaterType::kIB, {0.375, 0.072, 0.036}, 22.0, {0.0, 0.0069, 0.0186}},
    {WaterType::kII, {0.400, 0.089, 0.068}, 13.7, {0.0, 0.0086, 0.0143}},
    {WaterType::kIII, {0.445, 0.120, 0.135}, 8.1, {0.0015, 0.0102, 0.0112}},
    {WaterType::k1C, {0.450, 0.120, 0.250}, 6.5, {0.0034, 0.0126, 0.0103}},
    {WaterType::k3C, {0.460, 0.190, 0.390}, 5.1, {0.0047, 0.0160, 0.0096}},
    {WaterType::k5C, {0.540, 0.300, 0.560}, 3.5, {0.0098, 0.0213, 0.0109}},
    {WaterType::k7C, {0.630, 0.460, 0.890}, 2.6, {0.0161, 0.0338, 0.0170}},
    {WaterType::k9C, {0.760, 0.630, 1.600}, 1.7, {0.0186, 0.0248, 0.0125}},
}};

TEST(WaterTypes, DaylightFadesAsJerlovMeasured) {
  for (const Known& known : kKnown) {
    if (known.type < WaterType::kIB || known.type > WaterType::k5C) continue;
    const glm::dvec3 attenuation = diffuse_attenuation(optics_of(known.type), kPi / 6.0);
    EXPECT_NEAR(attenuation.y, known.attenuation.y, 0.25 * known.attenuation.y)
        << kWaterTypeNames[known.type];
  }
}

TEST(WaterTypes, AWhiteDiscIsSeenLessFarFromTypeToType) {
  double before = 1e9;
  for (const Known& known : kKnown) {
    const double depth_m = secchi_depth_m(optics_of(known.type));
    // The clearest light in type IB is near 490 nm, where none of the three wavelengths is.
    const double part = known.type == WaterType::kIB ? 0.25 : 0.15;
    EXPECT_NEAR(depth_m, known.secchi_m, part * known.secchi_m) << kWaterTypeNames[known.type];
    EXPECT_LT(depth_m, before);
    before = depth_m;
  }
}

// Three wavelengths stand for whole spectra.
TEST(WaterTypes, DeepWaterHasTheColourOfItsSpectrum) {
  for (const Known& known : kKnown) {
    const glm::dvec3 colour = colour_of_deep_water(optics_of(known.type));
    for (int c = 1; c < 3; ++c)
      EXPECT_NEAR(colour[c], known.colour[c], 0.25 * known.colour[c] + 5e-4)
          << kWaterTypeNames[known.type] << " " << c;
  }
}

TEST(WaterTypes, ClearWaterIsBlueAndCoastsAreGreen) {
  const auto colour = [](WaterType type) { return colour_of_deep_water(optics_of(type)); };
  EXPECT_GT(colour(WaterType::kI).z, 4.0 * colour(WaterType::kI).y);
  EXPECT_GT(colour(WaterType::k5C).y, 1.5 * colour(WaterType::k5C).z);
}

TEST(WaterTypes, AFileSetsWhatItLeavesOut) {
  const Scene typed = parse_scene("[water]\ntype = \"II\"\n", "a.toml");
  const InherentOptics optics = optics_of(WaterType::kII);
  EXPECT_EQ(typed.water.body_colour, glm::vec3(colour_of_deep_water(optics)));
  EXPECT_EQ(typed.water.absorption_per_m, glm::vec3(picture_attenuation(optics)));
  const Scene mixed =
      parse_scene("[water]\ntype = \"II\"\nbody_colour = [0.1, 0.2, 0.3]\n", "a.toml");
  EXPECT_EQ(mixed.water.body_colour, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(mixed.water.absorption_per_m, typed.water.absorption_per_m);
  EXPECT_THROW(parse_scene("[water]\ntype = \"IV\"\n", "a.toml"), SceneError);
}

}  // namespace
}  // namespace swell::scene
