// The water's own colour from place to place: its texture, what it is blended with, and the colours
// of a sequence's details. Source: Ma, Zhu, Gong, 2006.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "render/measures.h"
#include "render/shot.h"
#include "scratch_folder.h"
#include "texture/image/image_io.h"

namespace swell::render {
namespace {

constexpr int kTexture_px = 32;
using Rgb = std::array<int, 3>;  // sRGB codes
constexpr Rgb kNorthWest = {30, 90, 110}, kNorthEast = {60, 90, 40}, kSouthWest = {20, 120, 140},
              kSouthEast = {55, 120, 100};

glm::vec3 light_of(Rgb codes) {
  glm::vec3 light(0.0f);
  for (int c = 0; c < 3; ++c) {
    const double code = codes[static_cast<std::size_t>(c)] / 255.0;
    light[c] =
        static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
  }
  return light;
}

const glm::vec3 kQuartersMean = 0.25f * (light_of(kNorthWest) + light_of(kNorthEast) +
                                         light_of(kSouthWest) + light_of(kSouthEast));

class OwnColour : public testing::Test {
 protected:
  // A picture with the north on top.
  template <class Codes>
  std::string write(const std::string& name, const Codes& codes_at) const {
    texture::Image8 picture{kTexture_px, kTexture_px, 3, {}};
    for (int y = 0; y < kTexture_px; ++y)
      for (int x = 0; x < kTexture_px; ++x)
        for (const int code : codes_at(x, y))
          picture.pixels.push_back(static_cast<std::uint8_t>(code));
    return folder_.write(name, texture::encode_image(picture, ".png")).string();
  }
  std::string write_quarters() const {
    return write("water.png", [](int x, int y) {
      const bool east = x >= kTexture_px / 2, south = y >= kTexture_px / 2;
      return south ? (east ? kSouthEast : kSouthWest) : (east ? kNorthEast : kNorthWest);
    });
  }
  std::string write_one(const std::string& name, Rgb codes) const {
    return write(name, [&](int, int) { return codes; });
  }

  const ScratchFolder folder_;
};

// Water like glass under an even sky, which mirrors nothing.
scene::Scene glassy_sea() {
  scene::Scene scene;
  scene.sky.zenith = scene.sky.horizon = glm::vec3(0.5f);
  scene.sky.sun_radiance = glm::vec3(0.0f);
  scene.sky.cloud_cover = 0.0;
  scene.sky.haze_distance_m = 1e7;
  scene.round_earth = false;
  scene.sea.spectrum = false;
  scene.sea.wind_speed_mps = 0.0;
  scene.water.reflection_weight = 0.0;
  scene.water.texture_length_m = kTexture_px;
  scene.detail.triangulation = scene::Triangulation::kPlane;
  return scene;
}

// 16 m of it from straight above, north on top, around a place.
Target seen_from_above(const World& world, glm::dvec2 place, PartSet without = {},
                       double t_s = 1.0) {
  const View view = make_view({place.x, place.y, 20.0}, 0.0, -0.5 * std::numbers::pi,
                              2.0 * std::atan(0.4), 0.25f, 32, 32);
  return Shot(world, view, t_s, {.keep_linear = true, .without = without}, 1).target;
}

glm::vec3 light_at(const Target& target, int x, int y) {
  const std::size_t at = 3 * static_cast<std::size_t>(y * target.width_px + x);
  return {target.linear[at], target.linear[at + 1], target.linear[at + 2]};
}

void expect_near(glm::vec3 a, glm::vec3 b, double part) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], part * static_cast<double>(b[c])) << c;
}

// The paper's waterTexture. Colours are kept in 8 bits up to twice their mean, then in 7 about it.
TEST_F(OwnColour, IsThatOfTheTextureAtThePlace) {
  scene::Scene scene = glassy_sea();
  scene.water.body_colour = kQuartersMean;
  const Target plain = seen_from_above(world_of(scene), {16.0, 16.0});
  scene.water.texture = write_quarters();
  // The picture's middle lies half a period from the origin.
  const Target seen = seen_from_above(world_of(scene), {16.0, 16.0});
  const auto check = [&](int x, int y, Rgb codes) {
    const glm::vec3 mean = light_at(plain, x, y);
    const glm::vec3 expected = mean * light_of(codes) / kQuartersMean;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(light_at(seen, x, y)[c], expected[c], 0.012f * mean[c])
          << x << ' ' << y << ' ' << c;
  };
  check(8, 8, kNorthWest);
  check(24, 8, kNorthEast);
  check(8, 24, kSouthWest);
  check(24, 24, kSouthEast);
}

// What takes one colour of the water takes its mean: from afar, and under water.
TEST_F(OwnColour, IsTheTexturesMeanFromAfar) {
  scene::Scene scene = glassy_sea();
  scene.water.texture = write_quarters();
  scene.water.texture_length_m = 0.5;
  const Target fine = seen_from_above(world_of(scene), {0.0, 0.0});
  scene.water.texture.clear();
  scene.water.body_colour = kQuartersMean;
  const Target plain = seen_from_above(world_of(scene), {0.0, 0.0});
  for (const int x : {3, 14, 30}) expect_near(light_at(fine, x, x), light_at(plain, x, x), 0.01);
}

// lerp(waterTexture, image, lerpScale).
TEST_F(OwnColour, IsBlendedWithWhatLiesUnderItByOneWeight) {
  scene::Scene scene = load_shipped("pool");
  scene.water.reflection_weight = 0.0;
  scene.water.texture = write_quarters();
  const glm::dvec2 place(scene.terrain->centre_m);
  const auto seen = [&](double weight, PartSet without = {}) {
    scene.water.refraction_weight = weight;
    return seen_from_above(world_of(scene), place, without);
  };
  const Target own = seen(0.0), both = seen(0.25), image = seen(1.0);
  const Target without = seen(1.0, {Part::kRefraction});
  double apart = 0.0;
  for (std::size_t i = 0; i < own.linear.size(); ++i) {
    EXPECT_NEAR(both.linear[i], 0.75f * own.linear[i] + 0.25f * image.linear[i], 2e-3f) << i;
    EXPECT_NEAR(own.linear[i], without.linear[i], 1e-3f) << i;
    apart = std::max(apart, static_cast<double>(std::abs(own.linear[i] - image.linear[i])));
  }
  EXPECT_GT(apart, 0.05);
}

// The product of dot(normal, light) and the picture of details: colours tint as the paper's do.
TEST_F(OwnColour, IsTintedByTheColoursOfDetails) {
  texture::Image8 wave{kTexture_px, kTexture_px, 1, {}};
  for (int i = 0; i < kTexture_px * kTexture_px; ++i)
    wave.pixels.push_back(static_cast<std::uint8_t>(std::lround(
        127.5 + 100.0 * std::sin(2.0 * std::numbers::pi * (i % kTexture_px) / kTexture_px))));
  for (const std::string name : {"wave_0000.png", "wave_0001.png"})
    folder_.write(name, texture::encode_image(wave, ".png"));
  scene::Scene scene = glassy_sea();
  scene.sea.wind_speed_mps = 3.0;
  scene.ripples.kind = scene::RippleKind::kSequence;
  scene.ripples.lighting = scene::RippleLighting::kPaper;
  scene.ripples.sequence = (folder_.path() / "wave_%04d.png").string();
  scene.ripples.frames = 2;
  int pairs = 0;  // worlds with files of the same names are the same
  const auto seen_with = [&](Rgb first, Rgb second, double t_s) {
    const std::string name = "detail_" + std::to_string(pairs++) + "_";
    write_one(name + "0000.png", first);
    write_one(name + "0001.png", second);
    scene.ripples.detail = (folder_.path() / (name + "%04d.png")).string();
    return seen_from_above(world_of(scene), {0.0, 0.0}, {}, t_s);
  };
  const Rgb white = {255, 255, 255}, turquoise = {64, 188, 188}, grey = {188, 188, 188};
  const glm::vec3 tint(light_of(turquoise) / light_of(turquoise).y);
  // Of a loop of 4 s and two frames: the first, the second.
  const double half = static_cast<double>(light_of(grey).x), mean = 0.5 * (1.0 + half);
  for (const auto& [t_s, part] : {std::pair(0.0, 1.0), std::pair(2.0, half)}) {
    const Target plain = seen_with(white, white, t_s);
    const Target tinted = seen_with(turquoise, turquoise, t_s);
    const Target changing = seen_with(white, grey, t_s);
    for (const int x : {3, 14, 30}) {
      expect_near(light_at(tinted, x, x), tint * light_at(plain, x, x), 0.02);
      expect_near(light_at(changing, x, x), light_at(plain, x, x) * static_cast<float>(part / mean),
                  0.02);
    }
  }
}

TEST_F(OwnColour, IsGoneWhereTheNextWorldHasNone) {
  scene::Scene scene = glassy_sea();
  const World plain = world_of(scene);
  const View view = view_of(plain, 1.0, 32, 32);
  const Shot alone(plain, view, 1.0);
  Shot after;
  scene.water.texture = write_quarters();
  {
    const World textured = world_of(scene);
    after.draw(textured, view, 1.0);
  }
  after.draw(plain, view, 1.0);
  EXPECT_EQ(after.target.rgba, alone.target.rgba);
}

TEST_F(OwnColour, OfAFileThatIsNoPictureIsRefused) {
  scene::Scene scene = glassy_sea();
  scene.water.texture = folder_.write("water.png", std::string("no picture")).string();
  EXPECT_THROW(world_of(scene), scene::SceneError);
  scene.water.texture =
      folder_
          .write("flat.png",
                 texture::encode_image(
                     texture::Image8{48, 32, 3, std::vector<std::uint8_t>(3 * 48 * 32)}, ".png"))
          .string();
  try {
    world_of(scene);
    ADD_FAILURE();
  } catch (const scene::SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("water.texture: "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("got 48 x 32 pixels"), std::string::npos);
  }
}

}  // namespace
}  // namespace swell::render
