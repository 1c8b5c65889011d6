// Land found by rays, against the land of triangles.
#include "render/world/land_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/simd_target.h"
#include "render/measures.h"
#include "render/shot.h"
#include "render/tile/shading.h"
#include "render/view/cast_land.h"
#include "render/view/land_paths.h"
#include "render/view/refracted_image.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"
#include "terrain/height_rays.h"
#include "terrain/terrain.h"

namespace swell::render {
namespace {

scene::Scene load(const std::string& file) {
  return scene::load_scene(SWELL_SOURCE_DIR "/" + file);
}

scene::Scene with_rays(scene::Scene scene) {
  scene.detail.terrain_method = scene::TerrainMethod::kRays;
  return scene;
}

// Made once.
const World& lagoon_by_rays() {
  static const World world(with_rays(load_shipped("lagoon")), shipped_world("lagoon"), 2);
  return world;
}

Shot draw(const World& world, const View& view, FrameOptions options = {}, int threads = 2) {
  options.edge_samples = std::max(options.edge_samples, 0);
  return Shot(world, view, 5.0, options, threads);
}

// The whole picture, with mirror and floor.
TEST(LandRays, ShowWhatManyTrianglesShow) {
  for (const char* file : {"scenes/lagoon.toml", "scenes/beach.toml", "tests/scenes/hills.toml"}) {
    const scene::Scene scene = load(file);
    const World triangles = world_of(scene), rays = world_of(with_rays(scene));
    const View view = view_of(rays, 5.0, 320, 180);
    const Shot a = draw(triangles, view, {.terrain_triangles = 500000}), b = draw(rays, view);
    EXPECT_LT(mean_difference(a.target, b.target), 1.0) << file;
    EXPECT_EQ(b.statistics.terrain_triangles, 0) << file;
    EXPECT_EQ(b.statistics.shaded_pixels + b.statistics.interpolated_pixels,
              b.statistics.visible_pixels)
        << file;
  }
}

// Where the ridge of an island stands before the sky, and along the shore.
TEST(LandRays, HaveTheEdgesThatTrianglesHave) {
  const World& rays = lagoon_by_rays();
  const View view = view_of(rays, 5.0, 320, 180);
  const auto draw_edges = [&](const World& world, int samples) {
    return draw(world, view, {.terrain_triangles = 500000, .edge_samples = samples});
  };
  const Shot a = draw_edges(shipped_world("lagoon"), 8), b = draw_edges(rays, 8);
  const Shot rough = draw_edges(rays, 0);
  // Only pixels of edges differ, and they come nearer to those of triangles.
  const auto off = [&](const Shot& drawn) {
    double sum = 0.0;
    for (int y = 0; y < 180; ++y)
      for (int x = 0; x < 320; ++x)
        if (b.codes(x, y) != rough.codes(x, y))
          sum += std::abs(a.codes(x, y).g - drawn.codes(x, y).g);
    return sum;
  };
  EXPECT_GT(mean_difference(b.target, rough.target), 0.01);
  EXPECT_LT(off(b), 0.4 * off(rough));
  EXPECT_LT(mean_difference(a.target, b.target), 1.0);
}

// An outline at 6 m: from straight above, the pixels over lower ground show no land.
TEST(LandRays, EndAtTheOutline) {
  scene::Scene scene = with_rays(load_shipped("lagoon"));
  scene.terrain->outline_m = 6.0;
  const World world = world_of(scene);
  const View view = make_view({0.0, 0.0, 3000.0}, 0.0, radians(-90.0), 0.12, 0.25f, 200, 200);
  FrameOptions options;
  options.labels.add(Label::kId), options.labels.add(Label::kPosition);
  const Shot drawn = draw(world, view, options);
  const terrain::HeightGrid land = terrain::build_terrain(*scene.terrain);
  int inside = 0, wrong = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      // Where the pixel's ray comes down to 6 m.
      const glm::dvec3 ray = position_of(view, x, y, 1.0f) - view.eye_world;
      const double t = (6.0 - view.eye_world.z) / ray.z;
      const double height_m = terrain::height_at(land, glm::dvec2(view.eye_world + t * ray));
      if (std::abs(height_m - 6.0) < 0.05) continue;
      const bool is_land = drawn.target.labels.id[drawn.at(x, y)] == kLandId;
      inside += height_m > 6.0;
      wrong += is_land != (height_m > 6.0);
    }
  EXPECT_GT(inside, 1000);
  EXPECT_EQ(wrong, 0);
}

TEST(LandRays, HaveTheNormalOfTheirSurface) {
  const scene::Scene scene = load("tests/scenes/hills.toml");
  const World world = world_of(with_rays(scene));
  const View view = view_of(world, 5.0, 160, 90);
  FrameOptions options;
  for (const Label label : {Label::kId, Label::kDepth, Label::kGeometricNormal})
    options.labels.add(label);
  const Shot drawn = draw(world, view, options);
  const terrain::HeightGrid land = terrain::build_terrain(*scene.terrain);
  int seen = 0, off = 0;
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 160; ++x) {
      const std::size_t at = drawn.at(x, y);
      const glm::dvec2 p(position_of(view, x, y, drawn.target.labels.depth_m[at]));
      if (drawn.target.labels.id[at] != kLandId || !land.grid.holds(p)) continue;
      const glm::dvec3 n = glm::normalize(glm::dvec3(-terrain::slope_at(land, p), 1.0));
      ++seen;
      off += glm::distance(n, glm::dvec3(drawn.target.labels.geometric_normal[at])) > 0.02;
    }
  EXPECT_GT(seen, 2000);
  EXPECT_LT(off, seen / 100);  // on either side of a post
}

// Rays that set out from where their square's beam is free, and that do not.
TEST(LandRays, AreNotLostByBeams) {
  const World& world = lagoon_by_rays();
  constexpr int kSide_px = 64;
  int hits = 0, wrong = 0;
  for (const ViewKind kind : {ViewKind::kWindow, ViewKind::kReflection, ViewKind::kRefraction})
    for (const bool submerged : {false, true})
      for (int n = 0; n < 12; ++n) {
        const double eye_z = (submerged ? -1.0 : 1.0) * (0.4 + 0.3 * n * n);
        RenderView view;
        view.kind = kind;
        view.eye.submerged = submerged;
        view.land = world.state().land_rays.get();
        view.drop_per_m2 = n % 2 ? 7.8e-8f : 0.0f;
        view.camera =
            make_view({40.0 * n - 260.0, -420.0 + 30.0 * n, eye_z}, 0.13 * n - 0.6,
                      (submerged ? 0.1 : -0.1) * (n % 4), 0.2 + 0.1 * n, 0.25f, kSide_px, kSide_px);
        std::vector<float> depth(kSide_px * kSide_px);
        std::vector<std::uint32_t> primitive(depth.size());
        const raster::TileGrid grid = raster::tile_grid(view.viewport(), kSide_px);
        cast_land(view, grid, 0, true, depth, primitive);
        const ViewRays rays = make_rays(view.camera);
        for (int y = 0; y < kSide_px; ++y)
          for (int x = 0; x < kSide_px; ++x) {
            const glm::vec3 ray = rays.ray + float(y) * rays.ray_dy + float(x) * rays.ray_dx;
            const LandPath path = land_path(view, ray);
            float t = 1e30f;
            for (const terrain::HeightPyramid* map : {&view.land->map, &view.land->around}) {
              float met;
              const auto one = [](const float& value) { return std::span(&value, 1); };
              terrain::cast_rays(*map, glm::dvec2(view.camera.eye_world), rays.pixel_angle,
                                 {one(ray.x), one(ray.y), one(path.z), one(path.z_t),
                                  one(path.z_tt), one(path.begin), one(path.end)},
                                 std::span(&met, 1));
              t = std::min(t, met);
            }
            const float drawn = depth[static_cast<std::size_t>(y * kSide_px + x)];
            const float expected = std::min(rays.near_m / t, 1.0f);
            hits += t < 1e30f;
            wrong += std::abs(drawn - expected) > 1e-3f * expected + 1e-9f;
          }
      }
  EXPECT_GT(hits, 50000);
  EXPECT_EQ(wrong, 0);
}

TEST(LandRays, AreTheSameBitsOverThreadsTargetsAndTiles) {
  const World& world = lagoon_by_rays();
  const View view = view_of(world, 5.0, 161, 91);
  const Shot one = draw(world, view, {.edge_samples = 4}, 1);
  for (const SimdTarget target : simd_targets()) {
    if (!simd_target_available(target)) continue;
    select_simd_target(target);
    const Shot three = draw(world, view, {.tile_size_px = 32, .edge_samples = 4}, 3);
    EXPECT_EQ(three.target.rgba, one.target.rgba);
  }
}

// From under water the land is seen through the surface, and the floor mirrors in it.
TEST(LandRays, AreSeenFromUnderWater) {
  const View view = make_view({-15.0, -420.0, -4.0}, 0.05, 0.35, radians(70.0), 0.25f, 240, 136);
  const Shot a = draw(shipped_world("lagoon"), view, {.terrain_triangles = 500000});
  const Shot b = draw(lagoon_by_rays(), view);
  EXPECT_LT(mean_difference(a.target, b.target), 2.0);
}

scene::Scene with_paper_refraction(scene::Scene scene) {
  scene.water.refraction = scene::RefractionModel::kPaper;
  return scene;
}

// Ma, Zhu, Gong, 2006: the scene under water is squeezed by k, whoever finds it.
TEST(LandRays, AreSqueezedByThePapersRatioAsTrianglesAre) {
  const scene::Scene scene = with_paper_refraction(load_shipped("lagoon"));
  const World triangles = world_of(scene), rays = world_of(with_rays(scene));
  const View view = make_view({-15.0, -420.0, 6.0}, 0.05, -0.5, radians(70.0), 0.25f, 240, 136);
  const FrameOptions calm{.terrain_triangles = 500000,
                          .without = {Part::kHaze, Part::kReflection, Part::kCaustics}};
  const Shot a = draw(triangles, view, calm), b = draw(rays, view, calm);
  const Shot exact = draw(lagoon_by_rays(), view, calm);
  EXPECT_LT(mean_difference(a.target, b.target), 0.3);
  EXPECT_GT(mean_difference(exact.target, b.target), 2.0 * mean_difference(a.target, b.target));
}

// What one side of a plane shows and what the other shows is all there is, and each is what
// triangles show of it; but where ground is cut open triangles are hollow.
TEST(LandRays, EndAtTheCallersClipPlane) {
  const View view = view_of(lagoon_by_rays(), 5.0, 240, 136);
  const auto drawn = [&](const World& world, const std::optional<glm::dvec4>& plane) {
    FrameOptions options{.terrain_triangles = 500000, .clip_plane = plane};
    options.labels.add(Label::kId), options.labels.add(Label::kDepth);
    return draw(world, view, options);
  };
  const Shot all = drawn(lagoon_by_rays(), std::nullopt);
  for (const glm::dvec4& plane : {glm::dvec4(1.0, 0.3, 0.0, 20.0), {0.0, 0.0, 1.0, -12.0}}) {
    const Shot one = drawn(lagoon_by_rays(), plane), other = drawn(lagoon_by_rays(), -plane);
    const Shot triangles = drawn(shipped_world("lagoon"), plane);
    const auto side_of = [&](const Shot& shot, std::size_t i) {
      const int x = static_cast<int>(i) % view.width_px, y = static_cast<int>(i) / view.width_px;
      const glm::dvec3 p = position_of(view, x, y, shot.target.labels.depth_m[i]);
      return glm::dot(glm::dvec3(plane), p) + plane.w;
    };
    int kept = 0, cut = 0, unlike = 0;
    for (std::size_t i = 0; i < all.target.labels.id.size(); ++i) {
      if (all.target.labels.id[i] != kLandId) continue;
      const double side = side_of(all, i);
      if (std::abs(side) < 0.5) continue;
      (side > 0.0 ? kept : cut) += 1;
      EXPECT_EQ((side > 0.0 ? one : other).target.labels.id[i], kLandId) << i;
      if (one.target.labels.id[i] != kLandId || side_of(one, i) > 0.1)
        unlike += one.target.labels.id[i] != triangles.target.labels.id[i];
    }
    EXPECT_GT(kept, 300);
    EXPECT_GT(cut, 300);
    EXPECT_LT(unlike, (kept + cut) / 100);
  }
}

// A refracted ray's point and its image lie where Snell's law puts them.
TEST(LandPath, GoesWhereLightInWaterGoes) {
  RenderView view;
  view.kind = ViewKind::kRefraction;
  view.camera = make_view({0.0, 0.0, 5.0}, 0.0, -0.5, 1.0, 0.25f, 100, 100);
  view.refraction_index = 1.333f;
  for (const float dip : {-0.2f, -0.6f, -2.0f}) {
    const glm::vec3 direction(0.6f, 0.8f, dip);
    const LandPath path = land_path(view, direction);
    for (const float depth_m : {0.5f, 4.0f, 20.0f}) {
      const float t = (-depth_m - path.z) / path.z_t;  // the ray's point lies so deep
      const float apparent_m = apparent_depth_m({5.0f, depth_m, t}, 1.333f);
      EXPECT_NEAR(5.0f + dip * t, -apparent_m, 2e-3f * (1.0f + t)) << dip << " " << depth_m;
    }
  }
}

// The paper's straight lines for apparent over true depth bend a ray in water; the chord to a point
// ends where the point's image, as vertices have it, lies on the ray.
TEST(LandPath, GoesWhereThePaperPutsWhatIsInWater) {
  RenderView view;
  view.kind = ViewKind::kRefraction;
  view.paper_refraction = true;
  view.camera = make_view({0.0, 0.0, 5.0}, 0.0, -0.5, 1.0, 0.25f, 100, 100);
  view.refraction_index = 1.333f;
  const PointMap map{ViewKind::kRefraction, {.to_surface_m = 5.0f}, 1.333f, true};
  for (const float dip : {-0.1f, -0.6f, -0.97f, -0.98f, -3.0f}) {
    const glm::vec3 direction(0.6f, 0.8f, dip);
    for (const float depth_m : {0.01f, 0.5f, 4.0f, 20.0f, 200.0f}) {
      float t = 0.0f;
      for (int n = 0; n < 8; ++n) {
        const LandPath path = land_path(view, direction, t);
        t = (-depth_m - path.z) / path.z_t;
      }
      const glm::vec3 p = t * direction;
      const glm::vec3 shown = map_point(map, {{p.x, p.y, -5.0f - depth_m}, -depth_m, -5.0f});
      EXPECT_NEAR(shown.z / t, dip, 2e-3f * std::abs(dip)) << dip << " " << depth_m;
    }
  }
  // In shallow water it falls by its own angle's ratio, 0.75 - 0.16 theta.
  const float theta = std::atan(1.0f);
  const LandPath shallow = land_path(view, {0.6f, 0.8f, -1.0f});
  EXPECT_NEAR(shallow.z_t, -1.0f / (0.75f - 0.16f * theta), 1e-4f);
}

TEST(LandPath, OfAMirrorRisesFromTheLevel) {
  RenderView view;
  view.kind = ViewKind::kReflection;
  view.camera = make_view({0.0, 0.0, 5.0}, 0.0, -0.5, 1.0, 0.25f, 100, 100);
  const LandPath path = land_path(view, {0.0f, 1.0f, -0.5f});
  EXPECT_NEAR(path.begin, 10.0f, 1e-5f);
  EXPECT_NEAR(path.z + path.z_t * 30.0f, 10.0f, 1e-5f);
  const LandPath sky = land_path(view, {0.0f, 1.0f, 0.5f});
  EXPECT_GE(sky.begin, sky.end);
}

}  // namespace
}  // namespace swell::render
