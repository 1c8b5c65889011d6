// Rays against implicit surfaces of random shape: what brute force finds is found.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "math/random.h"
#include "render/objects/height_pictures.h"
#include "render/objects/implicit_shots.h"
#include "trials.h"

namespace swell::render {
namespace {

struct Dice {
  std::uint64_t seed = 0, next = 0;
  double roll(double low, double high) { return low + (high - low) * random_uniform(seed, next++); }
};

// A base of any proportions, some very thin, with bumps and dents.
scene::ImplicitSurface random_implicit(std::uint64_t seed) {
  Dice dice{seed};
  const char* const kShapes[] = {"ellipsoid", "cylinder", "cone", "ellipsoid"};
  std::string text;
  const int parts = 1 + static_cast<int>(dice.roll(0, 2.99));
  for (int part = 0; part < parts; ++part) {
    const auto place = [&](double reach) {
      return fmt::format("[{}, {}, {}]", dice.roll(-reach, reach), dice.roll(-reach, reach),
                         dice.roll(-reach, reach));
    };
    const auto size = [&](double most) {
      return fmt::format("[{}, {}, {}]", std::exp(dice.roll(-4, 0)) * most,
                         std::exp(dice.roll(-3, 0)) * most, std::exp(dice.roll(-1, 0)) * most);
    };
    text += fmt::format("[[form]]\nshape = \"{}\"\nsize = {}\nat = {}\nturn_deg = {}\nbend = [",
                        kShapes[static_cast<int>(dice.roll(0, 3.99))], size(2.6), place(0.4),
                        place(180));
    const int bends = static_cast<int>(dice.roll(0, 4.99));
    for (int i = 0; i < bends; ++i)
      text += fmt::format("{{ size = {}, at = {}, turn_deg = {}, factor = {} }},", size(2.0),
                          place(0.7), place(180), dice.roll(-3, 3));
    text += "]\n";
    if (dice.roll(0, 1) < 0.3)
      text += fmt::format("cut = [{{ size = {}, at = {} }}]\n", size(1.0), place(0.6));
    if (dice.roll(0, 1) < 0.3)
      text += fmt::format("keep = [{{ shape = \"box\", size = {}, at = {} }}]\n", size(2.0),
                          place(0.2));
  }
  return implicit_of(text.c_str());
}

// A box or a plane with a table of rough heights, tilted any way, with or without a threshold and a
// hole.
scene::ImplicitSurface random_table(std::uint64_t seed) {
  Dice dice{seed + 2000};
  const HeightPictures pictures;
  const int columns = static_cast<int>(dice.roll(2, 40)), rows = static_cast<int>(dice.roll(2, 40));
  const double rough = dice.roll(0.0, 0.4);
  pictures.write("rough.exr", columns, rows, [&](double u, double v) {
    return 0.4 * std::sin(3.0 * u) * std::cos(4.0 * v) + dice.roll(-rough, rough);
  });
  std::string text = fmt::format(
      "[[form]]\nshape = \"{}\"\nsize = [{}, {}, {}]\nturn_deg = [{}, {}, {}]\n",
      dice.roll(0, 1) < 0.5 ? "box" : "plane", dice.roll(0.5, 3), dice.roll(0.5, 3),
      dice.roll(0.2, 1), dice.roll(-180, 180), dice.roll(-180, 180), dice.roll(-180, 180));
  text +=
      fmt::format("heights = {{ image = \"rough.exr\"{} }}\n",
                  dice.roll(0, 1) < 0.5 ? std::string()
                                        : fmt::format(", threshold_m = {}", dice.roll(-0.4, 0.3)));
  if (dice.roll(0, 1) < 0.4)
    text +=
        fmt::format("cut = [{{ size = [0.9, 0.9, 2], at = [{}, 0, 0] }}]\n", dice.roll(-0.5, 0.5));
  return pictures.parse(text);
}

View random_view(std::uint64_t seed, int size_px) {
  Dice dice{seed + 1000};
  const double heading = dice.roll(-kPi, kPi), pitch = dice.roll(-1.5, 1.5);
  const glm::dvec3 along(std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch),
                         std::sin(pitch));
  const double distance_m = dice.roll(4.0, 12.0);
  return make_view(-distance_m * along, heading, pitch, 4.0 / distance_m, 0.25f, size_px, size_px);
}

double inside(const scene::ImplicitSurface& implicit, glm::dvec3 p) {
  double most = -1e300;
  for (const scene::ImplicitPart& part : implicit.parts) most = std::max(most, value(part, p));
  return most;
}

// Draws random implicit surfaces, and marches along each pixel's ray in 400 steps: what is inside
// by `least` is found. Fewer than 8 surfaces may show next to nothing. Returns the number of rays.
int expect_found_as_by_marching(int surfaces,
                                scene::ImplicitSurface (*make)(std::uint64_t) = random_implicit,
                                double least = 1e-6) {
  constexpr int kSize_px = 64, kSteps = 400;
  int pixels = 0, missed = 0, wrong = 0, shown = 0;
  for (int n = 0; n < surfaces; ++n) {
    scene::ImplicitSurface implicit;
    try {
      implicit = make(static_cast<std::uint64_t>(n));
    } catch (const std::runtime_error&) {
      continue;  // without an inside
    }
    const View view = random_view(static_cast<std::uint64_t>(n), kSize_px);
    const ImplicitShot shot = shoot(implicit, view);
    for (std::size_t i = 0; i < shot.part.size(); ++i) {
      const glm::dvec3 ray = shot.ray(i);
      const double middle_m = -glm::dot(view.eye_world, ray) / glm::dot(ray, ray);
      const double from_m = std::max(middle_m - 3.0, 0.3), step_m = 6.0 / kSteps;
      const double drawn_m = shot.depth_m[i];
      ++pixels;
      if (drawn_m > 0.0) {
        ++shown;
        // What is shown is on the implicit surface, to rounding.
        const glm::dvec3 p = view.eye_world + ray * drawn_m;
        const double hair_m = 3e-5;
        if (inside(implicit, p + hair_m * ray) < -1e-4 &&
            inside(implicit, p - hair_m * ray) < -1e-4 && inside(implicit, p) < -1e-4)
          ++wrong;
      }
      for (int k = 0; k < kSteps; ++k) {
        const double at_m = from_m + step_m * k;
        if (drawn_m > 0.0 && at_m >= drawn_m - 1e-4) break;
        if (inside(implicit, view.eye_world + ray * at_m) < least) continue;
        ++missed;
        break;
      }
    }
  }
  EXPECT_EQ(missed, 0) << "of " << pixels;
  EXPECT_EQ(wrong, 0) << "of " << shown;
  EXPECT_GT(shown, pixels / 50);
  return pixels;
}

TEST(ImplicitRays, FindsWhatFineMarchingFinds) {
  expect_found_as_by_marching(std::max(trials(20), 8));
}

// Heights are as steep as 40 m on a metre: what floats round a place by tells so much more.
TEST(ImplicitRays, FindsWhatFineMarchingFindsOfTables) {
  expect_found_as_by_marching(std::max(trials(12), 8), random_table, 1e-4);
}

TEST(ImplicitRays, MissNothingOfAMillionRays) {
  EXPECT_GE(expect_found_as_by_marching(300), 1000000);
}

TEST(ImplicitRays, SquaresLeaveNothingOut) {
  for (int n = 0; n < trials(40); ++n) {
    scene::ImplicitSurface implicit;
    const auto seed = static_cast<std::uint64_t>(500 + n / 2);
    try {
      implicit = n % 2 == 0 ? random_implicit(seed) : random_table(seed);
    } catch (const std::runtime_error&) {
      continue;
    }
    const View view = random_view(seed, 150);
    const ImplicitShot with = shoot(implicit, view), without = shoot(implicit, view, 0.0, false);
    ASSERT_EQ(with.part, without.part) << n;
    ASSERT_EQ(with.depth_m, without.depth_m) << n;
  }
}

TEST(ImplicitRays, TilesOfAnySizeShowTheSameBits) {
  const scene::ImplicitSurface implicit = random_implicit(0);
  const View view = random_view(0, 150);
  const ImplicitShot large = shoot(implicit, view);
  for (const int size : {16, 32}) {
    const ImplicitShot small = shoot(implicit, view, 0.0, true, size);
    EXPECT_EQ(large.part, small.part);
    EXPECT_EQ(large.depth_m, small.depth_m);
  }
}

// A wire of 2 mm from 100 m, across 2000 pixels of which each is 5 mm wide: as many rays meet it as
// it covers.
TEST(ImplicitRays, ThinWireIsNotSteppedOver) {
  const scene::ImplicitSurface implicit = implicit_of(
      "[[form]]\nshape = \"cylinder\"\nsize = [0.002, 0.002, 10]\nturn_deg = [0, 77, 0]\n"
      "bend = [{ size = [3, 3, 3], factor = 0.001 }]");
  const ImplicitShot shot = shoot(implicit, from_south(100.0, 8.0, 1600));
  const double covered =
      0.002 * 1.0 / std::sin(77.0 * kPi / 180.0) * 8.0 / (8.0 / 1600 * 8.0 / 1600);
  EXPECT_NEAR(static_cast<double>(shot.count), covered, 0.1 * covered);
}

TEST(ImplicitRays, TurningPartsAreAPureFunctionOfTime) {
  const scene::ImplicitSurface implicit = implicit_of(
      "[[form]]\nsize = [0.3, 0.1, 2]\nat = [0, 0, 1]\nspin_axis = [0, 1, 0]\nspin_rpm = 60\n"
      "hub = [0, 0, 0]");
  const View view = from_south(10.0, 5.0, 100);
  const ImplicitShot up = shoot(implicit, view, 0.0), again = shoot(implicit, view, 7.0);
  EXPECT_EQ(up.part, again.part);  // whole turns
  const ImplicitShot aside = shoot(implicit, view, 0.25);
  EXPECT_GT(up.depth_m[25 * 100 + 50], 0.0f);
  EXPECT_EQ(aside.depth_m[25 * 100 + 50], 0.0f);
  // Right-handed about north: from up to the east.
  EXPECT_GT(aside.depth_m[50 * 100 + 70], 0.0f);
}

}  // namespace
}  // namespace swell::render
