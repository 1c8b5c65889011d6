#include "apps/view/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "apps/view/keys.h"
#include "apps/view/scene_controls.h"
#include "apps/view/widgets.h"
#include "scene/camera.h"

namespace swell::view {
namespace {

constexpr float kPanelWidth_px = 330.0f;
constexpr float kGraphHeight_px = 56.0f;

// Where the camera is. True if it is to be copied.
bool draw_camera(const CameraPose& pose, double fov_y_rad) {
  constexpr const char* kCopy = "copy as TOML";
  const float right_px = ImGui::GetContentRegionMax().x;
  text(fmt::format("x {:.1f} y {:.1f} z {:.1f} m", pose.eye_m.x, pose.eye_m.y, pose.eye_m.z));
  ImGui::SameLine(right_px - ImGui::CalcTextSize(kCopy).x - 8.0f);
  const bool copy = ImGui::SmallButton(kCopy);
  text(fmt::format("heading {:.1f}  pitch {:.1f}  fov {:.1f} deg", pose.heading_rad / kRadPerDeg,
                   pose.pitch_rad / kRadPerDeg, fov_y_rad / kRadPerDeg));
  if (pose.roll_rad != 0.0) text(fmt::format("roll {:.1f}", pose.roll_rad / kRadPerDeg));
  return copy;
}

// Which label is shown, or colour.
void draw_label_choice(std::optional<render::Label>& label) {
  std::array<const char*, render::kLabelCount + 1> names = {"colour"};
  for (const render::LabelInfo& info : render::label_table())
    names[1 + static_cast<std::size_t>(info.label)] = info.name.data();
  int choice = label ? 1 + static_cast<int>(*label) : 0;
  if (!ImGui::Combo("picture (F4)", &choice, names.data(), static_cast<int>(names.size()))) return;
  label.reset();
  if (choice > 0) label = static_cast<render::Label>(choice - 1);
}

void draw_triangles(const char* label, int& triangles) {
  ImGui::SliderInt(label, &triangles, 200, 200000, "%d",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
}

// What of the picture is drawn: to see what each part costs.
void draw_parts(render::PartSet& without) {
  if (!ImGui::TreeNode("parts of the picture")) return;
  render::PartSet next;
  for (std::size_t i = 0; i < render::kPartCount; ++i) {
    const auto part = static_cast<render::Part>(i);
    bool is_drawn = !without.has(part);
    if (i % 2 == 1) ImGui::SameLine(0.5f * kPanelWidth_px);
    ImGui::Checkbox(render::part_name(part).data(), &is_drawn);
    if (!is_drawn) next.add(part);
  }
  without = next;
  ImGui::TreePop();
}

void draw_quality(render::FrameOptions& frame) {
  slide("refining", frame.lod_ms, 0.0, 10.0,
        frame.lod_ms > 0.0 ? "at most %.1f ms" : "takes its time");
  slide("far waves", frame.background_error_px, 0.0, 8.0, "may be %.1f px off");
  slide("lookup size", frame.lookup_scale, 0.1, 1.0, "%.2f");
  ImGui::Checkbox("wireframe", &frame.wireframe);
}

void draw_governor(const PanelReport& report, PanelSettings& settings) {
  ImGui::Checkbox("keep to the budget", &settings.governed);
  if (!settings.governed) return;
  slide("budget", settings.budget_ms, 5.0, 100.0, "%.0f ms");
  const render::GovernorReport& g = report.governor;
  text(quality_line(g, report.picture_scale, settings.budget_ms));
  text(fmt::format("aims at {:.1f} ms, expects {:.1f} ms", g.aim_ms, g.predicted_ms));
}

// The graph's top: twice the budget, doubled until nearly all frames fit.
float graph_top_ms(const FrameHistory& history, double budget_ms) {
  double top_ms = 2.0 * budget_ms;
  while (top_ms < percentile_ms(history, 0.95) && top_ms < 1e4) top_ms *= 2.0;
  return static_cast<float>(top_ms);
}

// One bar a frame, the newest at the right edge; bars over the budget in another colour.
void draw_bars(const FrameHistory& history, double budget_ms, ImVec2 corner, ImVec2 size,
               float top_ms) {
  constexpr auto kSlots = static_cast<float>(FrameHistory::kLength);
  ImDrawList* list = ImGui::GetWindowDrawList();
  for (std::size_t age = 1; age <= history.count; ++age) {
    const std::size_t i = (history.next + FrameHistory::kLength - age) % FrameHistory::kLength;
    const float ms = history.frame_ms[i];
    const float slot = kSlots - static_cast<float>(age);
    const float x0 = std::floor(corner.x + size.x * slot / kSlots);
    const float x1 = std::floor(corner.x + size.x * (slot + 1.0f) / kSlots);
    const float height = std::floor(size.y * std::clamp(ms / top_ms, 0.0f, 1.0f));
    const bool is_over = static_cast<double>(ms) > budget_ms;
    list->AddRectFilled({x0, corner.y + size.y - height}, {x1, corner.y + size.y},
                        is_over ? IM_COL32(190, 130, 40, 255) : IM_COL32(70, 150, 90, 255));
  }
}

// Frame times with the budget as a labelled line across.
void draw_graph(const FrameHistory& history, double budget_ms) {
  const ImVec2 size(ImGui::GetContentRegionAvail().x, kGraphHeight_px);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float top_ms = graph_top_ms(history, budget_ms);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(15, 25, 35, 255));
  draw_bars(history, budget_ms, corner, size, top_ms);

  const float share = static_cast<float>(budget_ms) / top_ms;
  const float y = std::floor(corner.y + size.y * (1.0f - share));
  list->AddRectFilled({corner.x, y}, {corner.x + size.x, y + 1.0f}, IM_COL32(255, 90, 70, 255));
  list->AddRectFilled({corner.x, y - 15.0f}, {corner.x + 44.0f, y}, IM_COL32(15, 25, 35, 255));
  list->AddText({corner.x + 4.0f, y - 14.0f}, IM_COL32(255, 140, 120, 255),
                fmt::format("{:.0f} ms", budget_ms).c_str());
  ImGui::Dummy(size);
}

// The time of each stage: clouds, rays to forms and land, and trees are stages of their own.
void draw_times(const PanelReport& report, double budget_ms) {
  const render::FrameStatistics& s = report.statistics;
  text(fmt::format("frame {:5.1f} ms   median {:5.1f}   p95 {:5.1f}", report.frame_ms,
                   percentile_ms(report.history, 0.5), percentile_ms(report.history, 0.95)));
  draw_graph(report.history, budget_ms);
  text(fmt::format("{:.0f} % of frames over {:.0f} ms",
                   100.0 * share_over_budget(report.history, budget_ms), budget_ms));
  for (std::size_t i = 0; i < s.stage_ms.size(); ++i)
    row(render::stage_name(static_cast<render::Stage>(i)), fmt::format("{:.2f} ms", s.stage_ms[i]));
  row("present", fmt::format("{:.2f} ms", report.present_ms));
}

void draw_counts(const PanelReport& report) {
  const render::FrameStatistics& s = report.statistics;
  row("water/terrain", fmt::format("{} / {} tris", s.water_triangles, s.terrain_triangles));
  row("splits/merges", fmt::format("{} / {}{}", s.splits, s.merges, s.lod_stopped ? " ..." : ""));
  row("shaded", fmt::format("{} px", s.shaded_pixels));
  text(fmt::format("{}x{} on {} threads, {}", report.width_px, report.height_px, report.threads,
                   report.simd));
}

// An object has the number that errors of its scene file have.
std::string name_of(const render::Pick& pick) {
  if (pick.what == render::Shown::kWater) return "water";
  if (pick.what == render::Shown::kLand) return "land";
  return fmt::format("{}, object[{}],", scene::kObjectKindNames[pick.object_kind], pick.object);
}

std::string heights_of(const render::Pick& pick) {
  if (pick.what == render::Shown::kObject)
    return fmt::format("z {:.2f} m, {:.2f} m above the water", pick.p_world.z,
                       pick.p_world.z - pick.model_height_m);
  return fmt::format("z {:.2f} m, model {:.2f} m", pick.p_world.z, pick.model_height_m);
}

// True if the scene is to be saved.
bool draw_save() {
  constexpr const char* kSave = "save scene";
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(kSave).x - 8.0f);
  return ImGui::SmallButton(kSave);
}

// The sections about the scene. True if one has changed it.
bool draw_scene(const PanelReport& report, const scene::Scene& scene, PanelSettings& settings) {
  bool changed = false;
  if (ImGui::CollapsingHeader("sea", ImGuiTreeNodeFlags_DefaultOpen)) {
    changed |= draw_sea(scene, report.wave_names, settings.scene);
    draw_triangles("triangles", settings.frame.water_triangles);
  }
  if (ImGui::CollapsingHeader("light and air", ImGuiTreeNodeFlags_DefaultOpen))
    changed |= draw_light_and_air(scene, settings.scene);
  if (ImGui::CollapsingHeader("land")) {
    changed |= draw_land(scene, settings.scene);
    draw_triangles("triangles on land", settings.frame.terrain_triangles);
  }
  return changed;
}

void draw_cost(const PanelReport& report, PanelSettings& settings) {
  draw_times(report, settings.governed ? settings.budget_ms : kBudget_ms);
  draw_governor(report, settings);
  draw_quality(settings.frame);
  draw_parts(settings.frame.without);
  draw_counts(report);
}

}  // namespace

std::string quality_line(const render::GovernorReport& governor, double picture_scale,
                         double budget_ms) {
  std::vector<std::string> shares;
  if (picture_scale < 0.995)
    shares.push_back(fmt::format("{:.0f} % of the size", 100.0 * picture_scale));
  if (governor.detail < 0.995)
    shares.push_back(fmt::format("{:.0f} % of the triangles", 100.0 * governor.detail));
  if (shares.empty() && governor.step > 0) shares.emplace_back("smaller lookup images");
  if (shares.empty()) return "whole: it fits";
  const double over_ms = governor.whole_ms - budget_ms;
  const std::string why =
      over_ms >= 0.5 ? fmt::format("{:.0f} ms over", over_ms) : std::string("near the budget");
  return fmt::format("{}: {}", why, fmt::join(shares, ", "));
}

PanelChanges draw_panel(const PanelReport& report, const scene::Scene& scene,
                        PanelSettings& settings) {
  PanelChanges changes;
  ImGui::SetNextWindowPos({10.0f, 10.0f}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({kPanelWidth_px, 0.0f});
  // A window that is lower than the panel gets a scroll bar.
  const float most_px = std::max(ImGui::GetIO().DisplaySize.y - 20.0f, 100.0f);
  ImGui::SetNextWindowSizeConstraints({kPanelWidth_px, 0.0f}, {kPanelWidth_px, most_px});
  if (ImGui::Begin("swell", nullptr, ImGuiWindowFlags_NoResize)) {
    ImGui::PushItemWidth(0.62f * kPanelWidth_px);
    text(fmt::format("{}   t = {:.2f} s", report.scene_name, report.t_s));
    ImGui::Checkbox("pause", &settings.paused);
    ImGui::SameLine();
    ImGui::TextDisabled(report.rebuilding ? "rebuilding ..." : "F1: keys");
    changes.save_scene = draw_save();
    ImGui::Separator();
    changes.copy_camera = draw_camera(report.camera, report.fov_y_rad);
    ImGui::Separator();
    draw_label_choice(settings.label);
    changes.scene = draw_scene(report, scene, settings);
    if (ImGui::CollapsingHeader("cost", ImGuiTreeNodeFlags_DefaultOpen))
      draw_cost(report, settings);
    text(report.pick ? "pointer: " + heights_of(*report.pick) : "pointer: on no surface");
    ImGui::PopItemWidth();
  }
  ImGui::End();
  return changes;
}

void draw_pick(const render::Pick& pick, glm::vec2 pointer_px) {
  constexpr float kAside_px = 16.0f;
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                      ImGuiWindowFlags_NoFocusOnAppearing;
  // On the side of the pointer that has more room.
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const glm::vec2 pivot(pointer_px.x > 0.5f * window.x, pointer_px.y > 0.5f * window.y);
  const glm::vec2 at = pointer_px + kAside_px * (1.0f - 2.0f * pivot);
  ImGui::SetNextWindowPos({at.x, at.y}, ImGuiCond_Always, {pivot.x, pivot.y});
  if (ImGui::Begin("pointer", nullptr, kFlags)) {
    text(fmt::format("{} {:.1f} m away", name_of(pick), pick.distance_m));
    text(heights_of(pick));
    text(fmt::format("x {:.1f} m, y {:.1f} m", pick.p_world.x, pick.p_world.y));
    if (pick.what != render::Shown::kObject)
      text(fmt::format("slope {:.2f}, level {}", glm::length(pick.slope), pick.level));
  }
  ImGui::End();
}

void draw_message(const std::string& message) {
  constexpr float kFromTop_px = 20.0f, kMargin_px = 8.0f;
  const float window_px = ImGui::GetIO().DisplaySize.x;
  const float wrap_px = std::max(0.8f * window_px, 100.0f);
  const ImVec2 size = ImGui::CalcTextSize(message.c_str(), nullptr, false, wrap_px);
  const ImVec2 at(std::floor(0.5f * (window_px - size.x)), kFromTop_px);
  ImDrawList* list = ImGui::GetForegroundDrawList();
  list->AddRectFilled({at.x - kMargin_px, at.y - kMargin_px},
                      {at.x + size.x + kMargin_px, at.y + size.y + kMargin_px},
                      IM_COL32(15, 25, 35, 220));
  list->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at, IM_COL32_WHITE, message.c_str(),
                nullptr, wrap_px);
}

void draw_help(bool in_browser) {
  const ImVec2 centre = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(centre, ImGuiCond_Always, {0.5f, 0.5f});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoInputs;
  if (ImGui::Begin("keys", nullptr, kFlags))
    for (const KeyHelp& key : key_help(in_browser))
      text(fmt::format("{:<18}  {}", key.keys, key.what));
  ImGui::End();
}

}  // namespace swell::view
