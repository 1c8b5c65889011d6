#include "apps/papers/shore_layers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/papers/svg_plot.h"
#include "math/check.h"
#include "math/elementary.h"
#include "math/smoothstep.h"
#include "ocean/coast/surf_fronts.h"
#include "ocean/coast/swash.h"
#include "render/sea/caustic_maps.h"

namespace swell::apps {
namespace {

using Rgb = glm::dvec3;  // sRGB bytes

constexpr Rgb kBank{150, 168, 92}, kSand{226, 210, 160}, kWetSand{168, 140, 96};
constexpr Rgb kSurf{150, 200, 205}, kFloor{70, 150, 170}, kLitFloor{150, 225, 225},
    kDeep{24, 66, 110};
constexpr std::array<Rgb, ocean::kSurfFronts> kFronts = {
    {{196, 40, 32}, {240, 190, 40}, {40, 130, 50}, {110, 50, 150}}};

// Turns since front n was at a place, in [0, 1): as ocean/coast/surf_fronts.h has them.
double past_of_front(const ocean::FrontClock& clock, glm::dvec2 p, double part, int n) {
  const auto along = [&](glm::vec3 lag) {
    return sin_cos_turns(glm::dot(glm::dvec3(lag), glm::dvec3(p, 1.0)));
  };
  const SinCos a = along(clock.lag_a), b = along(clock.lag_b);
  const std::array<double, ocean::kSurfFronts> lag = {a.sin, b.sin, a.cos, b.cos};
  const double turns = static_cast<double>(clock.cycles) +
                       static_cast<double>(clock.reach_turns) * std::sqrt(part) + 0.25 * n +
                       0.06 * lag[static_cast<std::size_t>(n)];
  return turns - std::floor(turns);
}

// On land: sand that sheets of the swash reach, and banks with the light from the north-west.
Rgb land_colour(const terrain::HeightGrid& land, glm::dvec2 p, double height_m, double swash_m) {
  if (height_m < swash_m) return kWetSand;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-terrain::slope_at(land, p), 1.0));
  const double lit = glm::dot(normal, glm::normalize(glm::dvec3(-1.0, 1.0, 2.0)));
  return std::clamp(lit / 0.8165, 0.4, 1.25) *
         glm::mix(kSand, kBank, smoothstep(0.6, 3.0, height_m));
}

Rgb sea_colour(const scene::Water& water, const ocean::FrontClock& clock, glm::dvec2 p,
               double depth_m) {
  const ocean::SurfFronts& fronts = *water.fronts();
  const double part = std::max(0.0, static_cast<double>(ocean::place_in_fronts(fronts, p).at.part));
  const glm::dvec2 from_corner = p - fronts.grid.min_world;
  if (part < 1.0)
    for (int n = 0; n < ocean::kSurfFronts; ++n)
      if (past_of_front(clock, from_corner, part, n) < 0.03)
        return kFronts[static_cast<std::size_t>(n)];
  if (part < 1.0) return kSurf;
  constexpr double kDeepest_m = render::CausticMaps::kDeepest_m;
  if (depth_m > kDeepest_m) return kDeep;
  return glm::mix(kLitFloor, kFloor, depth_m / kDeepest_m);
}

}  // namespace

texture::Image8 draw_shore_layers(const scene::Water& water, double t_s, const MapView& view) {
  SWELL_CHECK(water.fronts() && water.terrain(), "a shore without fronts");
  const ocean::Swash swash = ocean::make_swash(water.sea(), water.coast(), water.shelter());
  const ocean::FrontClock clock = ocean::make_front_clock(
      water.fronts()->zone, water.sea().description(), t_s, water.fronts()->grid.min_world);
  texture::Image8 image{view.size_px, view.size_px, 3, {}};
  const double pixel_m = view.side_m / view.size_px, middle = 0.5 * view.size_px;
  for (int y = 0; y < view.size_px; ++y)
    for (int x = 0; x < view.size_px; ++x) {
      const glm::dvec2 p = view.centre_m + pixel_m * glm::dvec2(x + 0.5 - middle, middle - y - 0.5);
      const double height_m = terrain::height_at(*water.terrain(), p);
      const Rgb colour = height_m > 0.0 ? land_colour(*water.terrain(), p, height_m, swash.reach_m)
                                        : sea_colour(water, clock, p, -height_m);
      for (int c = 0; c < 3; ++c)
        image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(colour[c], 0.0, 255.0)));
    }
  return image;
}

std::string plot_front_function() {
  std::array<Curve, 3> curves;
  constexpr std::array<float, 3> kParts = {1.8f, 1.0f, 0.3f};
  constexpr std::array<const char*, 3> kWords = {"where it is raised", "where it breaks",
                                                 "near the shore"};
  for (std::size_t n = 0; n < curves.size(); ++n) {
    curves[n].label = kWords[n];
    ocean::FrontSamples samples;
    samples.count = 1;
    samples.part[0] = kParts[n];
    // The shore is on the right: what comes there first has the front ahead.
    for (double turns = 0.19; turns > -0.12; turns -= 0.002) {
      // Where the front is as high as it gets, and the one behind it is not there.
      ocean::FrontClock clock;
      clock.lag_a.z = clock.lag_b.z = 0.25f;
      clock.cycles = static_cast<float>(turns - 0.06);
      ocean::sample_front_function(clock, samples);
      curves[n].points.emplace_back(-4.0 * turns, samples.lift[0]);
    }
  }
  return plot_svg("towards the shore [wave periods]", "height of a front", curves);
}

}  // namespace swell::apps
