#include "apps/view/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "apps/view/keys.h"
#include "math/elementary.h"

namespace swell::view {
namespace {

constexpr float kPanelWidth_px = 330.0f;
constexpr float kGraphHeight_px = 80.0f;
constexpr float kGraphTop_ms = 40.0f;
constexpr double kRadPerDeg = kPi / 180.0;

void text(const std::string& line) { ImGui::TextUnformatted(line.c_str()); }

// A row of two columns: a name, a number to the right of it.
void row(std::string_view name, const std::string& value) {
  text(fmt::format("{:<14}{:>12}", name, value));
}

// A slider over a value kept in double, shown with one decimal.
bool slide(const char* label, double& value, double low, double high, const char* format) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                             ImGuiSliderFlags_AlwaysClamp);
}

bool draw_waves(WaveChoice& waves) {
  bool changed = false;
  int model = static_cast<int>(waves.model);
  if (ImGui::Combo("waves", &model, "spectrum\0sines\0both\0")) {
    waves.model = static_cast<WaveModel>(model);
    changed = true;
  }
  changed |= slide("wind speed", waves.wind_speed_mps, 0.0, 40.0, "%.1f m/s");
  double from_deg = waves.wind_from_rad / kRadPerDeg;
  if (slide("wind from", from_deg, 0.0, 360.0, "%.0f deg")) {
    waves.wind_from_rad = from_deg * kRadPerDeg;
    changed = true;
  }
  return changed;
}

void draw_quality(render::FrameOptions& frame) {
  ImGui::SliderInt("triangles", &frame.water_triangles, 200, 200000, "%d",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  slide("lookup size", frame.lookup_scale, 0.1, 1.0, "%.2f");
  ImGui::Checkbox("wireframe", &frame.wireframe);
}

// Frame times from left (old) to right (new), with the budget as a line across.
void draw_graph(const FrameHistory& history) {
  const ImVec2 size(ImGui::GetContentRegionAvail().x, kGraphHeight_px);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool is_full = history.count == FrameHistory::kLength;
  ImGui::PlotHistogram("##frame times", history.frame_ms.data(), static_cast<int>(history.count),
                       is_full ? static_cast<int>(history.next) : 0, nullptr, 0.0f, kGraphTop_ms,
                       size);
  const float budget_ms = static_cast<float>(kBudget_ms);
  const float y = std::floor(corner.y + size.y * (1.0f - budget_ms / kGraphTop_ms));
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImU32 red = IM_COL32(255, 80, 60, 255);
  list->AddRectFilled({corner.x, y}, {corner.x + size.x, y + 1.0f}, red);
  list->AddText({corner.x + 4.0f, y - 14.0f}, red, "17 ms");
}

void draw_times(const PanelReport& report) {
  const render::FrameStatistics& s = report.statistics;
  text(fmt::format("frame {:5.1f} ms   median {:5.1f}   p95 {:5.1f}", s.frame_ms,
                   percentile_ms(report.history, 0.5), percentile_ms(report.history, 0.95)));
  draw_graph(report.history);
  text(fmt::format("{:.0f} % of frames over 17 ms", 100.0 * share_over_budget(report.history)));
  for (std::size_t i = 0; i < s.stage_ms.size(); ++i)
    row(render::stage_name(static_cast<render::Stage>(i)), fmt::format("{:.2f} ms", s.stage_ms[i]));
  row("present", fmt::format("{:.2f} ms", report.present_ms));
}

void draw_counts(const PanelReport& report) {
  const render::FrameStatistics& s = report.statistics;
  row("water", fmt::format("{} tris", s.water_triangles));
  row("terrain", fmt::format("{} tris", s.terrain_triangles));
  row("splits/merges", fmt::format("{} / {}", s.splits, s.merges));
  row("shaded", fmt::format("{} px", s.shaded_pixels));
  row("size", fmt::format("{}x{}", report.width_px, report.height_px));
  row("threads", fmt::format("{} {}", report.threads, report.simd));
}

}  // namespace

bool draw_panel(const PanelReport& report, PanelSettings& settings) {
  bool waves_changed = false;
  ImGui::SetNextWindowPos({10.0f, 10.0f}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({kPanelWidth_px, 0.0f});
  if (ImGui::Begin("swell", nullptr, ImGuiWindowFlags_NoResize)) {
    ImGui::PushItemWidth(0.62f * kPanelWidth_px);
    text(fmt::format("{}   t = {:.2f} s", report.scene_name, report.t_s));
    ImGui::Checkbox("pause", &settings.paused);
    ImGui::SameLine();
    ImGui::TextDisabled(report.rebuilding ? "making waves ..." : "F1: keys");
    ImGui::Separator();
    waves_changed = draw_waves(settings.waves);
    draw_quality(settings.frame);
    ImGui::Separator();
    draw_times(report);
    ImGui::Separator();
    draw_counts(report);
    if (!report.message.empty()) ImGui::TextWrapped("%s", report.message.c_str());
    ImGui::PopItemWidth();
  }
  ImGui::End();
  return waves_changed;
}

void draw_help() {
  const ImVec2 centre = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(centre, ImGuiCond_Always, {0.5f, 0.5f});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoInputs;
  if (ImGui::Begin("keys", nullptr, kFlags))
    for (const KeyHelp& key : key_help()) text(fmt::format("{:<18}  {}", key.keys, key.what));
  ImGui::End();
}

}  // namespace swell::view
