// The shaders' fog against the closed forms of sky/fog.h and sums along the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "render/shaders/shader_kernels.h"
#include "render/sky/cloud_shadow.h"
#include "sky/fog.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class FogKernel : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, FogKernel, texture::every_target(), texture::target_name);

struct Air {
  explicit Air(const sky::FoggyAir& of, double eye_m, double sun_sine = 0.5) : air(of) {
    fog.on = true;
    fog.is_exponential = air.profile == sky::FogProfile::kExponential;
    fog.is_paper = air.scattering == sky::FogScattering::kPaper;
    fog.per_m = sky::fog_per_m(air);
    fog.is_grey = fog.per_m.x == fog.per_m.y && fog.per_m.y == fog.per_m.z;
    fog.top_m = static_cast<float>(air.fog_top_m);
    fog.sun_sine = static_cast<float>(sun_sine);
    fog.to_sun = {0.0f, std::sqrt(1.0f - fog.sun_sine * fog.sun_sine), fog.sun_sine};
    fog.scattered = glm::vec3(1.0f);
    fog.at_eye = start(eye_m);
    fog.at_sea = start(0.0);
  }

  FogStart start(double height_m) const {
    const double above_m = sky::fog_above_m(air, height_m);
    FogStart start{static_cast<float>(height_m), static_cast<float>(above_m)};
    for (int c = 0; c < 3; ++c)
      start.sun_passes[c] = static_cast<float>(std::exp(-fog.per_m[c] * above_m / fog.sun_sine));
    return start;
  }

  struct Seen {
    glm::vec3 passes, added;
  };
  Seen see(glm::vec3 direction, double distance_m) const {
    std::vector<glm::vec3> passes(1), added(1);
    see_fog(fog, fog.at_eye, std::vector{glm::normalize(direction)},
            std::vector{static_cast<float>(distance_m)}, passes, added);
    return {passes[0], added[0]};
  }

  sky::FoggyAir air;
  Fog fog;
};

sky::FoggyAir slab(double per_m, double top_m) {
  sky::FoggyAir air;
  air.attenuation_per_m = glm::vec3(static_cast<float>(per_m));
  air.fog_top_m = top_m;
  air.forward = 0.0;
  return air;
}

// FOG-04.
TEST_P(FogKernel, VisibilityLeavesTwoPercent) {
  sky::FoggyAir air;
  for (const double visibility_m : {200.0, 1000.0, 5000.0}) {
    air.visibility_m = visibility_m;
    const Air fog(air, 2.0);
    EXPECT_NEAR(fog.see({0.6f, 0.8f, 0.0f}, visibility_m).passes.y, 0.02, 1e-4);
  }
}

// FOG-03.
TEST_P(FogKernel, LayerScattersAsKnown) {
  const glm::vec3 down(0.0f, std::cos(0.3f), -std::sin(0.3f));
  const double way_m = 100.0 / std::sin(0.3);
  sky::FoggyAir air = slab(1e-3, 200.0);
  EXPECT_NEAR(Air(air, 100.0, std::sin(0.7)).see(down, way_m).added.x / 1e-3, 228.671, 0.02);
  air.scattering = sky::FogScattering::kPaper;
  EXPECT_NEAR(Air(air, 100.0, std::sin(0.7)).see(down, way_m).added.x / 1e-3, 210.463, 0.02);
}

TEST_P(FogKernel, ThinningFogHasKnownDepths) {
  sky::FoggyAir air = slab(1e-3, 100.0);
  air.profile = sky::FogProfile::kExponential;
  const Air fog(air, 10.0);
  const double known[][2] = {{0.0, 0.904837}, {0.01, 0.861067}, {0.5, 0.179748}};
  for (const auto& [rise, depth] : known) {
    const auto z = static_cast<float>(rise);
    const glm::vec3 direction(0.0f, std::sqrt(1.0f - z * z), z);
    EXPECT_NEAR(-std::log(fog.see(direction, 1000.0).passes.x), depth, 1e-5);
  }
}

// Any eye in, over and on the fog, any way, on a round earth: what lies on a parabola over the sea.
TEST_P(FogKernel, IsTheSumAlongTheWay) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 400; ++trial) {
    sky::FoggyAir air = slab(std::pow(10.0, -4.0 + 2.0 * unit(random)), 20.0 + 200 * unit(random));
    air.attenuation_per_m = glm::vec3(*air.attenuation_per_m) * glm::vec3(0.8f, 1.0f, 1.3f);
    const double eye_m = trial % 3 == 0 ? 5.0 : 400.0 * unit(random);
    const double sun_sine = 0.05 + 0.95 * unit(random);
    Air drawn(air, eye_m, sun_sine);
    const double drop = trial % 2 == 0 ? 1.0 / 14646e3 : 0.0;
    drawn.fog.drop_per_m2 = static_cast<float>(drop);
    const double rise = trial % 5 == 0 ? 0.0 : -0.3 + 0.6 * unit(random);
    // No further than the sea.
    double way_m = 20000.0 * unit(random);
    const auto height = [&](double s) { return eye_m + rise * s + drop * s * s; };
    if (rise < 0.0) {
      const double root = rise * rise - 4.0 * drop * eye_m;
      if (root >= 0.0) way_m = std::min(way_m, 2.0 * eye_m / (-rise + std::sqrt(root)));
    }
    const glm::vec3 direction(std::sqrt(1.0 - rise * rise), 0.0, rise);
    const Air::Seen seen = drawn.see(direction, way_m);
    constexpr int kSteps = 40000;
    for (int c = 0; c < 3; ++c) {
      const double per_m = drawn.fog.per_m[c];
      double depth = 0.0, added = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double z = height(way_m * (i + 0.5) / kSteps);
        if (z > air.fog_top_m) continue;
        const double step = per_m * way_m / kSteps;
        added += step * std::exp(-(depth + 0.5 * step) - per_m * (air.fog_top_m - z) / sun_sine);
        depth += step;
      }
      EXPECT_NEAR(seen.passes[c], std::exp(-depth), 2e-3) << trial;
      // A curved way is taken as a straight one of the same ends: 2 %.
      EXPECT_NEAR(seen.added[c], added, 0.02 * added + 1e-3) << trial;
    }
  }
}

// Where the sky begins nothing changes at once: a far place, and the sky behind it.
TEST_P(FogKernel, SkyGoesOnFromFarPlaces) {
  for (const auto profile : {sky::FogProfile::kSlab, sky::FogProfile::kExponential}) {
    sky::FoggyAir air = slab(2e-3, 60.0);
    air.profile = profile;
    const Air fog(air, 4.0);
    for (const float z : {0.02f, 0.1f, 0.7f, 1.0f}) {
      const glm::vec3 direction(0.0f, std::sqrt(1.0f - z * z), z);
      const Air::Seen far = fog.see(direction, 1e5), sky = fog.see(direction, 1e8);
      EXPECT_NEAR(far.passes.x, sky.passes.x, 1e-3);
      EXPECT_NEAR(far.added.x, sky.added.x, 2e-3 * sky.added.x);
    }
  }
}

// An endless level way shows the even light and the sun's, whatever is behind it.
TEST_P(FogKernel, NothingIsSeenThroughThickFog) {
  Air fog(slab(0.1, 50.0), 2.0);
  fog.fog.even = glm::vec3(0.25f);
  fog.fog.scattered = glm::vec3(0.0f);
  const Air::Seen seen = fog.see({1.0f, 0.0f, 0.0f}, 1e4);
  EXPECT_LT(seen.passes.x, 1e-30f);
  EXPECT_FLOAT_EQ(seen.added.x, 0.25f);
}

// Thicker and thinner places are as the mean of the waves along the way.
TEST_P(FogKernel, BanksAreTheMeanOfTheirWaves) {
  Air fog(slab(1e-3, 1000.0), 2.0);
  fog.fog.bank_count = 2;
  const auto bank_of = [](glm::vec2 turns_per_m, float turns, float amount) {
    return FogBank{turns_per_m, turns, std::cos(6.2831853f * turns), amount};
  };
  fog.fog.banks[0] = bank_of({0.002f, 0.001f}, 0.3f, 0.5f);
  fog.fog.banks[1] = bank_of({-0.0005f, 0.003f}, 0.8f, 0.4f);
  for (const double way_m : {0.5, 30.0, 700.0, 3000.0})
    for (const double turn : {0.0, 0.7, 2.0, 4.0}) {
      const glm::dvec3 direction(std::cos(turn), std::sin(turn), 0.0);
      constexpr int kSteps = 20000;
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double s = way_m * (i + 0.5) / kSteps;
        double density = 1.0;
        for (int k = 0; k < 2; ++k) {
          const FogBank& bank = fog.fog.banks[static_cast<std::size_t>(k)];
          density += bank.amount * std::sin(2.0 * 3.14159265358979 *
                                            (bank.turns + s * glm::dot(glm::dvec2(bank.turns_per_m),
                                                                       glm::dvec2(direction))));
        }
        sum += density / kSteps;
      }
      const double depth = -std::log(fog.see(glm::vec3(direction), way_m).passes.x);
      EXPECT_NEAR(depth, 1e-3 * way_m * sum, 2e-4 * depth + 2e-7) << way_m << ' ' << turn;
    }
}

// Clouds that leave a fifth of the sun west of edge_m from the eye, and all of it east of that.
struct HalfShade {
  explicit HalfShade(double edge_m) : edge(edge_m) {
    constexpr int n = CloudShadow::kSide;
    shadow.any = true;
    for (std::size_t level = 0; level < CloudShadow::kLevels; ++level) {
      shadow.eye[level] = {0.5f * n - static_cast<float>(edge_m) / CloudShadow::kTexels_m[level],
                           0.5f * n};
      for (int i = 0; i < n * n; ++i) {
        const auto lit = [&](int x) { return x < n / 2 ? 51u : 255u; };
        const std::uint32_t here = lit(i % n), east = lit(i % n + 1);
        shadow.words[level].push_back(here | east << 8 | here << 16 | east << 24);
      }
    }
  }
  double at(double x) const { return 0.2 + 0.8 * std::clamp((x - edge) / 48.0 + 1.0, 0.0, 1.0); }

  double edge;
  CloudShadow shadow;
};

Air air_of(sky::FogProfile profile, double per_m, double eye_m) {
  sky::FoggyAir air = slab(per_m, 60.0);
  air.profile = profile;
  return Air(air, eye_m);
}

constexpr sky::FogProfile kProfiles[] = {sky::FogProfile::kSlab, sky::FogProfile::kExponential};

TEST_P(FogKernel, SunlightFallsByWhatCloudsLeaveOfIt) {
  const HalfShade shaded(1500.0), lit(-100.0);
  for (const auto profile : kProfiles)
    for (const double per_m : {1e-4, 1e-3, 2e-2})
      for (const float rise : {-0.02f, 0.0f, 0.1f, 0.9f}) {
        Air fog = air_of(profile, per_m, 5.0);
        fog.fog.even = {0.3f, 0.3f, 0.5f}, fog.fog.even_sun = glm::vec3(0.3f);
        const double way_m = rise < 0.0f ? 200.0 : 1500.0;
        const glm::vec3 west(-1.0f, 0.5f, rise), east(1.0f, 0.5f, rise);
        const Air::Seen bare = fog.see(west, way_m), bare_east = fog.see(east, way_m);
        fog.fog.clouds = &shaded.shadow;
        const Air::Seen dim = fog.see(west, way_m);
        fog.fog.clouds = &lit.shadow;
        const Air::Seen bright = fog.see(east, way_m);
        EXPECT_EQ(dim.passes, bare.passes);
        EXPECT_NEAR(dim.added.y / bare.added.y, 0.2, 1e-3) << per_m << ' ' << rise;
        EXPECT_NEAR(bright.added.y / bare_east.added.y, 1.0, 1e-4) << per_m << ' ' << rise;
        // The sky's light is not the clouds' to shade.
        EXPECT_NEAR(dim.added.z - dim.added.y, 0.2f * (1.0f - bare.passes.z), 2e-6);
      }
}

// What thick fog shows is near, however far the way goes.
TEST_P(FogKernel, CloudsFarAwayShadeNothingThatIsSeen) {
  const HalfShade far(-1500.0);
  for (const auto profile : kProfiles)
    for (const double way_m : {5e3, 1e5, 1e8}) {
      Air fog = air_of(profile, 2e-2, 5.0);
      const glm::vec3 west(-1.0f, 0.0f, 0.0f);
      const double bare = fog.see(west, way_m).added.y;
      fog.fog.clouds = &far.shadow;
      EXPECT_NEAR(fog.see(west, way_m).added.y / bare, 1.0, 1e-4) << way_m;
    }
}

// The expected light is sunlight that fog scatters once, by places along the way; each of the
// kernel's eight places stands for a part.
TEST_P(FogKernel, CloudsShadeThePartOfAWayThatLiesInTheirShadow) {
  constexpr int kSteps = 4000;
  for (const auto profile : kProfiles)
    for (const double per_m : {2e-4, 3e-3})
      for (const double eye_m : {5.0, 300.0})
        for (const double edge_m : {-500.0, -60.0, 20.0}) {
          const HalfShade half(edge_m);
          Air fog = air_of(profile, per_m, eye_m);
          const glm::dvec3 direction =
              glm::normalize(glm::dvec3(-1.0, 0.2, eye_m > 60.0 ? -0.3 : 0.01));
          const double way_m = eye_m > 60.0 ? -eye_m / direction.z : 1200.0;
          const glm::vec3 along(direction);
          const double bare = fog.see(along, way_m).added.y;
          fog.fog.clouds = &half.shadow;
          double depth = 0.0, all = 0.0, seen = 0.0;
          for (int i = 0; i < kSteps; ++i) {
            const double t = way_m * (i + 0.5) / kSteps, z = eye_m + direction.z * t;
            const double density = profile == sky::FogProfile::kExponential
                                       ? std::exp(-z / fog.air.fog_top_m)
                                       : static_cast<double>(z < fog.air.fog_top_m);
            const double step = per_m * density * way_m / kSteps;
            const double above = per_m * sky::fog_above_m(fog.air, z) / fog.fog.sun_sine;
            const double arrives = step * std::exp(-depth - 0.5 * step - above);
            all += arrives, seen += arrives * half.at(direction.x * t), depth += step;
          }
          EXPECT_NEAR(fog.see(along, way_m).added.y / bare, seen / all, 0.05)
              << per_m << ' ' << eye_m << ' ' << edge_m;
        }
}

}  // namespace
}  // namespace swell::render
