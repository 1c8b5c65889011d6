#include "apps/bench/lod_comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "apps/bench/frame_run.h"
#include "lod/uniform_grid.h"
#include "ocean/water_surface.h"
#include "render/measure/mesh_error.h"
#include "render/workspace.h"
#include "scene/water.h"

namespace swell::apps {
namespace {

constexpr double kTime_s = 4.0;
constexpr double kSpeed_mps = 30.0;

struct NamedView {
  std::string name;
  glm::dvec3 eye;
  double heading_rad, pitch_rad;

  View at(glm::dvec3 moved_m, int width_px, int height_px) const {
    return make_view(eye + moved_m, heading_rad, pitch_rad, radians(50.0), 0.25f, width_px,
                     height_px);
  }
};

std::vector<NamedView> compared_views(const scene::WaterSurface& surface) {
  const glm::dvec2 boat(0.0, -600.0);
  const double boat_z = std::max(static_cast<double>(surface.height(boat)), 0.0) + 2.5;
  return {{"bridge, 10 m", {0.0, -900.0, 10.0}, radians(20.0), radians(-7.0)},
          {"boat, 2.5 m", {boat, boat_z}, radians(20.0), radians(-3.0)}};
}

// One triangulation of the scene, drawn by the renderer itself.
class Drawn {
 public:
  explicit Drawn(scene::Triangulation triangulation) : world_(scene_with(triangulation)) {}

  static scene::Scene scene_with(scene::Triangulation triangulation) {
    scene::Scene scene = scene::parse_scene(
        "[sea]\nsize_m = [3000.0, 2000.0]\nearth = \"flat\"\ntiling = false\n", "comparison.toml");
    scene.detail.triangulation = triangulation;
    return scene;
  }

  const render::World& world() const { return world_; }

  const render::Surface& draw(const View& view, int budget, Workers& workers) {
    render::FrameOptions options;
    options.water_triangles = budget;
    statistics_ = render_frame(world_, view, kTime_s, options, workspace_, target_, workers);
    return workspace_.state().meshes.water;
  }

  // The median over a short straight flight; the picture's size does not matter.
  double triangulate_ms(const NamedView& view, int budget, int frames, Workers& workers) {
    std::vector<double> ms;
    for (int k = -1; k < frames; ++k) {
      draw(view.at({0.0, kSpeed_mps / kFramesPerSecond * k, 0.0}, 160, 90), budget, workers);
      if (k >= 0)
        ms.push_back(statistics_.stage_ms[static_cast<std::size_t>(render::Stage::kTriangulate)]);
    }
    return spread(ms).median;
  }

 private:
  render::World world_;
  render::Workspace workspace_;
  render::Target target_;
  render::FrameStatistics statistics_;
};

ComparisonRow row_of(const NamedView& view, std::string triangulation, int triangles,
                     const render::MeshError& error) {
  ComparisonRow row{view.name, std::move(triangulation), triangles};
  row.height_px = spread(error.height_px);
  row.silhouette_px = spread(error.silhouette_px);
  row.silhouette_mean_px =
      std::accumulate(error.silhouette_px.begin(), error.silhouette_px.end(), 0.0) /
      static_cast<double>(error.silhouette_px.size());
  return row;
}

ComparisonRow uniform_row(const NamedView& view, const render::SeaReference& sea,
                          const scene::WaterSurface& surface, const scene::SeaArea& area,
                          int budget, Workers& workers) {
  const lod::Domain domain{area.centre_m - 2048.0, 4096.0, 20};
  lod::Mesh mesh;
  lod::write_uniform_grid(domain, area.centre_m - 0.5 * area.size_m,
                          area.centre_m + 0.5 * area.size_m, budget, mesh);
  std::vector<glm::dvec2> p;
  for (const glm::ivec2& lattice : mesh.lattice) p.push_back(domain.point(lattice));
  std::vector<float> height_m(p.size());
  surface.heights(p, height_m);
  return row_of(view, "uniform", static_cast<int>(mesh.level.size()),
                render::measure_mesh_error(sea, domain, mesh, height_m, workers));
}

}  // namespace

std::vector<ComparisonRow> compare_triangulations(const Comparison& comparison, Workers& workers) {
  Drawn roam(scene::Triangulation::kRoam), radial(scene::Triangulation::kRadial),
      plane(scene::Triangulation::kPlane);
  const scene::Scene& scene = roam.world().scene();
  const scene::Water water = roam.world().water();
  ocean::SeaFrame frame;
  const scene::WaterSurface surface = water.at(kTime_s, frame, workers);

  std::vector<ComparisonRow> rows;
  for (const NamedView& view : compared_views(surface)) {
    const View whole = view.at({}, comparison.width_px, comparison.height_px);
    const render::SeaReference sea =
        render::look_at_sea(whole, surface, scene.area, comparison.pixel_step, workers);
    const auto add = [&](const char* name, Drawn& drawn, int budget) {
      const render::Surface& mesh = drawn.draw(whole, budget, workers);
      rows.push_back(
          row_of(view, name, mesh.statistics.triangles,
                 render::measure_mesh_error(sea, mesh.domain, mesh.mesh, mesh.height_m, workers)));
      rows.back().triangulate_ms =
          drawn.triangulate_ms(view, budget, comparison.timed_frames, workers);
    };
    for (const int budget : comparison.budgets) {
      add("roam", roam, budget);
      add("radial", radial, budget);
      rows.push_back(uniform_row(view, sea, surface, scene.area, budget, workers));
    }
    add("plane", plane, 2);
  }
  return rows;
}

std::string comparison_table(std::span<const ComparisonRow> rows) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ComparisonRow& r = rows[i];
    if (i == 0 || rows[i - 1].view != r.view)
      text += fmt::format("{:<14} {:>9} {:>8} {:>8} {:>8} {:>11} {:>8} {:>12}\n", r.view,
                          "triangles", "median", "p95", "max", "silhouette", "max", "triangulate");
    text +=
        fmt::format("  {:<12} {:>9} {:>8.3f} {:>8.3f} {:>8.2f} {:>11.3f} {:>8.2f} {:>9.3f} ms\n",
                    r.triangulation, r.triangles, r.height_px.median, r.height_px.p95,
                    r.height_px.max, r.silhouette_mean_px, r.silhouette_px.max, r.triangulate_ms);
  }
  return text;
}

}  // namespace swell::apps
