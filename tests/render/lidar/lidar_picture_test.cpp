// A lidar beside the picture from its place: beams through drawn vertices are as long as these are
// far, and through pixels as the label "distance" says but for what triangles cut off: in height at
// most L s / 2, s the longest edge of a triangle, L the waves' steepest slope (water_surface.h).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lod/mesh_query.h"
#include "ocean/water_surface.h"
#include "render/labels/labels.h"
#include "render/measure/lidar.h"
#include "render/sea/sea_maps.h"
#include "render/shot.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr double kFarthest_m = 100.0;

struct Beside {
  explicit Beside(const char* name, int triangles) : world(flat(name)) {
    LabelSet labels = LabelSet::all();
    shot.draw(world, view_of(world, 2.0, 240, 160), 2.0,
              {.water_triangles = triangles, .background_error_px = 0.0, .labels = labels});
  }
  static World flat(const char* name) {
    scene::Scene scene = load_shipped(name);
    scene.round_earth = false;
    return world_of(scene);
  }

  // Of beams from the camera's eye along directions of the world.
  std::vector<LidarReturn> scanned(const std::vector<glm::dvec3>& along) {
    std::vector<LidarBeam> beams;
    for (const glm::dvec3& d : along)
      beams.push_back({std::atan2(d.y, d.x), std::atan2(d.z, std::hypot(d.x, d.y)), 0.0});
    std::vector<LidarReturn> returns(beams.size());
    Lidar lidar(world, shot.workers);
    lidar.scan({.t_s = 2.0, .begin = {shot.view.eye_world}, .beams = beams, .most_m = 2e3}, returns,
               shot.workers);
    return returns;
  }

  double height(glm::dvec2 p) const {
    const auto surface = water_surface(world.state(), *shot.state().sea);
    return static_cast<double>(surface.height(p));
  }
  // The longest piece of a beam from the eye that is under water, from 15 cm before a place to
  // where it has its return, or 1 m after the place.
  double longest_under(glm::dvec3 along, double at_m, double range_m) const {
    double longest = 0.0, length = 0.0;
    for (double s = at_m - 0.15; s < std::min(range_m - 0.001, at_m + 1.0); s += 0.001) {
      const glm::dvec3 p = shot.view.eye_world + s * along;
      length = p.z <= height(glm::dvec2(p)) ? length + 0.001 : 0.0;
      longest = std::max(longest, length);
    }
    return longest;
  }

  World world;
  Shot shot;
};

double at_share(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values.empty()
             ? 0.0
             : values[static_cast<std::size_t>(share * (static_cast<double>(values.size()) - 1.0))];
}

// Shares of values by size, in half decades.
constexpr std::array<double, 10> kBins_m = {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0};
std::string histogram_head() {
  std::string text = fmt::format("{:>26}", "m, up to");
  for (const double bin_m : kBins_m) text += fmt::format("{:>8g}", bin_m);
  return text + "    more";
}
std::string histogram(const char* name, const std::vector<double>& values_m) {
  std::array<std::size_t, kBins_m.size() + 1> counts{};
  for (const double value_m : values_m)
    ++counts[static_cast<std::size_t>(std::ranges::lower_bound(kBins_m, value_m) -
                                      kBins_m.begin())];
  std::string text = fmt::format("{:>26}", name);
  for (const std::size_t count : counts)
    text += fmt::format("{:>6.2f} %",
                        100.0 * static_cast<double>(count) / static_cast<double>(values_m.size()));
  return text;
}

// The sea as it is drawn, and how far its triangles are from the water.
class DrawnSea {
 public:
  explicit DrawnSea(const Beside& beside)
      : water_(beside.shot.state().meshes.water),
        surface_(water_surface(beside.world.state(), *beside.shot.state().sea)) {
    lod::build_envelopes(water_.mesh, water_.height_m, envelopes_);
  }

  struct Triangle {
    double height_m, allowed_m;  // here; how far it may be from the water, in height
  };
  std::optional<Triangle> triangle(const glm::dvec3& p_world) const {
    const auto found = lod::triangle_at(mesh_, glm::dvec2(p_world));
    if (found.triangle == lod::kNoTriangle) return std::nullopt;
    std::array<glm::dvec2, 3> v;
    for (std::size_t k = 0; k < 3; ++k)
      v[k] = vertex_world(mesh_, water_.mesh.indices[3 * found.triangle + k]);
    const double edge_m =
        std::max({glm::distance(v[0], v[1]), glm::distance(v[1], v[2]), glm::distance(v[2], v[0])});
    return Triangle{found.height_m, 0.5 * static_cast<double>(surface_.bounds().slope) * edge_m};
  }

  // Where a triangle is drawn at a place: how far it is from the water in height, and how many
  // metres a beam goes while it comes one nearer to the water, which is a plane there.
  struct CutOff {
    double height_m, beam_m_per_m;
  };
  CutOff cut_off(const glm::dvec3& p_world, const glm::dvec3& along) const {
    const glm::dvec2 p(p_world);
    glm::vec2 slope;
    surface_.slopes({&p, 1}, {&slope, 1});
    return {std::abs(p_world.z - static_cast<double>(surface_.height(p))),
            1.0 / std::abs(along.z - glm::dot(glm::dvec2(along), glm::dvec2(slope)))};
  }

 private:
  const Surface& water_;
  ocean::WaterSurface surface_;
  lod::Envelopes envelopes_;
  lod::HeightMesh mesh_{water_.mesh, envelopes_, water_.height_m, water_.domain};
};

class BesidePicture : public testing::TestWithParam<const char*> {};

TEST_P(BesidePicture, BeamsThroughDrawnVerticesAreAsLongAsTheseAreFar) {
  Beside beside(GetParam(), 20000);
  const Surface& water = beside.shot.state().meshes.water;
  const View& view = beside.shot.view;
  std::vector<glm::dvec3> along;
  std::vector<double> distance_m;
  const lod::HeightMesh mesh{water.mesh, {}, water.height_m, water.domain};
  for (std::size_t n = 0; n < water.height_m.size(); ++n) {
    const glm::dvec3 rel = vertex_world(mesh, n) - view.eye_world;
    const double s = glm::length(rel);
    if (s > kFarthest_m || s < 1.0 || glm::dot(rel, glm::dvec3(view.forward)) < 0.5 * s) continue;
    along.push_back(rel / s);
    distance_m.push_back(s);
  }
  ASSERT_GT(along.size(), 100u);
  const std::vector<LidarReturn> returns = beside.scanned(along);
  std::size_t seen = 0, past = 0, elsewhere = 0;
  for (std::size_t n = 0; n < returns.size(); ++n) {
    const auto range_m = static_cast<double>(returns[n].range_m);
    seen += std::abs(range_m - distance_m[n]) < 1e-3;
    if (range_m < distance_m[n] + 1e-3) continue;
    const glm::dvec3 vertex = view.eye_world + distance_m[n] * along[n];
    if (std::abs(vertex.z - beside.height(glm::dvec2(vertex))) > 1e-4) {
      ++elsewhere;  // drawn, but not where the water is
      continue;
    }
    ++past;
    EXPECT_LT(beside.longest_under(along[n], distance_m[n], range_m), 0.022 + 2e-4 * distance_m[n])
        << n;
  }
  // The others are behind crests, things or the shore; a beam that grazes a crest goes past.
  fmt::print("{}: {} vertices, {} within 1 mm, {} grazed, {} not on the water\n", GetParam(),
             returns.size(), seen, past, elsewhere);
  EXPECT_GT(seen, returns.size() / 2);
  EXPECT_LE(past, returns.size() / 200);
  EXPECT_LE(elsewhere, returns.size() / 100);
}

TEST_P(BesidePicture, BeamsThroughPixelsAreAsLongAsTheirLabelsSay) {
  Beside beside(GetParam(), 200000);
  const Shot& shot = beside.shot;
  const Labels& labels = shot.target.labels;
  std::vector<glm::dvec3> along;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 240; ++x) along.push_back(shot.direction(x, y));
  const std::vector<LidarReturn> returns = beside.scanned(along);
  const DrawnSea sea(beside);
  const double focal_px = 0.5 * 160.0 / static_cast<double>(shot.view.tan_half_y);
  std::vector<double> off_m, height_off_m;
  std::vector<double> allowed_m, from_triangle_m, cut_off_m, sea_off_m, cut_off_px, sea_off_px;
  std::size_t others = 0, compared = 0;
  for (std::size_t n = 0; n < returns.size(); ++n) {
    const double drawn_m = distance_of(shot.view, static_cast<int>(n % 240),
                                       static_cast<int>(n / 240), labels.depth_m[n]);
    if (!(drawn_m < kFarthest_m)) continue;
    ++compared;
    if (returns[n].id != labels.id[n]) {
      ++others;
      continue;
    }
    off_m.push_back(std::abs(static_cast<double>(returns[n].range_m) - drawn_m));
    height_off_m.push_back(off_m.back() * std::abs(along[n].z));
    const glm::dvec3 drawn = shot.view.eye_world + drawn_m * along[n];
    const glm::dvec3 met = shot.view.eye_world + double{returns[n].range_m} * along[n];
    const auto at_drawn = sea.triangle(drawn), at_met = sea.triangle(met);
    if (labels.id[n] != kWaterId || !at_drawn || !at_met) continue;
    if (std::abs(at_drawn->height_m - drawn.z) > 1e-3) continue;  // of a river
    allowed_m.push_back(at_met->allowed_m);
    from_triangle_m.push_back(std::abs(met.z - at_met->height_m));
    EXPECT_LT(from_triangle_m.back(), allowed_m.back() + 1e-3) << n;
    const auto [height_m, beam_m_per_m] = sea.cut_off(drawn, along[n]);
    cut_off_m.push_back(height_m * beam_m_per_m);
    cut_off_px.push_back(height_m * focal_px / drawn_m);
    sea_off_m.push_back(off_m.back());
    sea_off_px.push_back(off_m.back() / beam_m_per_m * focal_px / drawn_m);
  }
  fmt::print("{}: {} pixels, {} of other things, {} of the sea\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n",
             GetParam(), compared, others, sea_off_m.size(), histogram_head(),
             histogram("along the beam", off_m), histogram("in height", height_off_m),
             histogram("sea: along the beam", sea_off_m), histogram("triangles cut off", cut_off_m),
             histogram("above a triangle", from_triangle_m),
             histogram("allowed, L s / 2", allowed_m));
  EXPECT_GT(compared, 3000u);
  EXPECT_LT(others, compared / 50);
  EXPECT_LT(at_share(height_off_m, 0.5), 0.01);
  EXPECT_LT(at_share(height_off_m, 0.95), 0.05);
  EXPECT_LT(at_share(off_m, 0.5), 0.02);
  // In pixels beams are as far off as the drawn triangles, which are measured without beams.
  EXPECT_GT(sea_off_px.size(), compared / 2);
  for (const double share : {0.5, 0.9, 0.95, 0.99}) {
    const double drawn_px = at_share(cut_off_px, share), beam_px = at_share(sea_off_px, share);
    fmt::print("{:.0f} % within {:.4f} px, the triangles within {:.4f} px\n", 100.0 * share,
               beam_px, drawn_px);
    EXPECT_NEAR(beam_px, drawn_px, 0.1 * drawn_px);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, BesidePicture, testing::Values("harbour", "open_ocean", "river"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace swell::render
