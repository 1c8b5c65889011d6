#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "apps/shared/xml_text.h"
#include "tools/figures/wave_figures.h"

namespace swell::apps {
namespace {

constexpr int kWidth_px = 960, kHeight_px = 300;
constexpr double kLeft_px = 48, kRight_px = 948, kTop_px = 34, kBottom_px = 262;
constexpr int kSamples = 901;  // one a pixel

struct Profile {
  double length_m = 0.0;
  std::vector<float> surface_m, ground_m;  // no ground: the sea is deep
};

Profile sample_profile(const scene::WaterSurface& surface, const terrain::HeightGrid* terrain,
                       glm::dvec2 from_m, glm::dvec2 to_m) {
  Profile profile{glm::distance(from_m, to_m), std::vector<float>(kSamples), {}};
  std::vector<glm::dvec2> p_world;
  for (int i = 0; i < kSamples; ++i)
    p_world.push_back(glm::mix(from_m, to_m, i / (kSamples - 1.0)));
  surface.heights(p_world, profile.surface_m);
  if (!terrain) return profile;
  profile.ground_m.resize(kSamples);
  terrain::sample_heights(*terrain, p_world, profile.ground_m);
  return profile;
}

// From metres along the line and of height to pixels.
struct Axes {
  double length_m, low_m, high_m;
  double x_px(double s_m) const { return kLeft_px + (kRight_px - kLeft_px) * s_m / length_m; }
  double y_px(double z_m) const {
    return kBottom_px - (kBottom_px - kTop_px) * (z_m - low_m) / (high_m - low_m);
  }
  double exaggeration() const {
    return (kBottom_px - kTop_px) / (high_m - low_m) / ((kRight_px - kLeft_px) / length_m);
  }
};

Axes make_axes(const Profile& profile) {
  const auto [lowest, highest] = std::ranges::minmax_element(profile.surface_m);
  double low = *lowest, high = *highest;
  if (!profile.ground_m.empty()) {
    const auto [floor, land] = std::ranges::minmax_element(profile.ground_m);
    low = std::min<double>(low, *floor);
    high = std::max<double>(high, std::min<double>(*land, high + 2.0));
  }
  const double margin = std::max(0.08 * (high - low), 0.05);
  return {profile.length_m, low - margin, high + margin};
}

// The least of 1, 2, 5 x 10^n that cuts `range` into at most `parts`.
double tick_step(double range, int parts) {
  double power = 1e-3;
  while (10.0 * power * parts < range) power *= 10.0;
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power * parts >= range) return digit * power;
  return 10.0 * power;
}

std::string line_points(const Axes& axes, const std::vector<float>& z_m) {
  std::string points;
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    const double z = std::clamp<double>(z_m[i], axes.low_m, axes.high_m);
    points += fmt::format("{:.1f},{:.1f} ", axes.x_px(axes.length_m * double(i) / (kSamples - 1.0)),
                          axes.y_px(z));
  }
  return points;
}

// The area between a line and the picture's lower edge.
std::string area(const Axes& axes, const std::vector<float>& z_m, const char* colour) {
  return fmt::format("<polygon fill=\"{}\" points=\"{:.1f},{:.1f} {}{:.1f},{:.1f}\"/>\n", colour,
                     kLeft_px, kBottom_px, line_points(axes, z_m), kRight_px, kBottom_px);
}

std::string tick_lines(const Axes& axes) {
  std::string svg;
  const double step_x = tick_step(axes.length_m, 12);
  for (int i = 0; i * step_x <= axes.length_m; ++i)
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{:g}</text>\n",
                       axes.x_px(i * step_x), kBottom_px + 16, i * step_x);
  const double step_z = tick_step(axes.high_m - axes.low_m, 8);
  for (double n = std::ceil(axes.low_m / step_z); n * step_z <= axes.high_m; ++n) {
    const double y = axes.y_px(n * step_z);
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n",
                       kLeft_px - 6, y + 4, n * step_z + 0.0);
    svg += fmt::format(
        "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#000\" "
        "stroke-opacity=\"{3}\"/>\n",
        kLeft_px, kRight_px, y, n == 0.0 ? 0.5 : 0.12);
  }
  return svg;
}

}  // namespace

std::string draw_section(const scene::WaterSurface& surface, const terrain::HeightGrid* terrain,
                         glm::dvec2 from_m, glm::dvec2 to_m, const std::string& title) {
  const Profile profile = sample_profile(surface, terrain, from_m, to_m);
  const Axes axes = make_axes(profile);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      kWidth_px, kHeight_px);
  svg += fmt::format(
      "<text x=\"{}\" y=\"20\">{}: from ({:g}, {:g}) to ({:g}, {:g}) m, heights x {:.1f}</text>\n",
      kLeft_px, xml_text(title), from_m.x, from_m.y, to_m.x, to_m.y, axes.exaggeration());
  svg += area(axes, profile.surface_m, "#6fb3d2");
  svg += fmt::format(
      "<polyline fill=\"none\" stroke=\"#0b3c5d\" stroke-width=\"1.2\" points=\"{}\"/>\n",
      line_points(axes, profile.surface_m));
  if (terrain) svg += area(axes, profile.ground_m, "#d9c79a");
  svg += tick_lines(axes);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">distance, m</text>\n", kRight_px,
                     kHeight_px - 6);
  return svg + "</svg>\n";
}

}  // namespace swell::apps
