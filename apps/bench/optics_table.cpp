#include "apps/bench/optics_table.h"

#include <fmt/core.h>

#include <algorithm>

#include "apps/bench/frame_run.h"
#include "apps/shared/report.h"
#include "math/check.h"
#include "render/world_view.h"
#include "scene/objects.h"

namespace swell::apps {
namespace {

void stop_objects(scene::Scene& scene) {
  for (scene::FloatingObject& object : scene.objects) {
    const scene::PlanPose pose = scene::plan_pose(object, 0.0);
    object.position_m = pose.position_m;
    object.heading_rad = pose.heading_rad;
    object.path_m.clear();
  }
}

// With as many triangles of land as the objects leave.
StillScene fill_with_land(render::World world, const FrameSetup& setup, int triangles,
                          Workers& workers) {
  ocean::SeaFrame camera_sea;
  const View view = render::world_view(world, 0.0, setup.size.width_px, setup.size.height_px,
                                       camera_sea, workers);
  StillScene still{std::move(world), view, setup.frame};
  still.frame.without.add(render::Part::kUnderwater);  // an eye below shows other objects
  render::Workspace workspace;
  render::Target target;
  const auto draw = [&](int land_triangles) {
    still.frame.terrain_triangles = std::max(land_triangles, 2);
    return render::render_frame(still.world, view, 0.0, still.frame, workspace, target, workers);
  };
  still.object_triangles = draw(0).object_triangles;
  still.land_triangles = draw(triangles - still.object_triangles).terrain_triangles;
  return still;
}

render::FrameStatistics draw(const StillScene& still, int frame,
                             const render::FrameOptions& options, render::Workspace& workspace,
                             render::Target& target, Workers& workers) {
  const double t_s = frame / kFramesPerSecond;
  const render::FrameStatistics drawn =
      render::render_frame(still.world, still.view, t_s, options, workspace, target, workers);
  SWELL_CHECK(drawn.terrain_triangles == still.land_triangles &&
                  drawn.object_triangles == still.object_triangles,
              "{} and {} triangles", drawn.terrain_triangles, drawn.object_triangles);
  return drawn;
}

}  // namespace

std::optional<StillScene> make_still_scene(const render::World& world, const FrameSetup& setup,
                                           int triangles, Workers& workers) {
  scene::Scene still = world.scene();
  still.detail.triangulation = scene::Triangulation::kPlane;
  stop_objects(still);
  for (std::size_t left_out = 0; left_out <= still.objects.size(); ++left_out) {
    scene::Scene fewer = still;
    if (left_out > 0)
      fewer.objects.erase(fewer.objects.begin() + static_cast<std::ptrdiff_t>(left_out) - 1);
    StillScene made = fill_with_land(render::World(std::move(fewer), world, setup.threads), setup,
                                     triangles, workers);
    if (made.land_triangles + made.object_triangles == triangles) return made;
  }
  return std::nullopt;
}

OpticsRow measure_water(const StillScene& still, int frames, Workers& workers) {
  render::FrameOptions without = still.frame;
  without.without.add(render::Part::kWater);
  render::Workspace dry_workspace, wet_workspace;
  render::Target target;
  std::vector<double> dry_ms, wet_ms, shading_ms, lookups_ms;
  for (int k = -kWarmUp; k < frames; ++k) {
    const auto dry = draw(still, k, without, dry_workspace, target, workers);
    const auto wet = draw(still, k, still.frame, wet_workspace, target, workers);
    if (k < 0) continue;
    dry_ms.push_back(dry.frame_ms);
    wet_ms.push_back(wet.frame_ms);
    shading_ms.push_back(wet.stage_ms[static_cast<std::size_t>(render::Stage::kShade)]);
    lookups_ms.push_back(wet.stage_ms[static_cast<std::size_t>(render::Stage::kPlanarMaps)]);
  }
  const auto median = [](std::vector<double>& ms) { return spread(std::move(ms)).median; };
  return {still.land_triangles,
          still.object_triangles,
          {median(dry_ms), median(wet_ms)},
          median(shading_ms),
          median(lookups_ms)};
}

std::string optics_text(std::span<const OpticsRow> rows) {
  std::string text = fmt::format(
      "frames/s without and with water of two triangles, and the water's share of a frame's time;\n"
      "ms to shade a frame with it, and to draw what it looks into\n"
      "{:>9} {:>9} {:>9} {:>6} {:>8} {:>8}   GeForce FX 5600 (Ma and others, 2006)\n",
      "triangles", "without", "with", "%", "shading", "lookups");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PaperRow& paper = kPaperRows[i];
    const WaterCost& cost = rows[i].cost;
    text += fmt::format("{:>9} {:>9.1f} {:>9.1f} {:>6.1f} {:>8.2f} {:>8.2f} {:>9} {:>4} {:>6.1f}\n",
                        rows[i].land_triangles + rows[i].object_triangles, 1e3 / cost.dry_ms,
                        1e3 / cost.wet_ms, 100.0 * cost.water_share(), rows[i].shading_ms,
                        rows[i].lookups_ms, paper.dry_per_s, paper.wet_per_s,
                        100.0 * paper.cost().water_share());
  }
  return text +
         "The card was as fast with the water where vertices kept it busy. Here triangles are "
         "cheap, and\nwhat takes the time is pixels, as many of water in each row.\n";
}

Json optics_json(std::span<const OpticsRow> rows) {
  Json json = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PaperRow& paper = kPaperRows[i];
    const WaterCost& cost = rows[i].cost;
    json.push_back({{"triangles", rows[i].land_triangles + rows[i].object_triangles},
                    {"land_triangles", rows[i].land_triangles},
                    {"object_triangles", rows[i].object_triangles},
                    {"ms_without", cost.dry_ms},
                    {"ms_with", cost.wet_ms},
                    {"water_share", cost.water_share()},
                    {"ms_shading", rows[i].shading_ms},
                    {"ms_lookups", rows[i].lookups_ms},
                    {"paper",
                     {{"frames_per_s_without", paper.dry_per_s},
                      {"frames_per_s_with", paper.wet_per_s},
                      {"water_share", paper.cost().water_share()}}}});
  }
  return json;
}

}  // namespace swell::apps
