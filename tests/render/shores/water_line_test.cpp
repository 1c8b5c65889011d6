// The line where land rises out of drawn water, against what queries say of the water there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ocean/water_surface.h"
#include "render/labelled_frame.h"
#include "scene/water.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

// Error in height of a calm sea's mesh and of the land's, 30,000 triangles each, and of a line that
// is known to a pixel: a few times what is found.
constexpr double kMostOff_px = 0.5, kUsuallyOff_px = 0.2;

const scene::Water& lagoon_water() {
  static const scene::Water water(load_shipped("lagoon"), 2);
  return water;
}

// The lagoon's water as pictures show it, and as queries do.
struct DrawnAndAsked : LabelledFrame {
  DrawnAndAsked(const View& seen, double at_s)
      : LabelledFrame(shipped_world("lagoon"), seen, at_s, flat_world()),
        surface(water.at(at_s, sea, workers)) {}

  static FrameOptions flat_world() {
    FrameOptions asked = {.without = {Part::kEarth}};
    asked.labels.add(Label::kDepth);
    asked.labels.add(Label::kId);
    return asked;
  }

  bool shows(glm::ivec2 p, std::uint32_t id) const { return labels().id[at(p)] == id; }
  double ground_m(glm::dvec2 p) const { return terrain::height_at(*water.terrain(), p); }

  // Pairs of neighbours, water and land, that are about equally far.
  std::vector<std::array<glm::ivec2, 2>> line() const {
    std::vector<std::array<glm::ivec2, 2>> pairs;
    const auto& depth = labels().depth_m;
    for (int y = 0; y + 1 < view.height_px; ++y)
      for (int x = 0; x + 1 < view.width_px; ++x)
        for (const glm::ivec2& step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
          const glm::ivec2 p(x, y), q = p + step;
          const float a = depth[at(p)], b = depth[at(q)];
          if (!(std::abs(a - b) < 0.02f * a)) continue;
          if (shows(p, kWaterId) && shows(q, kLandId)) pairs.push_back({p, q});
          if (shows(p, kLandId) && shows(q, kWaterId)) pairs.push_back({q, p});
        }
    return pairs;
  }

  const scene::Water& water = lagoon_water();
  ocean::SeaFrame sea;
  scene::WaterSurface surface;
};

View over_the_shore(glm::dvec2 from, double heading_deg, double height_m) {
  const double degree = kPi / 180.0;
  return make_view({from, height_m}, camera_axes(heading_deg * degree, -25.0 * degree, 0.0),
                   lens_of_fov(60.0 * degree, 480, 270), 0.25f, 480, 270);
}

// Shore: the water line drawn against queries at 1,000 points.
TEST(WaterLine, IsWhereQueriesSayWithinTheMeshError) {
  std::vector<double> off_px;
  for (const double heading_deg : {0.0, 180.0}) {
    const double turn = heading_deg * kPi / 180.0;
    const glm::dvec2 from = -260.0 * glm::dvec2(std::sin(turn), std::cos(turn));
    const DrawnAndAsked at(over_the_shore(from, heading_deg, 25.0), 4.0 + turn);
    const double pixel = 2.0 * static_cast<double>(at.view.tan_half_y) / at.view.height_px;
    for (const auto& [wet, dry] : at.line()) {
      const glm::dvec3 p = 0.5 * (at.position(wet) + at.position(dry));
      const double off_m =
          static_cast<double>(at.surface.height(glm::dvec2(p))) - at.ground_m(glm::dvec2(p));
      off_px.push_back(std::abs(off_m) / (glm::distance(p, at.view.eye_world) * pixel));
    }
  }
  ASSERT_GE(off_px.size(), 1000u);
  std::ranges::sort(off_px);
  EXPECT_LT(off_px[off_px.size() * 95 / 100], kUsuallyOff_px);
  EXPECT_LT(off_px.back(), kMostOff_px);
}

// A pixel inside drawn water is of a place that is wet when asked, but for what triangles cut off.
TEST(WaterLine, WhatIsDrawnWetIsWetWhenAsked) {
  const DrawnAndAsked at(over_the_shore({0.0, -260.0}, 0.0, 25.0), 4.0);
  const double pixel = 2.0 * static_cast<double>(at.view.tan_half_y) / at.view.height_px;
  int inside = 0, shallow = 0;
  at.for_pixels(4, [&](glm::ivec2 p) {
    if (!at.shows(p, kWaterId)) return;
    const glm::dvec3 place = at.position(p);
    const glm::dvec2 flat(place);
    if (std::abs(flat.x) > 400.0 || std::abs(flat.y) > 400.0) return;
    ++inside;
    if (at.water.wets(at.surface, flat)) return;
    ++shallow;
    const double dry_m = at.ground_m(flat) - static_cast<double>(at.surface.height(flat));
    EXPECT_LT(dry_m, kMostOff_px * pixel * glm::distance(place, at.view.eye_world))
        << p.x << " " << p.y;
  });
  EXPECT_GT(inside, 4000);
  EXPECT_LT(shallow, inside / 1000);
}

}  // namespace
}  // namespace swell::render
