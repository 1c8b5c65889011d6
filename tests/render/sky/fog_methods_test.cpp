// Pictures of fog that is found at vertices and by depth, against formulas and the fog of pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "math/enum_table.h"
#include "math/simd_target.h"
#include "render/linear_renderer.h"
#include "render/sky/fog.h"
#include "render/tile/stored_fog.h"

namespace swell::render {
namespace {

using scene::FogMethod;

// A fixed box before a sea with waves, in fog of which eye and box stand deep inside.
scene::Scene box_in_fog(FogMethod method, double visibility_m = 150.0) {
  scene::Scene scene = calm_scene(30.0, 0.0, 90.0);
  scene.round_earth = false;
  scene.sea.spectrum = true;
  scene.air.visibility_m = visibility_m;
  scene.air.fog_top_m = 40.0;
  scene.air.scattering = scene::FogScattering::kPaper;
  scene.air.forward = 0.0;
  scene.air.method = method;
  scene::FloatingObject box = scene::common_object(scene::ObjectKind::kBox);
  box.motion = scene::Motion::kFixed;
  box.position_m = {10.0, 90.0};
  box.size_m = {70.0, 4.0, 30.0};
  box.heading_rad = radians(25.0);
  scene.objects = {box};
  return scene;
}

View view_in_fog(double heading_deg = 0.0) {
  return scene::camera_view(
      {.eye_m = {0, 0, 10}, .heading_rad = radians(heading_deg), .pitch_rad = radians(-6.0)}, 0.0,
      96, 64);
}

struct FogPicture : LinearRenderer {
  explicit FogPicture(const scene::Scene& scene, const View& seen = view_in_fog())
      : LinearRenderer(scene), per_m(3.912023 / *scene.air.visibility_m) {
    draw_view(seen, 2.0);
  }

  // The light of an endless way: with an even phase function it is the same in all directions, and
  // a way through fog adds what it does not pass of it.
  glm::dvec3 endless() const {
    const Fog& fog = state().shading.media.fog;
    return glm::dvec3(fog.even) + glm::dvec3(fog.scattered * fog.at_sea.sun_passes);
  }
  double passes(double way_m) const { return std::exp(-per_m * way_m); }

  glm::dvec3 ray(int x, int y) const {
    return glm::dvec3(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  }
  // Along the view's axis, by the depth buffer.
  double z(int x, int y) const {
    const VisibilityBuffer& buffer = state().visibility;
    const int size = buffer.grid.tile_size_px, tile = y / size * buffer.grid.tiles_x + x / size;
    return buffer.depth_of(tile)[static_cast<std::size_t>(y % size * size + x % size)];
  }

  // The corners of the triangle that a pixel shows, relative to the eye.
  std::array<glm::dvec3, 3> corners(int x, int y) const {
    std::array<glm::dvec3, 3> corner;
    const RenderView& window = state().window;
    const Meshes& meshes = state().meshes;
    for (const SurfaceKind kind : {SurfaceKind::kWater, SurfaceKind::kObjects}) {
      if (!shows(kind, x, y)) continue;
      const std::size_t first = 3u * (primitive(x, y) - window.primitives.begin(kind));
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = window.draws[kind].indices[first + k];
        corner[k] =
            kind == SurfaceKind::kObjects
                ? glm::dvec3(meshes.objects.in_window().p_rel[v])
                : glm::dvec3(meshes.water.offset[v], meshes.water.height_m[v] - view.eye_world.z);
      }
    }
    return corner;
  }

  double per_m;
};

// What of a place's light passes when its corners' parts are interpolated: with volumes of the
// ray's tetrahedra for weights.
double between_corners(const FogPicture& picture, int x, int y) {
  const std::array<glm::dvec3, 3> p = picture.corners(x, y);
  const glm::dvec3 ray = picture.ray(x, y);
  double sum = 0.0, all = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = glm::dot(ray, glm::cross(p[(k + 1) % 3], p[(k + 2) % 3]));
    sum += weight * picture.passes(glm::length(p[k]));
    all += weight;
  }
  return sum / all;
}

// What passes on the way to the middle of a row of 1/128 of an octave, in the view's middle column
// to the sea.
double by_depth(const FogPicture& picture, int x, int y) {
  const double z = picture.z(x, y), octave = std::exp2(std::floor(std::log2(z)));
  const double middle_z = octave * (std::floor(z / octave * 128.0) + 0.5) / 128.0;
  const double depth = picture.view.near_m / middle_z;
  const glm::dvec3 top = 0.5 * (picture.ray(0, 0) + picture.ray(95, 0)),
                   last = 0.5 * (picture.ray(0, 63) + picture.ray(95, 63));
  const double part = (-picture.view.eye_world.z / depth - top.z) / (last.z - top.z);
  return picture.passes(depth * glm::length(glm::mix(top, last, std::clamp(part, 0.0, 1.0))));
}

// Both pictures show the same light, of which fog passes other parts.
template <class Passes>
void expect_light_of(const FogPicture& by_pixel, const FogPicture& stored, const Passes& passes) {
  const glm::dvec3 endless = by_pixel.endless();
  int compared[2] = {};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      const bool is_object = by_pixel.shows(SurfaceKind::kObjects, x, y);
      if (!is_object && !by_pixel.shows(SurfaceKind::kWater, x, y)) continue;
      ++compared[is_object];
      const double way_m =
          by_pixel.view.near_m / by_pixel.z(x, y) * glm::length(by_pixel.ray(x, y));
      const double ratio = passes(by_pixel, x, y) / by_pixel.passes(way_m);
      const glm::dvec3 light(by_pixel.linear(x, y));
      const glm::dvec3 expected = endless + (light - endless) * ratio;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(stored.linear(x, y)[c], expected[c], 2e-3 * endless[c]) << x << ' ' << y;
    }
  EXPECT_GT(compared[0], 800);
  EXPECT_GT(compared[1], 600);
}

// Equations 14 and 15: I = L e^-Bd + I_t, at each corner of each pixel's triangle.
TEST(FogMethods, VerticesHaveTheFogAndPixelsWhatLiesBetween) {
  const FogPicture by_pixel(box_in_fog(FogMethod::kPixel)), stored(box_in_fog(FogMethod::kVertex));
  expect_light_of(by_pixel, stored, between_corners);
  // The box's faces are large enough to tell.
  EXPECT_GT(glm::distance(by_pixel.linear(48, 26), stored.linear(48, 26)), 5e-3f);
}

TEST(FogMethods, TablesGiveAllPlacesOfADepthTheSameFog) {
  const FogPicture by_pixel(box_in_fog(FogMethod::kPixel)), stored(box_in_fog(FogMethod::kTable));
  expect_light_of(by_pixel, stored, by_depth);
}

constexpr auto kMethodNames = enum_words<FogMethod>(
    {{FogMethod::kPixel, "Pixel"}, {FogMethod::kVertex, "Vertex"}, {FogMethod::kTable, "Table"}});

std::string method_name(const testing::TestParamInfo<FogMethod>& method) {
  return std::string(kMethodNames[method.param]);
}

class EachFogMethod : public testing::TestWithParam<FogMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, EachFogMethod,
                         testing::Values(FogMethod::kPixel, FogMethod::kVertex, FogMethod::kTable),
                         method_name);

// Equation 16, S = (1 - l)^2 / (1 + l^2 - 2 l cos mu)^(3/2): thick fog before the sea, towards the
// sun and away from it.
TEST_P(EachFogMethod, ScattersTheSunsLightByItsAngle) {
  scene::Scene scene = box_in_fog(GetParam(), 40.0);
  scene.objects.clear();
  scene.air.fog_top_m = 15.0;
  const double l = 0.6;
  scene.air.forward = l;
  FogPicture picture(scene, view_in_fog(90.0));
  const auto of_sun = [&](double heading_deg) {
    picture.draw_view(view_in_fog(heading_deg), 2.0);
    // Where the sea is some 95 m away.
    return static_cast<double>(picture.linear(48, 32).y - picture.state().shading.media.fog.even.y);
  };
  const auto s = [&](double cos_mu) {
    return (1.0 - l) * (1.0 - l) / std::pow(1.0 + l * l - 2.0 * l * cos_mu, 1.5);
  };
  const double towards = of_sun(90.0), away = of_sun(270.0), down = std::sin(radians(6.0));
  const double level = std::sqrt(1.0 - down * down) * std::cos(radians(30.0));
  const double expected = s(level - 0.5 * down) / s(-level - 0.5 * down);
  // A table stands for the mean sea of a depth, which waves shift by a degree: by 0.05 in S.
  EXPECT_NEAR(towards / away, expected, 0.05 * expected);
}

// "If the component of fog increases, the object becomes invisible little by little."
TEST_P(EachFogMethod, HidesObjectsLittleByLittle) {
  // In thinner fog the box has more light than without: of the sun's that it scatters.
  double last = 1e9, first = 0.0;
  for (const double visibility_m : {700.0, 250.0, 120.0, 60.0, 30.0}) {
    scene::Scene scene = box_in_fog(GetParam(), visibility_m);
    scene.objects[0].colour = glm::vec3(0.8f);
    FogPicture white(scene);
    scene.objects[0].colour = glm::vec3(0.05f);
    FogPicture black(scene);
    ASSERT_TRUE(white.shows(SurfaceKind::kObjects, 48, 26));
    const double contrast = white.linear(48, 26).y - black.linear(48, 26).y;
    EXPECT_LT(contrast, 0.8 * last) << visibility_m;
    if (first == 0.0) first = contrast;
    last = contrast;
    const double hidden = 1.0 - white.passes(100.0);
    EXPECT_GT(black.linear(48, 26).y, 0.7 * hidden * black.endless().y) << visibility_m;
  }
  EXPECT_LT(last, 0.02 * first);
}

TEST_P(EachFogMethod, IsTheSameOnAnyThreadsTilesAndSimdTarget) {
  scene::Scene scene = box_in_fog(GetParam(), 800.0);
  scene.air.banks = 0.7;
  scene.air.forward = 0.75;
  scene.air.fog_top_m = 8.0;  // the eye is over it
  scene.round_earth = true;
  const World world = world_of(scene);
  const auto draw = [&](int threads, int tile_size_px) {
    return Shot(world, view_in_fog(), 2.0, {.tile_size_px = tile_size_px, .edge_samples = 4},
                threads)
        .target.rgba;
  };
  const auto expected = draw(1, 64);
  EXPECT_EQ(draw(3, 64), expected);
  EXPECT_EQ(draw(2, 16), expected);
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(simd_targets().front());
  EXPECT_EQ(draw(2, 32), expected);
  select_simd_target(SimdTarget::kAvx512);
}

// An implicit surface is found by rays and has no vertices.
TEST(FogMethods, ImplicitSurfacesHaveTheFogOfPixels) {
  scene::Scene scene = box_in_fog(FogMethod::kPixel);
  scene::FloatingObject& form = scene.objects[0];
  form = scene::common_object(scene::ObjectKind::kImplicit);
  form.file = SWELL_SOURCE_DIR "/scenes/forms/turboprop.toml";
  form.motion = scene::Motion::kFixed;
  form.height_m = 8.0;
  form.position_m = {0.0, 40.0};
  const FogPicture by_pixel(scene);
  scene.air.method = FogMethod::kVertex;
  const FogPicture by_vertex(scene);
  int compared = 0, others = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      if (by_pixel.shows(SurfaceKind::kObjects, x, y)) {
        EXPECT_EQ(by_vertex.linear(x, y), by_pixel.linear(x, y)) << x << ' ' << y;
        ++compared;
      } else {
        others += by_vertex.linear(x, y) != by_pixel.linear(x, y);
      }
    }
  EXPECT_GT(compared, 50);
  EXPECT_GT(others, 500);
}

}  // namespace
}  // namespace swell::render
