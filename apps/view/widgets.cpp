#include "apps/view/widgets.h"

#include <fmt/core.h>
#include <imgui.h>

#include "scene/camera.h"

namespace swell::view {
namespace {

bool slide_with(const char* label, double& value, double low, double high, const char* format,
                ImGuiSliderFlags flags) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                             flags | ImGuiSliderFlags_AlwaysClamp);
}

}  // namespace

void text(const std::string& line) { ImGui::TextUnformatted(line.c_str()); }

void row(std::string_view name, const std::string& value) {
  text(fmt::format("{:<14}{:>16}", name, value));
}

bool slide(const char* label, double& value, double low, double high, const char* format) {
  return slide_with(label, value, low, high, format, ImGuiSliderFlags_None);
}

bool slide_by_decades(const char* label, double& value, double low, double high,
                      const char* format) {
  return slide_with(label, value, low, high, format, ImGuiSliderFlags_Logarithmic);
}

bool slide_angle(const char* label, double& radians, double low_deg, double high_deg) {
  double degrees = radians / kRadPerDeg;
  if (!slide(label, degrees, low_deg, high_deg, "%.0f deg")) return false;
  radians = degrees * kRadPerDeg;
  return true;
}

bool choose_number(const char* label, int& chosen, std::span<const char* const> names) {
  return ImGui::Combo(label, &chosen, names.data(), static_cast<int>(names.size()));
}

}  // namespace swell::view
