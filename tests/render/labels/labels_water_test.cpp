// Heights, normals, foam and flags of labels, against the water that is asked and against each
// other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ocean/water_surface.h"
#include "render/labelled_frame.h"
#include "render/world/world_state.h"
#include "scene/water.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kWaterSize_px(320, 180);

class LabelsOfWater : public testing::TestWithParam<const char*> {
 protected:
  const scene::Scene scene = load_shipped(GetParam());
  const World& world = shipped_world(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Scenes, LabelsOfWater,
                         testing::Values("lagoon", "beach", "buoys", "open_ocean"),
                         [](const auto& test) { return std::string(test.param); });

glm::dvec3 vertex_of(const LabelledFrame& frame, std::uint32_t primitive, std::size_t k) {
  const Surface& water = frame.state().meshes.water;
  const std::uint32_t v = water.mesh.indices[3 * primitive + k];
  return {vertex_world(water, v), water.height_m[v]};
}

// A triangle is at most L s / 2 off the water, L its steepest slope, s the longest edge.
TEST_P(LabelsOfWater, ElevationIsTheWatersHeightWithinWhatItsTriangleCutsOff) {
  const scene::Water water(scene);
  Workers workers(2);
  ocean::SeaFrame sea;
  const scene::WaterSurface surface = water.at(5.0, sea, workers);
  for (int n = 0; n < 4; ++n) {
    const LabelledFrame frame(world, random_view(scene, n, kWaterSize_px), 5.0);
    double sum = 0.0;
    int count = 0;
    frame.for_pixels(3, [&](glm::ivec2 p) {
      if (frame.labels().id[frame.at(p)] != kWaterId) {
        ASSERT_EQ(frame.labels().elevation_m[frame.at(p)], 0.0f);
        return;
      }
      const glm::dvec3 place = frame.position(p);
      const std::uint32_t i = frame.primitive(p);
      std::array<glm::dvec3, 3> v;
      for (std::size_t k = 0; k < 3; ++k) v[k] = vertex_of(frame, i, k);
      const double s = std::max({glm::distance(glm::dvec2(v[0]), glm::dvec2(v[1])),
                                 glm::distance(glm::dvec2(v[1]), glm::dvec2(v[2])),
                                 glm::distance(glm::dvec2(v[2]), glm::dvec2(v[0]))});
      const float depth = frame.labels().depth_m[frame.at(p)];
      const double footprint_m = 2.0 * depth * frame.view.tan_half_y / kWaterSize_px.y;
      const double elevation = frame.labels().elevation_m[frame.at(p)];
      const double error = std::abs(elevation - surface.height(glm::dvec2(place)));
      ASSERT_LE(error, 0.5 * surface.bounds().slope * s + 0.01 * footprint_m);
      ASSERT_NEAR(elevation, place.z + frame.sunk_m(place), 1e-6 * (1.0 + depth));
      if (depth < 100.0f) sum += error, ++count;
    });
    EXPECT_LE(sum, 0.02 * count) << n;  // [m]
  }
}

// Where two pixels beside each other show one triangle, their places span it.
TEST_P(LabelsOfWater, GeometricNormalsAreThoseOfThePlacesSeen) {
  int compared = 0;
  for (int n = 0; n < 4; ++n) {
    const LabelledFrame frame(world, random_view(scene, n, kWaterSize_px), 5.0,
                              {.water_triangles = 500, .terrain_triangles = 500});  // large ones
    for (int y = 0; y + 3 < kWaterSize_px.y; ++y) {
      for (int x = 0; x + 3 < kWaterSize_px.x; ++x) {
        const glm::ivec2 p(x, y), right(x + 3, y), down(x, y + 3);
        const std::uint32_t primitive = frame.primitive(p);
        if (primitive == raster::kNoPrimitive || frame.primitive(right) != primitive ||
            frame.primitive(down) != primitive)
          continue;
        const glm::dvec3 here = frame.position(p);
        const glm::dvec3 a = frame.position(right) - here, b = frame.position(down) - here;
        const glm::dvec3 expected = glm::normalize(glm::cross(b, a));
        const glm::dvec3 to_eye = glm::normalize(frame.view.eye_world - here);
        // Edge-on, floats of depth say little.
        if (glm::dot(expected, to_eye) < 0.03) continue;
        ++compared;
        const glm::dvec3 normal(frame.labels().geometric_normal[frame.at(p)]);
        ASSERT_NEAR(glm::length(normal), 1.0, 1e-6);
        ASSERT_GT(glm::dot(normal, to_eye), 0.0);
        ASSERT_LT(glm::distance(normal, expected), 0.02) << x << " " << y;
      }
    }
  }
  EXPECT_GT(compared, 5000);
}

TEST(Labels, SeenFromBelowTheWatersGeometricNormalsPointDown) {
  const View view =
      make_view({0.0, 0.0, -20.0}, 0.0, 0.8, 0.9, 0.25f, kWaterSize_px.x, kWaterSize_px.y);
  const LabelledFrame frame(shipped_world("open_ocean"), view, 5.0);
  int water = 0;
  frame.for_pixels(1, [&](glm::ivec2 p) {
    if (frame.labels().id[frame.at(p)] != kWaterId) return;
    ++water;
    ASSERT_LT(frame.labels().geometric_normal[frame.at(p)].z, -0.3f);
  });
  EXPECT_GT(water, 10000);
}

TEST_P(LabelsOfWater, EveryLabelOfEveryPixelIsInItsRange) {
  const std::vector<std::uint32_t>& classes = world.state().object_classes;
  for (int n = 0; n < 4; ++n) {
    const LabelledFrame frame(world, random_view(scene, n, kWaterSize_px), 5.0);
    const Labels& labels = frame.labels();
    frame.for_pixels(1, [&](glm::ivec2 p) {
      const std::size_t at = frame.at(p);
      const std::uint32_t id = labels.id[at], klass = labels.klass[at];
      const bool is_sky = id == kSkyId, is_water = id == kWaterId;
      ASSERT_EQ(is_sky, frame.primitive(p) == raster::kNoPrimitive);
      ASSERT_EQ(is_sky, !std::isfinite(labels.depth_m[at]));
      ASSERT_GE(labels.depth_m[at], 0.999f * frame.view.near_m);
      const float length = is_sky ? 0.0f : 1.0f;
      ASSERT_NEAR(glm::length(labels.normal[at]), length, 1e-5f);
      ASSERT_NEAR(glm::length(labels.geometric_normal[at]), length, 1e-5f);
      ASSERT_TRUE(std::isfinite(labels.motion_px[at].x) && std::isfinite(labels.motion_px[at].y));
      ASSERT_TRUE(std::isfinite(labels.elevation_m[at]));
      ASSERT_TRUE(labels.foam[at] >= 0.0f && labels.foam[at] <= (is_water ? 1.0f : 0.0f));
      ASSERT_LE(labels.flags[at], is_water ? kShowsMirrored + kShowsRefracted : 0u);
      const std::uint32_t expected = is_sky     ? kSkyClass
                                     : is_water ? labels.foam[at] > 0.5f ? kFoamClass : kWaterClass
                                     : id == kLandId ? kTerrainClass
                                                     : classes.at(id - kFirstObjectId);
      ASSERT_EQ(klass, expected);
    });
  }
}

// The share of the pixels with a label.
template <class Holds>
double share_of(const LabelledFrame& frame, const Holds& holds) {
  int count = 0, all = 0;
  frame.for_pixels(1, [&](glm::ivec2 p) { ++all, count += holds(frame.at(p)); });
  return static_cast<double>(count) / all;
}

TEST(Labels, SurfIsFoamAndWithoutWhitecapsFarFromACoastThereIsNone) {
  scene::Scene calm = load_shipped("open_ocean");
  calm.sea.whitecaps = 0.0;
  const World& beach = shipped_world("beach");
  const World sea = world_of(calm);
  const auto foam_of = [](const World& world) {
    const LabelledFrame frame(world, random_view(world.scene(), 0, kWaterSize_px), 5.0);
    return share_of(frame, [&](std::size_t i) { return frame.labels().klass[i] == kFoamClass; });
  };
  EXPECT_GT(foam_of(beach), 0.002);
  EXPECT_LT(foam_of(beach), 0.3);
  EXPECT_EQ(foam_of(sea), 0.0);
}

TEST(Labels, FlagsSayWhereWaterMirrorsAndWhereItShowsItsFloor) {
  const World &world = shipped_world("lagoon"), &sea = shipped_world("open_ocean");
  const LabelledFrame frame(world, view_of(world, 5.0, kWaterSize_px.x, kWaterSize_px.y), 5.0);
  const auto share = [](const LabelledFrame& f, std::uint32_t bit) {
    return share_of(f, [&](std::size_t i) { return (f.labels().flags[i] & bit) != 0; });
  };
  EXPECT_GT(share(frame, kShowsMirrored), 0.01);
  EXPECT_GT(share(frame, kShowsRefracted), 0.01);
  // The floor shows where the water is shallow, not over the deep. The image's texels are two
  // pixels large; near the horizon there are hundreds of metres between two of them.
  int shown = 0, deep = 0;
  const terrain::HeightGrid& land = *world.state().terrain;
  frame.for_pixels(1, [&](glm::ivec2 p) {
    if ((frame.labels().flags[frame.at(p)] & kShowsRefracted) == 0) return;
    const glm::ivec2 texel_below(p.x, std::min(p.y + 2, kWaterSize_px.y - 1));
    const glm::dvec2 place(frame.position(texel_below));
    float floor_m = 0.0f;
    terrain::sample_heights(land, {&place, 1}, {&floor_m, 1});
    ++shown;
    deep += floor_m <= -60.0f;
  });
  EXPECT_EQ(deep, 0) << shown;
  // Straight down, it mirrors nothing but the sky.
  glm::dvec3 shallow(0.0);
  frame.for_pixels(1, [&](glm::ivec2 p) {
    if ((frame.labels().flags[frame.at(p)] & kShowsRefracted) != 0) shallow = frame.position(p);
  });
  const View down = make_view(shallow + glm::dvec3(0.0, 0.0, 12.0), 0.0, -0.5 * kPi, 0.5, 0.25f,
                              kWaterSize_px.x, kWaterSize_px.y);
  const LabelledFrame below(world, down, 5.0);
  EXPECT_GT(share(below, kShowsRefracted), 0.5);
  EXPECT_LT(share(below, kShowsMirrored), 0.01);
  const LabelledFrame open(sea, random_view(sea.scene(), 0, kWaterSize_px), 5.0);
  EXPECT_EQ(share(open, kShowsMirrored | kShowsRefracted), 0.0);
}

// Without ripples the shader's normal is that of the sea that is asked.
TEST(Labels, NormalsAreThoseOfTheWaves) {
  scene::Scene scene = load_shipped("sines");
  scene.water.bump_strength = 0.0;
  const World world = world_of(scene);
  const scene::Water water(scene);
  Workers workers(2);
  ocean::SeaFrame sea;
  const scene::WaterSurface surface = water.at(5.0, sea, workers);
  const View view =
      make_view({0.0, -120.0, 14.0}, 0.2, -0.6, 0.6, 0.25f, kWaterSize_px.x, kWaterSize_px.y);
  const LabelledFrame frame(world, view, 5.0);
  frame.for_pixels(2, [&](glm::ivec2 p) {
    const glm::dvec2 place(frame.position(p));
    glm::vec3 expected;
    surface.normals({&place, 1}, {&expected, 1});
    ASSERT_LT(glm::distance(frame.labels().normal[frame.at(p)], expected), 1e-3f);
  });
}

// A ball's normals go through its middle.
TEST(Labels, NormalsOfABallPointAwayFromItsMiddle) {
  scene::Scene scene = load_shipped("open_ocean_plane");
  scene.objects.resize(1);
  scene.objects[0].kind = scene::ObjectKind::kSphere;
  scene.objects[0].size_m = glm::dvec3(8.0);
  scene.objects[0].draught = 0.5;
  const World world = world_of(scene);
  const View view =
      make_view({0.0, -14.0, 3.0}, 0.0, -0.1, 0.9, 0.25f, kWaterSize_px.x, kWaterSize_px.y);
  const LabelledFrame frame(world, view, 5.0);
  int count = 0;
  frame.for_pixels(1, [&](glm::ivec2 p) {
    if (frame.labels().id[frame.at(p)] != kFirstObjectId) return;
    ++count;
    const glm::dvec3 expected = glm::normalize(frame.position(p));
    ASSERT_LT(glm::distance(glm::dvec3(frame.labels().normal[frame.at(p)]), expected), 0.05);
    ASSERT_LT(glm::distance(glm::dvec3(frame.labels().geometric_normal[frame.at(p)]), expected),
              0.25);
  });
  EXPECT_GT(count, 3000);
}

}  // namespace
}  // namespace swell::render
