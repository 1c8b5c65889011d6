#include "apps/papers/svg_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace swell::apps {
namespace {

constexpr double kWidth_px = 480.0, kHeight_px = 300.0, kMargin_px = 40.0;
constexpr std::array<const char*, 6> kColours = {"#1d3d5c", "#c4562a", "#3f7d3f",
                                                 "#7a4fa3", "#a37b1f", "#5c1d3d"};

std::string sheet(double width_px, double height_px, const std::string& body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      "<g font-family=\"sans-serif\" font-size=\"12\" fill=\"none\">\n{2}</g>\n</svg>\n",
      width_px, height_px, body);
}

std::string words_at(glm::dvec2 at_px, const std::string& text, const char* colour = "black") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n", at_px.x, at_px.y,
                     colour, text);
}

}  // namespace

std::string plot_svg(const std::string& x_label, const std::string& y_label,
                     std::span<const Curve> curves) {
  glm::dvec2 low(1e300), high(-1e300);
  for (const Curve& curve : curves)
    for (const glm::dvec2& p : curve.points) low = glm::min(low, p), high = glm::max(high, p);
  const glm::dvec2 span = glm::max(high - low, glm::dvec2(1e-12));
  const auto place = [&](glm::dvec2 p) {
    const glm::dvec2 part = (p - low) / span;
    return glm::dvec2(kMargin_px + part.x * (kWidth_px - 2.0 * kMargin_px),
                      kHeight_px - kMargin_px - part.y * (kHeight_px - 2.0 * kMargin_px));
  };
  const glm::dvec2 origin = place(low), end = place(high);
  std::string body =
      fmt::format("<path d=\"M{0:.1f},{3:.1f} V{1:.1f} H{2:.1f}\" stroke=\"#888\"/>\n", origin.x,
                  origin.y, end.x, end.y);
  body += words_at({origin.x, origin.y + 16.0}, fmt::format("{:.3g}", low.x));
  body += words_at({end.x - 20.0, origin.y + 16.0}, fmt::format("{:.3g}", high.x));
  body += words_at({0.45 * kWidth_px, origin.y + 30.0}, x_label);
  body += words_at({4.0, origin.y}, fmt::format("{:.2g}", low.y));
  body += words_at({4.0, end.y + 4.0}, fmt::format("{:.2g}", high.y));
  body += words_at({4.0, 16.0}, y_label);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const char* const colour = kColours[i % kColours.size()];
    body += "<polyline points=\"";
    for (const glm::dvec2& p : curves[i].points) {
      const glm::dvec2 at = place(p);
      body += fmt::format("{:.1f},{:.1f} ", at.x, at.y);
    }
    body += fmt::format("\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n", colour,
                        curves[i].dashed ? " stroke-dasharray=\"5 4\"" : "");
    body += words_at({kWidth_px - 170.0, 30.0 + 15.0 * static_cast<double>(i)}, curves[i].label,
                     colour);
  }
  return sheet(kWidth_px, kHeight_px, body);
}

std::string sketch_svg(const Sketch& sketch) {
  constexpr double kScale = 5.0, kHigh = 60.0;
  const auto place = [](glm::dvec2 p) { return kScale * glm::dvec2(p.x, kHigh - p.y); };
  std::string body;
  for (const Sketch::Line& line : sketch.lines) {
    const glm::dvec2 a = place(line.from), b = place(line.to);
    body += fmt::format("<path d=\"M{:.1f},{:.1f} L{:.1f},{:.1f}\" stroke=\"#1d3d5c\"{}/>\n", a.x,
                        a.y, b.x, b.y, line.dashed ? " stroke-dasharray=\"5 4\"" : "");
  }
  for (const Sketch::Words& words : sketch.words) body += words_at(place(words.at), words.text);
  return sheet(100.0 * kScale, kHigh * kScale, body);
}

}  // namespace swell::apps
