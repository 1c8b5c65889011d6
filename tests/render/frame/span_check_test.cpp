// Every public function that takes spans which must agree refuses those that do not, before it
// reads or writes a number.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "lod/envelope.h"
#include "lod/height_pyramid.h"
#include "lod/mesh_query.h"
#include "lod/priority.h"
#include "lod/relief_bounds.h"
#include "lod/roam.h"
#include "ocean/coast/coast.h"
#include "ocean/coast/coast_map.h"
#include "ocean/coast/coast_velocity.h"
#include "ocean/coast/eikonal.h"
#include "ocean/velocity.h"
#include "ocean/water_surface.h"
#include "raster/pass.h"
#include "raster/vertices.h"
#include "render/materials/list.h"
#include "render/measure/mesh_error.h"
#include "render/picture/enlarge.h"
#include "render/sea/background.h"
#include "render/shade/shade_tile.h"
#include "scene/coast.h"
#include "scene/objects.h"
#include "scene/water.h"
#include "terrain/height_grid.h"
#include "texture/normal_map.h"
#include "texture/packed_map.h"
#include "texture/uv_noise.h"

namespace swell::render {
namespace {

constexpr std::size_t kCount = 8;

// Spans of three lengths: 8, and one too few and one too many.
template <class T>
struct Lengths {
  std::array<T, kCount + 1> storage{};
  std::span<T> right = std::span(storage).first(kCount);
  std::span<T> shorter = std::span(storage).first(kCount - 1);
  std::span<T> longer = std::span(storage);
};

#define EXPECT_REFUSED(CALL) EXPECT_DEATH(CALL, "check failed")

class SpanDeathTest : public testing::Test {
 protected:
  SpanDeathTest() { GTEST_FLAG_SET(death_test_style, "fast"); }

  Lengths<glm::dvec2> p;
  Lengths<float> a, b, c;
  Lengths<glm::vec2> v2;
  Lengths<glm::vec3> v3;
  Workers workers{1};
};

scene::Scene small_scene() {
  scene::Scene scene;
  scene.sea.resolution = 16;
  scene.terrain.emplace().coast_m = {{-100.0, 0.0}, {100.0, 0.0}};
  scene.terrain->beach_size_m = 100.0;
  scene.coast.model = scene::CoastModel::kBlend;
  scene.coast.trains = 1;
  scene.coast.grid_spacing_m = 20.0;
  return scene;
}

struct Asked {
  scene::Water water{small_scene()};
  ocean::SeaFrame frame;
  ocean::VelocityFrame velocity;
};

Asked& asked(Workers& workers) {
  static Asked* const the_one = [&] {
    auto* made = new Asked;
    made->water.at(1.0, made->frame, workers);
    ocean::advance_velocity(made->water.sea(), made->frame, made->velocity, workers);
    return made;
  }();
  return *the_one;
}

TEST_F(SpanDeathTest, WaterSurfaceChecksEveryPair) {
  Asked& sea = asked(workers);
  const scene::WaterSurface surface = sea.water.at(1.0, sea.frame, workers);
  EXPECT_REFUSED(surface.heights(p.right, a.shorter));
  EXPECT_REFUSED(surface.heights(p.right, a.longer));
  EXPECT_REFUSED(surface.slopes(p.right, v2.shorter));
  EXPECT_REFUSED(surface.slopes(p.right, v2.longer));
  EXPECT_REFUSED(surface.normals(p.right, v3.shorter));
  EXPECT_REFUSED(surface.normals(p.right, v3.longer));
  EXPECT_REFUSED(surface.velocities(p.right, sea.velocity, v3.shorter));
  EXPECT_REFUSED(surface.velocities(p.right, sea.velocity, v3.longer));
  const std::vector<scene::FloatingObject> objects(2);
  std::vector<scene::ObjectPose> poses(1);
  EXPECT_REFUSED(scene::object_poses(objects, surface, poses));
}

// The example of a heap's corruption: 3,000 points into 2 heights.
TEST_F(SpanDeathTest, WaterSurfaceChecksMoreThanAChunk) {
  Asked& sea = asked(workers);
  const scene::WaterSurface surface = sea.water.at(1.0, sea.frame, workers);
  const std::vector<glm::dvec2> points(3000);
  std::vector<float> heights(2);
  EXPECT_REFUSED(surface.heights(points, heights));
}

TEST_F(SpanDeathTest, OceanChecksEveryPair) {
  Asked& sea = asked(workers);
  const ocean::CoastSea& coast = *sea.water.coast();
  EXPECT_REFUSED(ocean::sample_heights(sea.frame, p.right, a.shorter));
  EXPECT_REFUSED(ocean::sample_heights(sea.frame, p.right, a.longer));
  EXPECT_REFUSED(ocean::sample_heights(sea.frame, glm::dvec2(0.0), v2.right, a.shorter));
  EXPECT_REFUSED(ocean::sample_heights(sea.frame, glm::dvec2(0.0), v2.right, a.longer));
  EXPECT_REFUSED(ocean::sample_slopes(sea.frame, p.right, a.shorter, b.right));
  EXPECT_REFUSED(ocean::sample_slopes(sea.frame, p.right, a.right, b.longer));
  EXPECT_REFUSED(ocean::sample_velocities(sea.velocity, p.right, v3.shorter));
  EXPECT_REFUSED(ocean::sample_coast_share(coast, p.right, a.shorter));
  EXPECT_REFUSED(ocean::sample_coast(coast, 0.0, p.right, a.shorter, b.right));
  EXPECT_REFUSED(ocean::sample_coast(coast, 0.0, p.right, a.right, b.shorter));
  EXPECT_REFUSED(ocean::sample_trains(coast.trains, 0.0, p.right, a.shorter));
  EXPECT_REFUSED(ocean::sample_trains(coast.trains, 0.0, p.right, a.right, b.shorter, c.right));
  EXPECT_REFUSED(ocean::sample_trains(coast.trains, 0.0, p.right, a.right, b.right, c.longer));
  EXPECT_REFUSED(ocean::sample_train_velocities(coast.trains, 0.0, p.right, v3.shorter));
  EXPECT_REFUSED(ocean::sample_coast_velocities(coast, 0.0, p.right, v3.longer));
  const ocean::CoastMap map = ocean::make_coast_map(coast, 16, workers);
  std::vector<float> whole(256), less(255);
  EXPECT_REFUSED(ocean::bake_coast(map, 0.0, less, whole, whole, workers));
  EXPECT_REFUSED(ocean::bake_coast(map, 0.0, whole, less, whole, workers));
  EXPECT_REFUSED(ocean::bake_coast(map, 0.0, whole, whole, less, workers));
  ocean::EikonalProblem problem{{{0.0, 0.0}, 1.0, 4, 2}, {}, {}, {}};
  problem.slowness.resize(8);
  problem.source.resize(7);
  std::vector<double> theta;
  EXPECT_REFUSED(ocean::solve_eikonal(problem, theta));
  EXPECT_REFUSED(ocean::spread_energy(problem, std::vector<double>(8), theta));
  const terrain::HeightGrid floor{{{0.0, 0.0}, 1.0, 4, 2}, std::vector<float>(7)};
  EXPECT_THROW(ocean::make_train_sea(floor, {}, ocean::PhaseMethod::kEikonal, workers),
               std::invalid_argument);
}

TEST_F(SpanDeathTest, LodChecksEveryPair) {
  lod::Roam roam({{0.0, 0.0}, 16.0, 4}, 50);
  lod::Mesh mesh;
  std::uint64_t revision = 0;
  roam.update_mesh(mesh, revision);
  const std::vector<float> less(mesh.lattice.size() - 1);
  lod::Envelopes envelopes;
  EXPECT_REFUSED(lod::build_envelopes(mesh, less, envelopes));
  const lod::HeightMesh surface{mesh, envelopes, less, {{0.0, 0.0}, 16.0, 4}};
  const glm::dvec3 point(1.0), down(0.0, 0.0, -1.0);
  std::vector<int> found;
  EXPECT_REFUSED(lod::intersect_ray(surface, point, down, 10.0));
  EXPECT_REFUSED(lod::intersect_ray_in_all(surface, point, down, 10.0));
  EXPECT_REFUSED(lod::triangle_at(surface, glm::dvec2(point)));
  EXPECT_REFUSED(lod::nearest_vertex(surface, point));
  EXPECT_REFUSED(lod::nearest_edge(surface, point));
  EXPECT_REFUSED(lod::find_in_box(surface, point, point + 1.0, found));
  EXPECT_REFUSED(lod::ReliefBounds(a.right, 3, 1.0));
  EXPECT_REFUSED(lod::make_height_pyramid(1, std::vector<lod::HeightRange>(3)));
  EXPECT_REFUSED(lod::make_height_pyramid(1, a.right, 3));
  Lengths<std::int32_t> x, y, level;
  Lengths<lod::PriorityKey> keys;
  EXPECT_REFUSED(lod::compute_priority_keys({}, x.right, y.shorter, level.right, keys.right));
  EXPECT_REFUSED(lod::compute_priority_keys({}, x.right, y.right, level.shorter, keys.right));
  EXPECT_REFUSED(lod::compute_priority_keys({}, x.right, y.right, level.right, keys.shorter));
}

TEST_F(SpanDeathTest, TextureChecksEveryPair) {
  texture::UvNoise noise({});
  EXPECT_REFUSED(noise.evaluate(0.0, a.right, b.right));
  EXPECT_REFUSED(texture::write_unit_vectors(a.right, b.shorter, c.right));
  EXPECT_REFUSED(texture::write_unit_vectors(a.right, b.right, c.longer));
  texture::PackedMap2 map;
  std::vector<float> whole(16), less(15);
  EXPECT_REFUSED(texture::pack_map2(4, less, whole, 0.0f, map));
  EXPECT_REFUSED(texture::pack_map2(4, whole, less, 0.0f, map));
  const texture::ImageF image{4, 4, 1, whole};
  EXPECT_REFUSED(texture::compute_slopes(image, texture::Edges::kClamped, 1.0f, less, whole));
  EXPECT_REFUSED(texture::compute_slopes(image, texture::Edges::kClamped, 1.0f, whole, less));
  terrain::HeightGrid terrain{{.samples_x = 2, .samples_y = 2}, {0.0f, 0.0f, 0.0f, 0.0f}};
  EXPECT_REFUSED(terrain::sample_heights(terrain, p.right, a.shorter));
  EXPECT_REFUSED(terrain::sample_heights(terrain, p.right, a.longer));
  EXPECT_REFUSED(terrain::sample_slopes(terrain, a.right, b.right));
  terrain.height_m.pop_back();
  EXPECT_REFUSED(terrain::sample_heights(terrain, p.right, a.right));
}

TEST_F(SpanDeathTest, RasterChecksEveryPair) {
  Lengths<glm::vec4> p_clip;
  Lengths<raster::WindowVertex> window;
  EXPECT_REFUSED(raster::project_vertices(p_clip.right, {}, {8, 8}, window.shorter));
  EXPECT_REFUSED(raster::project_vertices(p_clip.right, {a.longer}, {8, 8}, window.right));
  raster::Pass pass;
  const std::vector<std::uint32_t> indices = {0, 1, 2};
  const raster::Draw draw{.p_clip = p_clip.right, .indices = indices, .clip_distance = {a.shorter}};
  EXPECT_REFUSED(raster::prepare_pass(std::span(&draw, 1), {8, 8}, 16, pass, workers));
  raster::prepare_pass({}, {8, 8}, 16, pass, workers);
  std::vector<float> depth(256), shallow(255);
  std::vector<std::uint32_t> primitive(256), fewer(255);
  EXPECT_REFUSED(raster::draw_tile(pass, 0, shallow, primitive));
  EXPECT_REFUSED(raster::draw_tile(pass, 0, depth, fewer));
}

TEST_F(SpanDeathTest, RenderChecksEveryPair) {
  EnlargeTables tables;
  std::vector<std::uint32_t> four(4), sixteen(16), less(15);
  EXPECT_REFUSED(enlarge(four, {2, 2}, less, {4, 4}, tables, workers));
  EXPECT_REFUSED(enlarge(four, {2, 3}, sixteen, {4, 4}, tables, workers));

  Asked& sea = asked(workers);
  const View view = make_view({0, 0, 5}, 0.0, 0.0, 1.0, 0.25f, 8, 8);
  const Background background(view, sea.water.sea(), 1.0f, 1.0f);
  const scene::WaterSurface surface = sea.water.at(1.0, sea.frame, workers);
  EXPECT_REFUSED(background_heights(background, surface, p.right, v2.shorter, a.right));
  EXPECT_REFUSED(background_heights(background, surface, p.right, v2.right, a.shorter));

  ViewShading shading;
  shading.viewport = {16, 16};
  shading.grid = raster::tile_grid(shading.viewport, 16);
  auto scratch = std::make_unique<ShadeScratch>();
  std::vector<float> depth(256), shallow(255), linear(767);
  std::vector<std::uint32_t> primitive(256), fewer(255), rgba(256);
  texture::RgbaImage image;
  const auto shade = [&](auto& z, auto& id, auto& pixels, std::span<float> light) {
    shade_tile(shading, {.tile = 0, .depth = z, .primitive = id}, *scratch, pixels, light);
  };
  EXPECT_REFUSED(shade(shallow, primitive, rgba, {}));
  EXPECT_REFUSED(shade(depth, fewer, rgba, {}));
  EXPECT_REFUSED(shade(depth, primitive, fewer, {}));
  EXPECT_REFUSED(shade(depth, primitive, rgba, linear));
  EXPECT_REFUSED(shade_sky_tile(shading, 0, *scratch, fewer, {}));
  EXPECT_REFUSED(shade_planar_tile(shading, 0, shallow, primitive, *scratch, image));
}

}  // namespace
}  // namespace swell::render
