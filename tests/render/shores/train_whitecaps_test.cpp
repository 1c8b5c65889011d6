// Whitecaps over the wave trains of a coast as pictures have them: how much of the water they hide,
// and that what is asked is what is drawn.
#include <gtest/gtest.h>

#include <string>

#include "ocean/open_sea/whitecaps.h"
#include "render/drawn_foam.h"

namespace swell::render {
namespace {

// A shore along y = 0 with the sea in the north, 60 m deep from 600 m on, where no wave feels it.
scene::Scene deep_coast(double wind_mps) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = wind_mps;
  scene.sea.resolution = 64;
  scene.area.size_m = {40000.0, 40000.0};
  scene.detail.water_triangles = 4000;
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-1500.0, 0.0}, {1500.0, 0.0}};
  scene.terrain->centre_m = {0.0, 1000.0};
  scene.terrain->beach_slope = 0.1;
  scene.terrain->beach_size_m = 3000.0;
  scene.terrain->floor_depth_m = 60.0;
  scene.coast.model = scene::CoastModel::kTrains;
  scene.coast.trains = 3;
  return scene;
}

scene::Scene beach_in(double wind_mps) {
  scene::Scene scene = load_shipped("beach");
  scene.sea.wind_speed_mps = wind_mps;
  return scene;
}

double mean_cover_over_trains(const World& world, double height_m, int frames) {
  Shot film;
  double sum = 0.0;
  for (int k = 0; k < frames; ++k) {
    film.draw(world, from_above({0.0, 1000.0}, height_m, 160), 30.0 + 3.1 * k,
              {.labels = LabelSet::all()});
    sum += mean_of(film.target.labels.foam);
  }
  return sum / frames;
}

// OPT-16: within 35 % of the law.
TEST(DrawnTrainWhitecaps, CoverWhatTheWindSays) {
  for (const double wind : {10.0, 15.0, 22.0}) {
    const World world = world_of(deep_coast(wind));
    EXPECT_NEAR(mean_cover_over_trains(world, 500.0, 8) / ocean::whitecap_cover(wind), 1.0, 0.35)
        << wind;
  }
}

TEST(DrawnTrainWhitecaps, CoverAsMuchFromFarAsFromNear) {
  const World world = world_of(deep_coast(15.0));
  for (const double height_m : {1000.0, 60.0})
    EXPECT_NEAR(mean_cover_over_trains(world, height_m, height_m > 500.0 ? 4 : 16) /
                    ocean::whitecap_cover(15.0),
                1.0, 0.5)
        << height_m;
}

TEST(DrawnTrainWhitecaps, AreNoneInCalmWind) {
  EXPECT_EQ(mean_cover_over_trains(world_of(deep_coast(3.6)), 200.0, 2), 0.0);
}

TEST(DrawnTrainWhitecaps, CanBeLeftOut) {
  scene::Scene scene = deep_coast(15.0);
  const World with = world_of(scene);
  scene.sea.whitecaps = 0.0;
  const World without = world_of(scene);
  const View view = from_above({0.0, 1000.0}, 200.0, 96);
  const Shot left_out(with, view, 2.0, {.without = {Part::kWhitecaps}});
  EXPECT_NE(Shot(with, view, 2.0).target.rgba, left_out.target.rgba);
  EXPECT_EQ(Shot(without, view, 2.0).target.rgba, left_out.target.rgba);
}

void expect_asked_is_drawn(const scene::Scene& scene, glm::dvec2 middle, double height_m) {
  const FoamComparison c = compare_foam(scene, middle, height_m, 12);
  ASSERT_GT(c.asked / c.blocks, 0.005);
  EXPECT_NEAR(c.drawn / c.asked, 1.0, 0.15);
  EXPECT_GT(c.likeness(), 0.5);
}

// The bounds are those of the open sea's (DrawnWhitecaps.AreWhatIsAskedInTheMeanOverTheirLace).
TEST(DrawnTrainWhitecaps, AreWhatIsAskedInTheMeanOverTheirLace) {
  for (const double height_m : {120.0, 300.0}) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, std::to_string(height_m));
    expect_asked_is_drawn(deep_coast(15.0), {0.0, 1000.0}, height_m);
  }
}

// With surf under whitecaps, and where trains and spectrum blend.
TEST(DrawnTrainWhitecaps, AreWhatIsAskedInTheSurfOfABeachInAGale) {
  expect_asked_is_drawn(beach_in(22.0), {-100.0, -120.0}, 100.0);
  expect_asked_is_drawn(beach_in(22.0), {-100.0, 100.0}, 300.0);
  expect_asked_is_drawn(beach_in(22.0), {-100.0, 250.0}, 300.0);
  expect_asked_is_drawn(beach_in(12.0), {-100.0, 250.0}, 100.0);
}

// More foam in a wider band, less in a narrower one, drawn where it is asked.
TEST(DrawnSurf, HasABandAsWideAsAskedFor) {
  scene::Scene scene = beach_in(10.0);
  scene.sea.whitecaps = 0.0;
  const auto drawn = [&](double width) {
    scene.coast.surf_width = width;
    const FoamComparison c = compare_foam(scene, {-100.0, 0.0}, 300.0, 12);
    if (c.asked > 0.0) {
      EXPECT_GT(c.likeness(), 0.5) << width;
    }
    return c.drawn / c.blocks;
  };
  const double one = drawn(1.0);
  EXPECT_GT(one, 0.002);
  EXPECT_GT(drawn(2.5), 1.3 * one);
  EXPECT_LT(drawn(0.4), 0.7 * one);
}

// From near: lace that pixels blur hides up to a fifth less.
TEST(DrawnSurf, IsWhatIsAskedInTheMeanOverItsLace) {
  scene::Scene scene = beach_in(22.0);
  scene.sea.whitecaps = 0.0;
  for (const double north_m : {100.0, 250.0}) expect_asked_is_drawn(scene, {-100.0, north_m}, 12.0);
}

}  // namespace
}  // namespace swell::render
