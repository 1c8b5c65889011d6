#include "apps/view/scene_controls.h"

#include <fmt/core.h>
#include <imgui.h>

#include <string>

#include "apps/view/widgets.h"
#include "math/elementary.h"
#include "ocean/spectrum/sea_scale.h"

namespace swell::view {
namespace {

// "5 rough", or none for a sea that has no number.
bool draw_sea_state(std::optional<int>& sea_state) {
  const auto name_of = [](int code) {
    return fmt::format("{} {}", code, ocean::douglas_step(code).name);
  };
  const std::string shown = sea_state ? name_of(*sea_state) : "by the wind";
  if (!ImGui::BeginCombo("state (0-9)", shown.c_str())) return false;
  const std::optional<int> before = sea_state;
  if (ImGui::Selectable("by the wind", !sea_state)) sea_state.reset();
  for (int code = 0; code <= ocean::kMaxDouglas; ++code)
    if (ImGui::Selectable(name_of(code).c_str(), sea_state == code)) sea_state = code;
  ImGui::EndCombo();
  return sea_state != before;
}

bool draw_wind(const scene::Scene& scene, WaveChoice& waves) {
  double speed_mps = wind_speed_mps(scene, waves);
  bool changed = false;
  if (slide("wind speed", speed_mps, 0.0, 40.0, "%.1f m/s")) {
    waves.sea_state.reset();
    waves.wind_speed_mps = speed_mps;
    changed = true;
  }
  return slide_angle("wind from", waves.wind_from_rad, 0.0, 360.0) || changed;
}

bool draw_sun(AirChoice& air) {
  bool changed = ImGui::Checkbox("sun and moon by the time", &air.by_time);
  if (air.by_time) {
    const int minutes = static_cast<int>(60.0 * air.hour_utc + 0.5);
    const std::string clock = fmt::format("{:02}:{:02} UTC", minutes / 60 % 24, minutes % 60);
    return slide("time", air.hour_utc, 0.0, 23.99, clock.c_str()) || changed;
  }
  changed |= slide_angle("sun towards", air.sun_azimuth_rad, 0.0, 360.0);
  return slide_angle("sun's height", air.sun_elevation_rad, -18.0, 90.0) || changed;
}

bool draw_clouds(bool has_placed, AirChoice& air) {
  using enum scene::CloudKind;
  constexpr auto kNames = enum_table<scene::CloudKind, const char*>(
      {{kNone, "thin alone"}, {kLayer, "a layer"}, {kPlaced, "placed"}});
  const auto without_last = static_cast<std::size_t>(kPlaced);
  bool changed = choose("clouds", air.clouds, kNames, has_placed ? kNames.size() : without_last);
  if (air.clouds == kLayer) changed |= slide("layer's cover", air.cover, 0.0, 1.0, "%.2f");
  return slide("thin cover", air.thin_cover, 0.0, 1.0, "%.2f") || changed;
}

bool draw_fog(AirChoice& air) {
  const bool changed = ImGui::Checkbox("fog", &air.fog);
  if (!air.fog) return changed;
  return slide_by_decades("visibility", air.visibility_m, 10.0, 20000.0, "%.0f m") || changed;
}

// What counts as nearer or further when triangles are split.
bool draw_priorities(scene::Detail& detail) {
  if (!ImGui::TreeNode("what counts as nearer or further")) return false;
  bool changed = slide("objects", detail.objects, 1.0, 64.0, "%.1f x nearer");
  changed |= slide("backs", detail.back_facing, 1.0, 16.0, "%.1f x further");
  changed |= slide("smooth", detail.normal_spread, 1.0, 16.0, "%.1f x further");
  changed |= slide("not outline", detail.silhouette, 1.0, 16.0, "%.1f x further");
  changed |= slide("haze", detail.visibility, 0.0, 4.0, "counts %.1f x");
  ImGui::TreePop();
  return changed;
}

// How the sea is cut into triangles.
bool draw_mesh(scene::Detail& detail) {
  using enum scene::Triangulation;
  constexpr auto kMeshes = enum_table<scene::Triangulation, const char*>(
      {{kRoam, "ROAM"}, {kRadial, "radial grid"}, {kPlane, "plane"}});
  constexpr auto kPriorities =
      enum_table<bool, const char*>({{false, "size over distance"}, {true, "nearest"}});
  bool changed = choose("mesh", detail.triangulation, kMeshes);
  if (detail.triangulation != kRoam) return changed;
  changed |= choose("priority", detail.inverse_distance_priority, kPriorities);
  return draw_priorities(detail) || changed;
}

}  // namespace

bool draw_sea(const scene::Scene& scene, const EnumTable<WaveModel, const char*>& wave_names,
              SceneChoice& choice) {
  bool changed = draw_sea_state(choice.waves.sea_state);
  changed |= choose("waves", choice.waves.model, wave_names);
  changed |= draw_wind(scene, choice.waves);
  return draw_mesh(choice.detail) || changed;
}

bool draw_light_and_air(const scene::Scene& scene, SceneChoice& choice) {
  bool changed = draw_sun(choice.air);
  changed |= draw_clouds(!scene.clouds.cumulus.empty(), choice.air);
  return draw_fog(choice.air) || changed;
}

bool draw_land(const scene::Scene& scene, SceneChoice& choice) {
  if (!scene.terrain) {
    ImGui::TextDisabled("the scene has none");
    return false;
  }
  using enum scene::CoastModel;
  constexpr auto kCoasts =
      enum_table<scene::CoastModel, const char*>({{kNone, "waves of the open sea"},
                                                  {kTrains, "wave trains"},
                                                  {kBlend, "both, blended"},
                                                  {kFronts, "fronts of surf"}});
  constexpr auto kMethods = enum_table<scene::TerrainMethod, const char*>(
      {{scene::TerrainMethod::kRoam, "triangles"}, {scene::TerrainMethod::kRays, "rays"}});
  const bool changed = choose("coast", choice.coast, kCoasts);
  return choose("drawn by", choice.detail.terrain_method, kMethods) || changed;
}

}  // namespace swell::view
