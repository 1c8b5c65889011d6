// Smooth edges against the same frames averaged over 64 places in every pixel (AAX-04).
#include <gtest/gtest.h>

#include <bit>

#include "render/edges/edge_frames.h"
#include "render/edges/edge_scenes.h"
#include "trials.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kAccuracySize_px(160, 100);

using Values = std::vector<double>;  // by pixel

// What colours the surfaces have: those of edges and nothing else, or of the finished picture.
enum class Paint { kByKind, kByDepth, kLit };

double colour_of(const EdgeRenderer& r, Paint paint, std::uint32_t primitive, float z) {
  constexpr std::array<double, 4> kOfKind = {0.0, 0.4, 0.7, 1.0};
  if (paint == Paint::kByKind) return kOfKind[static_cast<std::size_t>(r.kind_of(primitive))];
  return std::sqrt(std::sqrt(static_cast<double>(z)));
}

// A frame whose surfaces are painted so.
Values painted(const EdgeRenderer& r, Paint paint) {
  Values values;
  if (paint == Paint::kLit) {  // its green
    for (const std::uint32_t rgba : r.target.rgba) values.push_back(display_light(rgba, 1));
    return values;
  }
  const std::vector<Centre> centres = r.centres();
  const auto of_pixel = r.fragments();
  for (std::size_t i = 0; i < centres.size(); ++i) {
    double sum = 0.0, samples = 0.0;
    for (const EdgeFragment& f : of_pixel[i]) {
      sum += f.samples * colour_of(r, paint, f.primitive, f.z);
      samples += f.samples;
    }
    values.push_back(samples > 0.0 ? sum / samples
                                   : colour_of(r, paint, centres[i].primitive, centres[i].z));
  }
  return values;
}

// What the 64 places of one pixel show.
struct Places {
  unsigned kinds = 0;  // bit EdgeRenderer::kind_of
  float nearest = 0.0f, farthest = 1.0f;
  double mean = 0.0;

  void add(int kind, float z, double value) {
    kinds |= 1u << kind;
    nearest = std::max(nearest, z);
    farthest = std::min(farthest, z);
    mean += value / 64.0;
  }
};

constexpr unsigned kSky = 1, kWater = 2, kLand = 4, kObject = 8;

// Which pixels count: those whose places show exactly these kinds. Of one kind: those with a place
// half as far again as another, this side of where a level sea goes on so far in one pixel.
struct Edge {
  unsigned kinds;
  Paint paint = Paint::kByKind;

  bool holds(const Places& p, float farthest_crest) const {
    return p.kinds == kinds && (std::popcount(kinds) > 1 ||
                                (p.nearest > 1.5f * p.farthest && p.farthest > farthest_crest));
  }
};

// Sums of squares on the pixels of one kind of edges.
struct Errors {
  double without = 0.0, with_4 = 0.0, with_8 = 0.0;
  int pixels = 0;
  double ratio_4() const { return std::sqrt(with_4 / without); }
  double ratio_8() const { return std::sqrt(with_8 / without); }
};

// By pixel.
std::vector<Places> places_of(EdgeRenderer& r, const View& view, Paint paint) {
  std::vector<Places> places(static_cast<std::size_t>(kAccuracySize_px.x) * kAccuracySize_px.y);
  for (const glm::dvec2& place : rook_places()) {
    r.draw(moved(view, place), 0);
    const Values values = painted(r, paint);
    const std::vector<Centre> centres = r.centres();
    for (std::size_t i = 0; i < values.size(); ++i)
      places[i].add(r.kind_of(centres[i].primitive), centres[i].z, values[i]);
  }
  return places;
}

// Over pictures moved by parts of a pixel: an edge along the rows is as wrong in all of its pixels
// as the place of the rows makes it. `view` looks at a level sea from eye_m above it.
Errors measure(const World& world, const View& view, double t_s, Edge edge, double eye_m = 10.0) {
  constexpr std::array<glm::dvec2, 4> kMoves = {{{0.0, 0.0}, {0.6, 0.5}, {0.3, 0.25}, {0.9, 0.75}}};
  const double rad_per_px = 2.0 * static_cast<double>(view.tan_half_y) / kAccuracySize_px.y;
  const auto farthest_crest =
      static_cast<float>(static_cast<double>(view.near_m) * 5.0 * rad_per_px / eye_m);
  EdgeRenderer renderer(world, t_s);
  Errors errors;
  for (int n = 0; n < std::max(1, trials(4)); ++n) {
    const View middle = moved(view, kMoves[static_cast<std::size_t>(n)]);
    const std::vector<Places> exact = places_of(renderer, middle, edge.paint);
    const auto counts = [&](const Places& p) { return edge.holds(p, farthest_crest); };
    errors.pixels += static_cast<int>(std::ranges::count_if(exact, counts));
    for (const auto& [samples, sum] :
         {std::pair(0, &errors.without), {4, &errors.with_4}, {8, &errors.with_8}}) {
      renderer.draw(moved(middle, {0.0, 0.0}), samples);
      const Values values = painted(renderer, edge.paint);
      for (std::size_t i = 0; i < exact.size(); ++i)
        if (counts(exact[i])) *sum += (values[i] - exact[i].mean) * (values[i] - exact[i].mean);
    }
  }
  return errors;
}

void expect_smooth(const Errors& errors) {
  EXPECT_GT(errors.pixels, 40);
  EXPECT_LE(errors.ratio_4(), 0.45);
  EXPECT_LE(errors.ratio_8(), 0.30);
}

TEST(EdgeAccuracy, OfABoxAgainstTheSkyAndTheSea) {
  scene::Scene scene = plain_scene();
  scene.objects = {white_box({0.0, 30.0}, {6.0, 6.0, 6.0})};
  const World world = world_of(scene);
  const View view = north_view(3.0, 0.23, 0.5, kAccuracySize_px.x, kAccuracySize_px.y);
  for (const unsigned kinds : {kSky | kObject, kWater | kObject, kWater | kSky}) {
    SCOPED_TRACE(kinds);
    expect_smooth(measure(world, view, 0.0, {kinds}));
  }
  expect_smooth(measure(world, view, 0.0, {kSky | kObject, Paint::kLit}));
  // A calm mirrors what is above the horizon, without an edge.
  scene.sea.wind_speed_mps = 8.0;
  expect_smooth(measure(world_of(scene), view, 0.0, {kSky | kWater, Paint::kLit}));
}

TEST(EdgeAccuracy, OfALeaningMast) {
  scene::Scene scene = plain_scene();
  scene.objects = {white_box({0.0, 53.0}, {0.05, 0.05, 12.0})};
  const World world = world_of(scene);
  for (const double fov_rad : {0.1, 0.3}) {  // 0.9 and 0.3 pixels wide
    const View view = north_view(3.0, 0.05, fov_rad, kAccuracySize_px.x, kAccuracySize_px.y);
    for (const Paint paint : {Paint::kByKind, Paint::kLit})
      expect_smooth(measure(world, view, 0.0, {kSky | kObject, paint}));
  }
}

Errors measure_shipped(const char* name, Edge edge) {
  const World& world = shipped_world(name);
  return measure(world, view_of(world, 2.0, kAccuracySize_px.x, kAccuracySize_px.y), 2.0, edge);
}

TEST(EdgeAccuracy, OfAShoreAndOfAnIslandAgainstTheSky) {
  expect_smooth(measure_shipped("lagoon", {kLand | kWater}));
  expect_smooth(measure_shipped("lagoon", {kLand | kSky}));
  // Before a bright even sky: an edge between lights that are alike is no edge.
  scene::Scene bright = shipped_world("lagoon").scene();
  bright.sky.zenith = bright.sky.horizon = glm::vec3(1.0f);
  bright.sky.cloud_cover = 0.0;
  const World world = world_of(bright);
  const View view = view_of(world, 2.0, kAccuracySize_px.x, kAccuracySize_px.y);
  expect_smooth(measure(world, view, 2.0, {kLand | kSky, Paint::kLit}));
}

TEST(EdgeAccuracy, OfTheHorizonAndOfBuoys) {
  const View rolled = make_view({0.0, 0.0, 10.0}, camera_axes(0.5, -0.05, 0.1),
                                lens_of_fov(0.8, kAccuracySize_px.x, kAccuracySize_px.y), 0.25f,
                                kAccuracySize_px.x, kAccuracySize_px.y);
  expect_smooth(measure(shipped_world("open_ocean"), rolled, 2.0, {kWater | kSky}));
  expect_smooth(measure_shipped("buoys", {kWater | kObject}));
}

// Seen from between the waves through a long lens.
Errors measure_crests(const char* name, double fov_rad) {
  constexpr double kEye_m = 4.0;
  const View view = make_view({0.0, 0.0, kEye_m}, 0.5, -0.4 * fov_rad, fov_rad, 0.25f,
                              kAccuracySize_px.x, kAccuracySize_px.y);
  return measure(shipped_world(name), view, 2.0, {kWater, Paint::kByDepth}, kEye_m);
}

TEST(EdgeAccuracy, OfCrestsAgainstFartherWater) {
  for (const char* name : {"open_ocean", "sea_state_6", "sea_state_8", "sines"})
    expect_smooth(measure_crests(name, 0.1));
}

}  // namespace
}  // namespace swell::render
