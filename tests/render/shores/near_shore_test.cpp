// What land does to the sea before it, as it is drawn: calm lees, and fronts of foam along shores.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "ocean/coast/shelter.h"
#include "ocean/coast/surf_fronts.h"
#include "render/labelled_frame.h"
#include "render/world/forest.h"
#include "render/world/near_shore_map.h"
#include "render/world/world_state.h"
#include "scene/water.h"
#include "scratch_folder.h"
#include "terrain/boundary.h"
#include "terrain/height_grid.h"
#include "texture/image/image_io.h"

namespace swell::render {
namespace {

View view_down(glm::dvec2 middle, double height_m, int width_px, int height_px) {
  return make_view({middle, height_m}, 0.0, -0.5 * kPi, 50.0 * kPi / 180.0, 0.25f, width_px,
                   height_px);
}

scene::Scene windy_lagoon() {
  scene::Scene scene = load_shipped("lagoon");
  scene.sea.wind_speed_mps = 12.0;
  scene.sea.amplitude_scale = 1.0;
  return scene;
}

int count_differences(const LabelledFrame& a, const LabelledFrame& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.target.rgba.size(); ++i)
    count += a.target.rgba[i] != b.target.rgba[i];
  return count;
}

TEST(NearShore, ShelterCanBeLeftOut) {
  const World world = world_of(windy_lagoon());
  const View view = view_down({-300.0, 0.0}, 150.0, 160, 90);  // the lee: the wind is from the east
  const LabelledFrame all(world, view, 5.0), bare(world, view, 5.0, {.without = {Part::kShelter}});
  EXPECT_GT(count_differences(all, bare), 10000);
}

TEST(NearShore, FrontsCanBeLeftOut) {
  const World world = world_of(windy_lagoon());
  const View view = view_down({190.0, 0.0}, 150.0, 160, 90);
  const LabelledFrame all(world, view, 5.0),
      bare(world, view, 5.0, {.without = {Part::kSurfFronts}});
  const int different = count_differences(all, bare);
  EXPECT_GT(different, 300);
  EXPECT_LT(different, 14000);
}

TEST(NearShore, TheOpenSeaKnowsNothingOfIt) {
  const World& world = shipped_world("open_ocean");
  const View view = view_down({0.0, 0.0}, 30.0, 160, 90);
  const LabelledFrame all(world, view, 5.0),
      bare(world, view, 5.0, {.without = {Part::kShelter, Part::kSurfFronts}});
  EXPECT_EQ(count_differences(all, bare), 0);
}

// The drawn slopes of the long waves are as much lower in a lee as the heights that are asked.
TEST(NearShore, TheMapHasWhatQueriesHave) {
  const World world = world_of(windy_lagoon());
  const WorldState& state = world.state();
  ASSERT_TRUE(state.near_shore);
  const NearShoreMap& near = *state.near_shore;
  for (int n = 0; n < 200; ++n) {
    const glm::dvec2 place(random_uniform(3, 2 * n), random_uniform(3, 2 * n + 1));
    const glm::dvec2 texel = glm::floor(place * static_cast<double>(kNearShoreSize));
    const glm::dvec2 p = near.min_world + texel * (near.size_m / kNearShoreSize);
    float kept = 1.0f;
    ocean::apply_shelter(*state.shelter, {&p, 1}, {&kept, 1});
    constexpr auto kSide = static_cast<std::size_t>(kNearShoreSize);
    const std::size_t word =
        (kSide + static_cast<std::size_t>(texel.y)) * kSide + static_cast<std::size_t>(texel.x);
    const auto code = static_cast<std::int8_t>(near.map.words[word].fine & 0xFF);
    EXPECT_NEAR(code / 127.0, 1.0 - static_cast<double>(kept), 0.5 / 127.0 + 1e-6);
  }
}

TEST(NearShore, FrontsReachAsFarAsTheBandIsWide) {
  scene::Scene scene = windy_lagoon();
  const World one = world_of(scene);
  scene.coast.surf_width = 2.0;
  const World wide = world_of(scene);
  const NearShoreMap &near = *one.state().near_shore, &far = *wide.state().near_shore;
  EXPECT_EQ(far.zone.reach_m, 2.0 * near.zone.reach_m);
  const View view = view_down({190.0, 0.0}, 150.0, 160, 90);
  const auto foam_of = [&](const World& world) {
    const LabelledFrame frame(world, view, 5.0, {.without = {Part::kWhitecaps}});
    double sum = 0.0;
    for (const float foam : frame.labels().foam) sum += static_cast<double>(foam);
    return sum;
  };
  EXPECT_GT(foam_of(wide), 1.3 * foam_of(one));
}

// Foam in a picture from straight above, smoothed over some pixels.
struct FoamField {
  int width, height;
  std::vector<double> value;

  FoamField(const LabelledFrame& frame, int radius)
      : width(frame.view.width_px), height(frame.view.height_px) {
    const std::vector<float>& foam = frame.labels().foam;
    value.resize(foam.size());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double sum = 0.0;
        for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
          for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u)
            sum += static_cast<double>(foam[frame.at({u, v})]);
        value[frame.at({x, y})] = sum;
      }
  }
  double at(int x, int y) const { return value[static_cast<std::size_t>(y * width + x)]; }
  // Its rise eastwards and northwards.
  glm::dvec2 rise(int x, int y) const {
    return {at(x + 1, y) - at(x - 1, y), at(x, y - 1) - at(x, y + 1)};
  }
};

// A beach without trains, its shore due east and west, the sea in the north.
scene::Scene straight_shore(double wind_from_rad) {
  scene::Scene scene;
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-500.0, 0.0}, {500.0, 0.0}};
  scene.terrain->beach_slope = 0.03;
  scene.terrain->beach_size_m = 1000.0;
  scene.sea.wind_speed_mps = 8.0;
  scene.sea.wind_from_rad = wind_from_rad;
  return scene;
}

// The mean direction in which foam changes, by its squared gradients.
TEST(NearShore, FrontsLieAlongTheShoreWithin10Degrees) {
  const World world = world_of(straight_shore(0.4));
  for (const double east_m : {-60.0, 0.0, 80.0})
    for (const double t_s : {3.0, 7.3}) {
      const LabelledFrame frame(world, view_down({east_m, 30.0}, 70.0, 320, 240), t_s,
                                {.without = {Part::kWhitecaps}});
      const FoamField foam(frame, 4);
      double across = 0.0, twist = 0.0, all = 0.0;
      for (int y = 6; y < foam.height - 6; ++y)
        for (int x = 6; x < foam.width - 6; ++x) {
          if (frame.position({x, y}).y < 2.0) continue;  // sheets on the sand
          const glm::dvec2 g = foam.rise(x, y);
          across += g.y * g.y - g.x * g.x;
          twist += 2.0 * g.x * g.y;
          all += glm::dot(g, g);
        }
      ASSERT_GT(all, 100.0) << east_m << ' ' << t_s;
      const double angle = 0.5 * std::atan2(twist, across);
      EXPECT_LT(std::abs(angle), 10.0 * kPi / 180.0) << east_m << ' ' << t_s;
      // And it does change across the shore, not along it.
      EXPECT_GT(std::hypot(across, twist), 0.25 * all) << east_m << ' ' << t_s;
    }
}

// Fronts run to the shore: what is seen a little later was further out before.
TEST(NearShore, FrontsRunToTheShore) {
  const World world = world_of(straight_shore(0.0));
  const auto profile = [&](double t_s) {
    const LabelledFrame frame(world, view_down({0.0, 30.0}, 70.0, 320, 240), t_s,
                              {.without = {Part::kWhitecaps}});
    std::vector<double> mean(240);
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x)
        mean[static_cast<std::size_t>(y)] +=
            static_cast<double>(frame.labels().foam[frame.at({x, y})]);
    return mean;
  };
  const std::vector<double> before = profile(4.0), after = profile(4.4);
  // How well they agree if the first is moved by so many rows; rows go southwards, to the shore.
  const auto product = [&](int moved) {
    double sum = 0.0;
    for (int y = 20; y < 200; ++y)
      sum += before[static_cast<std::size_t>(y - moved)] * after[static_cast<std::size_t>(y)];
    return sum;
  };
  double towards = 0.0, away = 0.0;
  for (int moved = 1; moved <= 8; ++moved) {
    towards += product(moved);
    away += product(-moved);
  }
  EXPECT_GT(towards, away);
}

// Part of the sea before a straight shore that foam hides, without whitecaps.
double foam_before(const World& world) {
  const LabelledFrame frame(world, view_down({0.0, 30.0}, 70.0, 160, 120), 5.0,
                            {.without = {Part::kWhitecaps}});
  double sum = 0.0;
  for (const float foam : frame.labels().foam) sum += static_cast<double>(foam);
  return sum / static_cast<double>(frame.labels().foam.size());
}

TEST(NearShore, LeesHaveLessSurf) {
  // The wind from the sea, and from land.
  const double from_sea = foam_before(world_of(straight_shore(0.0)));
  EXPECT_GT(from_sea, 0.02);
  EXPECT_LT(foam_before(world_of(straight_shore(kPi))), 0.25 * from_sea);
}

// Pieces of open water that foam closes in.
int count_enclosed(const LabelledFrame& frame) {
  constexpr int kLeast_px = 20;
  const std::vector<float>& foam = frame.labels().foam;
  std::vector<bool> is_seen(foam.size());
  int enclosed = 0;
  std::vector<glm::ivec2> next;
  for (int y = 0; y < frame.view.height_px; ++y)
    for (int x = 0; x < frame.view.width_px; ++x) {
      int size_px = 0;
      bool is_at_edge = false;
      next.emplace_back(x, y);
      while (!next.empty()) {
        const glm::ivec2 at = next.back();
        next.pop_back();
        if (at.x < 0 || at.y < 0 || at.x >= frame.view.width_px || at.y >= frame.view.height_px) {
          is_at_edge = true;
          continue;
        }
        if (is_seen[frame.at(at)] || foam[frame.at(at)] > 0.5f) continue;
        is_seen[frame.at(at)] = true;
        ++size_px;
        for (const auto& step : {glm::ivec2{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          next.push_back(at + step);
      }
      enclosed += size_px > kLeast_px && !is_at_edge;
    }
  return enclosed;
}

// A gale's surf zone is wide: what its fronts leave lies there in tongues and drifts. As a net over
// all of it, it would close in a piece of water every 5 m^2.
TEST(NearShore, FoamOfAGaleIsNoNet) {
  scene::Scene scene = straight_shore(0.0);
  scene.sea.wind_speed_mps = 16.0;
  const World world = world_of(scene);
  constexpr double kHeight_m = 30.0;
  const double side_m = 2.0 * kHeight_m * std::tan(25.0 * kPi / 180.0);
  int enclosed = 0;
  double area_m2 = 0.0;
  for (const double t_s : {3.0, 9.0, 15.0, 21.0}) {
    const LabelledFrame frame(world, view_down({0.0, 60.0}, kHeight_m, 320, 240), t_s,
                              {.without = {Part::kWhitecaps}});
    enclosed += count_enclosed(frame);
    area_m2 += side_m * side_m * 320.0 / 240.0;
  }
  EXPECT_LT(enclosed, area_m2 / 20.0);
  EXPECT_GT(foam_before(world), 0.05);
}

// What is painted in the water boundary (terrain/boundary.h) is what runs in.
TEST(NearShore, FrontsAreThePartThatIsPainted) {
  scene::Scene scene = straight_shore(0.0);
  const World made = world_of(scene);
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "boundary.exr";
  scene.terrain->boundary = file;
  std::vector<double> foam;
  for (const float part : {1.0f, 0.4f, 0.0f}) {
    texture::ImageF image = terrain::boundary_image(*made.state().shore);
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = part;
    texture::write_file(file, texture::encode_image(image, ".exr"));
    foam.push_back(foam_before(World(scene, made, 2)));
  }
  EXPECT_EQ(foam[0], foam_before(made));
  EXPECT_LT(foam[1], 0.8 * foam[0]);
  EXPECT_GT(foam[1], 1.5 * foam[2]);
}

scene::Scene lifting_shore() {
  scene::Scene scene = straight_shore(0.0);
  scene.coast.model = scene::CoastModel::kFronts;
  return scene;
}

// Pixels have the slopes of the fronts that vertices are lifted by: regressed on those that queries
// give, they are as steep.
TEST(NearShore, FrontsThatLiftTheWaterShowItsSlopes) {
  const scene::Scene scene = lifting_shore();
  const World world = world_of(scene);
  const scene::Water water(scene);
  Workers workers(1);
  ocean::SeaFrame sea;
  const scene::WaterSurface surface = water.at(5.0, sea, workers);
  const LabelledFrame frame(world, view_down({0.0, 40.0}, 60.0, 320, 240), 5.0,
                            {.without = {Part::kWhitecaps}});
  double both = 0.0, queried = 0.0;
  frame.for_pixels(2, [&](glm::ivec2 at) {
    const glm::dvec2 p(frame.position(at));
    const double reaches = p.y / world.state().near_shore->zone.reach_m;
    if (reaches < 0.3 || reaches > 0.9 || frame.labels().foam[frame.at(at)] > 0.5f) return;
    const glm::vec3 normal = frame.labels().normal[frame.at(at)];
    glm::vec2 slope;
    surface.slopes({&p, 1}, {&slope, 1});
    both += static_cast<double>(-normal.y / normal.z * slope.y);
    queried += static_cast<double>(slope.y * slope.y);
  });
  ASSERT_GT(queried, 5.0);
  EXPECT_NEAR(both / queried, 1.0, 0.15);
}

TEST(NearShore, FrontsThatLiftTheWaterCanBeLeftOut) {
  scene::Scene scene = lifting_shore();
  const World lifting = world_of(scene);
  scene.coast.model = scene::CoastModel::kNone;
  const World flat = world_of(scene);
  const View view = view_down({0.0, 30.0}, 70.0, 160, 120);
  const PartSet none = {Part::kSurfFronts};
  const LabelledFrame all(lifting, view, 5.0), bare(lifting, view, 5.0, {.without = none}),
      other(flat, view, 5.0, {.without = none});
  EXPECT_GT(count_differences(all, bare), 3000);
  // Without them the sea has its own heights, but for triangles that other bounds give.
  double lifted_m = 0.0, left_m = 0.0;
  for (std::size_t i = 0; i < bare.labels().elevation_m.size(); ++i) {
    const float height_m = other.labels().elevation_m[i];
    lifted_m += static_cast<double>(std::abs(all.labels().elevation_m[i] - height_m));
    left_m += static_cast<double>(std::abs(bare.labels().elevation_m[i] - height_m));
  }
  EXPECT_LT(left_m, 0.1 * lifted_m);
}

// How much caustics change a picture from above between two parts of the surf's reach.
double caustics_between(const World& world, double from, double to) {
  const View view = view_down({0.0, 50.0}, 90.0, 160, 120);
  const PartSet others = {Part::kWhitecaps, Part::kRipples, Part::kGlitter};
  PartSet none = others;
  none.add(Part::kCaustics);
  const LabelledFrame lit(world, view, 5.0, {.without = others}),
      plain(world, view, 5.0, {.without = none});
  const double reach_m = world.state().near_shore->zone.reach_m;
  double sum = 0.0, count = 0.0;
  lit.for_pixels(1, [&](glm::ivec2 at) {
    const double part = lit.position(at).y / reach_m;
    if (part < from || part > to) return;
    const auto green = [&](const LabelledFrame& frame) {
      return static_cast<double>(frame.target.rgba[frame.at(at)] >> 8 & 255u);
    };
    sum += std::abs(green(lit) - green(plain));
    ++count;
  });
  return sum / count;
}

// The layers of figure 6: caustics begin where the surf ends.
TEST(NearShore, CausticsFadeOverTheSurfOfFrontsThatLiftTheWater) {
  const World lifting = world_of(lifting_shore()), foam_alone = world_of(straight_shore(0.0));
  const double in_surf = caustics_between(lifting, 0.15, 0.45),
               in_foam = caustics_between(foam_alone, 0.15, 0.45);
  ASSERT_GT(in_foam, 0.3);
  EXPECT_LT(in_surf, 0.7 * in_foam);
  EXPECT_GT(caustics_between(lifting, 1.1, 1.6), 0.75 * caustics_between(foam_alone, 1.1, 1.6));
}

// What is painted is where the ground, its trees and the fronts are: the shore 20 pixels north.
TEST(NearShore, GroundTreesAndFrontsFollowThePaintedBoundary) {
  constexpr int kBy_px = 20;
  scene::Scene scene = lifting_shore();
  scene.trees = {{.species = terrain::TreeSpecies::kConifer,
                  .place = terrain::TreePlace::kBanks,
                  .clumping = 0.0,
                  .bank_width_m = 30.0,
                  .lake_shores = true,
                  .ground_m = {0.2, 50.0}}};
  const World made = world_of(scene);
  const texture::ImageF image = terrain::boundary_image(*made.state().shore);
  texture::ImageF moved = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 4; ++c)
        moved.pixels[4 * static_cast<std::size_t>(y * image.width + x) +
                     static_cast<std::size_t>(c)] =
            image.at(x, std::min(y + kBy_px, image.height - 1), c);
  const ScratchFolder folder;
  scene.terrain->boundary = folder.path() / "moved.exr";
  scene.terrain->ground_from_boundary = true;
  texture::write_file(scene.terrain->boundary, texture::encode_image(moved, ".exr"));
  const World painted = world_of(scene);
  const WorldState &a = made.state(), &b = painted.state();
  const glm::dvec2 by(0.0, kBy_px * a.shore->grid().spacing_m);
  for (int n = 0; n < 100; ++n) {
    const glm::dvec2 p(600.0 * (random_uniform(3, 2 * n) - 0.5),
                       300.0 * (random_uniform(3, 2 * n + 1) - 0.5));
    EXPECT_NEAR(height_at(*b.terrain, p + by), height_at(*a.terrain, p), 1e-3);
    EXPECT_NEAR(place_in_fronts(*b.near_shore->fronts, p + by).at.part,
                place_in_fronts(*a.near_shore->fronts, p).at.part, 0.02);
  }
  const auto trees_between = [](const WorldState& state, double south_m, double north_m) {
    const terrain::Trees& trees = state.forest->trees;
    return std::ranges::count_if(trees.trees, [&](const terrain::Tree& tree) {
      const double y = trees.origin.y + static_cast<double>(tree.foot.y);
      return y >= south_m && y < north_m;
    });
  };
  EXPECT_GT(trees_between(a, -30.0, 0.0), 50);
  EXPECT_EQ(trees_between(a, 0.0, 100.0), 0);
  EXPECT_GT(trees_between(b, by.y - 30.0, by.y), 50);
  EXPECT_EQ(trees_between(b, -100.0, by.y - 31.0), 0);
}

}  // namespace
}  // namespace swell::render
