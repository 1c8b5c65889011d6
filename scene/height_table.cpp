#include "scene/height_table.h"

#include <algorithm>
#include <cmath>

#include "scene/height_frames.h"

namespace swell::scene {

FramesAt frames_at(const HeightTable& table, double t_s) {
  const std::vector<terrain::HeightPyramid>& frames = table.heights->frames;
  const auto count = static_cast<double>(frames.size());
  if (table.loop_s <= 0.0 || frames.size() == 1) return {&frames[0], &frames[0], 0.0};
  double at = t_s / table.loop_s * count;
  // Products with times that decimals give are off whole numbers by their rounding.
  const double whole = std::round(at);
  if (std::abs(at - whole) < 1e-9 * std::max(std::abs(at), 1.0)) at = whole;
  at -= count * std::floor(at / count);
  const double first = std::floor(at);
  const auto now = static_cast<std::size_t>(first) % frames.size();
  return {&frames[now], &frames[(now + 1) % frames.size()], at - first};
}

double value(const HeightTable& table, glm::dvec3 p) {
  const glm::dvec3 at = table(p);
  const double height = terrain::height_at(table.heights->frames[0], glm::dvec2(at));
  return std::min(height - at.z, height - table.threshold_m);
}

double most_of(const HeightTable& table, glm::dvec3 middle,
               const std::array<glm::dvec3, 3>& spans) {
  const glm::dvec3 at = table(middle);
  glm::dvec3 reach = 1e-6 * glm::abs(at) + 1e-6;
  for (const glm::dvec3& span : spans) reach += glm::abs(table.linear * span);
  double highest = -std::numeric_limits<double>::infinity();
  for (const terrain::HeightPyramid& frame : table.heights->frames)
    highest = std::max(highest, static_cast<double>(terrain::highest_over(
                                    frame, glm::dvec2(at - reach), glm::dvec2(at + reach))));
  highest += 1e-6 * (std::abs(highest) + 1.0);  // rounded to floats
  return std::min(highest - (at.z - reach.z), highest - table.threshold_m);
}

}  // namespace swell::scene
