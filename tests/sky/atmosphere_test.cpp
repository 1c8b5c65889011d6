// The light of sun, moon and stars in clear air: against standard tables, against paths of light
// followed one by one, and what must hold for any height of the sun.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "math/elementary.h"
#include "sky/light_paths.h"
#include "sky/sky_light.h"

namespace swell::sky {
namespace {

constexpr double kLux = 1e4;  // of the unit of irradiance

double luminance(glm::dvec3 rgb) { return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)); }

// Made once.
const Atmosphere& air_of(double turbidity) {
  static std::map<double, Atmosphere> made;
  const auto found = made.find(turbidity);
  if (found != made.end()) return found->second;
  Workers workers(2);
  return made.emplace(turbidity, make_atmosphere(turbidity, workers)).first->second;
}

SkyLight light_at(double elevation_deg, double moon_phase = 0.0, double turbidity = 2.2) {
  Sky sky;
  sky.turbidity = turbidity;
  sky.moon_phase = moon_phase;
  sky.sun_elevation_rad = radians(elevation_deg);
  sky.sun_direction = sun_direction(0.0, sky.sun_elevation_rad);
  Workers workers(2);
  return make_sky_light(sky, air_of(turbidity), workers);
}

// Returns the sky's irradiance on a level plane.
glm::dvec3 sky_irradiance(const SkyLight& light) {
  constexpr int kRings = 90, kSectors = 48;
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kRings; ++i) {
    const double from_zenith = 0.5 * kPi * (i + 0.5) / kRings;
    const double z = std::cos(from_zenith), across = std::sin(from_zenith);
    for (int j = 0; j < kSectors; ++j) {
      const double azimuth = 2.0 * kPi * (j + 0.5) / kSectors;
      const glm::vec3 d(across * std::sin(azimuth), across * std::cos(azimuth), z);
      sum += glm::dvec3(clear_radiance(light, d)) * (z * across);
    }
  }
  return sum * (0.5 * kPi / kRings * 2.0 * kPi / kSectors);
}

double direct_irradiance(const SkyLight& light) {
  return luminance(light.irradiance) * std::max(static_cast<double>(light.to_light.z), 0.0);
}

double illuminance_lx(const SkyLight& light) {
  return kLux * (direct_irradiance(light) + luminance(sky_irradiance(light)));
}

// Returns the illuminance of a level plane under a clear sky, without the moon, with the glow of
// the night sky.
// Source: P. M. Janiczek, J. A. DeYoung, Computer Programs for Sun and Moon Illuminance, United
// States Naval Observatory Circular 171, 1987: log10 in powers of the altitude over 90 degrees.
double standard_illuminance_lx(double altitude_deg) {
  struct Piece {
    double from_deg;
    std::array<double, 4> c;
  };
  constexpr Piece kPieces[] = {
      {20.0, {3.74, 3.97, -4.07, 1.47}},         {5.0, {3.05, 13.28, -45.98, 64.33}},
      {-0.8, {2.88, 22.26, -207.64, 1034.30}},   {-5.0, {2.88, 21.81, -258.11, -858.36}},
      {-12.0, {2.70, 12.17, -431.69, -1899.83}}, {-18.0, {13.84, 262.72, 1447.42, 2797.93}}};
  const double x = altitude_deg / 90.0;
  for (const Piece& piece : kPieces)
    if (altitude_deg >= piece.from_deg)
      return std::pow(10.0, piece.c[0] + x * (piece.c[1] + x * (piece.c[2] + x * piece.c[3])));
  return NAN;
}

TEST(Atmosphere, LightsTheGroundAsTheStandardTable) {
  for (double altitude_deg = 90.0; altitude_deg >= -12.0; altitude_deg -= 1.0) {
    const double factor = altitude_deg >= 5.0 ? 1.2 : altitude_deg >= -6.0 ? 1.5 : 3.0;
    const double lx = illuminance_lx(light_at(altitude_deg));
    const double standard_lx = standard_illuminance_lx(altitude_deg);
    EXPECT_LE(lx, factor * standard_lx) << altitude_deg;
    EXPECT_GE(lx, standard_lx / factor) << altitude_deg;
  }
}

// A clear sky gives, by the sun's altitude h: the sun on a plane turned to it, 127.5 klx
// exp(-0.21 m), m = 1 / sin h; the sky on a level plane, 0.8 + 15.5 sqrt(sin h) klx. Skies of the
// same clarity scatter by more than the fifth that is allowed here.
// Source: Illuminating Engineering Society, Recommended Practice for the Calculation of Daylight
// Availability, Journal of the Illuminating Engineering Society 13(4), 1984, pages 381 to 392.
TEST(Atmosphere, SunAndSkyHaveTheirPartsOfDaylight) {
  for (const double altitude_deg : {85.0, 60.0, 45.0, 30.0, 20.0, 15.0, 10.0}) {
    const double sine = std::sin(radians(altitude_deg));
    const double sun_klx = 127.5 * std::exp(-0.21 / sine) * sine;
    const double sky_klx = 0.8 + 15.5 * std::sqrt(sine);
    const SkyLight light = light_at(altitude_deg);
    EXPECT_NEAR(10.0 * direct_irradiance(light) / sun_klx, 1.0, 0.2) << altitude_deg;
    EXPECT_NEAR(10.0 * luminance(sky_irradiance(light)) / sky_klx, 1.0, 0.2) << altitude_deg;
  }
}

TEST(Atmosphere, HasAFloorOfNight) {
  for (const double altitude_deg : {-18.0, -40.0, -90.0}) {
    const double lx = illuminance_lx(light_at(altitude_deg));
    EXPECT_GE(lx, 5e-4) << altitude_deg;
    EXPECT_LE(lx, 8e-4) << altitude_deg;
  }
}

// Source: the same, of the full moon: 0.27 lx at the zenith.
TEST(Atmosphere, MoonLightsTheNight) {
  EXPECT_NEAR(illuminance_lx(light_at(-90.0, 1.0)), 0.27, 0.05);
  const double half = illuminance_lx(light_at(-60.0, 0.5)) - illuminance_lx(light_at(-60.0));
  const double full = illuminance_lx(light_at(-60.0, 1.0)) - illuminance_lx(light_at(-60.0));
  EXPECT_NEAR(half / full, 0.09, 0.02);  // the quarter moon is 2.6 magnitudes fainter
}

TEST(Atmosphere, EnergyNeverRisesAsTheSunSinks) {
  for (const double turbidity : {2.0, 4.0, 10.0}) {
    double before = 1e9;
    for (double altitude_deg = 90.0; altitude_deg >= -20.0;
         altitude_deg -= altitude_deg > 15.0 ? 1.0 : 0.25) {
      const SkyLight light = light_at(altitude_deg, 0.0, turbidity);
      const glm::dvec3 sky = sky_irradiance(light);
      const glm::dvec3 direct =
          glm::dvec3(light.irradiance) * std::max(static_cast<double>(light.to_light.z), 0.0);
      const double energy = sky.x + sky.y + sky.z + direct.x + direct.y + direct.z;
      EXPECT_LE(energy, before * (1.0 + 1e-6)) << turbidity << " " << altitude_deg;
      before = energy;
    }
  }
}

TEST(Atmosphere, SunIsSeveralTimesAsStrongAsTheSky) {
  for (const double altitude_deg : {30.0, 45.0, 60.0}) {
    const SkyLight light = light_at(altitude_deg);
    const double ratio = direct_irradiance(light) / luminance(sky_irradiance(light));
    EXPECT_GT(ratio, 2.5) << altitude_deg;
    EXPECT_LT(ratio, 7.0) << altitude_deg;
  }
}

// ---- Colours

TEST(Atmosphere, SunReddensAsItSinks) {
  double before = 0.0;
  for (const double altitude_deg : {90.0, 40.0, 20.0, 10.0, 5.0, 2.0, 0.5}) {
    const glm::vec3 sun = light_at(altitude_deg).irradiance;
    const double redness = static_cast<double>(sun.x / sun.z);
    EXPECT_GT(redness, before) << altitude_deg;
    before = redness;
  }
  EXPECT_GT(before, 100.0);
}

// Source: chromaticities of clear skies, x = 0.25 and y = 0.26 about the zenith (CIE 1931), within
// 0.02: S. T. Henderson, Daylight and its Spectrum, 1977.
TEST(Atmosphere, ZenithIsAsBlueAsSkiesAre) {
  const glm::dvec3 rgb(clear_radiance(light_at(40.0), {0, 0, 1}));
  const glm::dmat3 xyz_from_rgb(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722,
                                0.9505);
  const glm::dvec3 xyz = xyz_from_rgb * rgb;
  EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), 0.25, 0.02);
  EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), 0.26, 0.02);
}

TEST(Atmosphere, TwilightIsRedAtTheSunsSideAndBlueAbove) {
  for (const double altitude_deg : {-2.0, -5.0, -8.0}) {
    const SkyLight light = light_at(altitude_deg);
    const glm::vec3 low = clear_radiance(light, sun_direction(0.0, radians(1.0)));
    const glm::vec3 zenith = clear_radiance(light, {0, 0, 1});
    EXPECT_GT(low.x, 1.4f * clear_radiance(light, {0, 0, 1}).x * low.z /
                         clear_radiance(light, {0, 0, 1}).z)
        << altitude_deg;
    EXPECT_GT(zenith.z, 1.5f * zenith.x) << altitude_deg;
    EXPECT_GT(luminance(low), luminance(zenith)) << altitude_deg;
  }
}

// ---- Against paths of light

// The number of paths leaves 1 %. Near the horizon, and on it under the sun, where haze throws
// most light forward, as well as elsewhere.
TEST(Atmosphere, IsAsBrightAsPathsOfLightSay) {
  Workers workers(2);
  struct Case {
    double turbidity, sun_deg, azimuth_deg, elevation_deg;
  };
  for (const Case& c :
       {Case{1.0, 50.0, 0.0, 90.0}, Case{1.0, 50.0, 180.0, 5.0}, Case{1.0, 10.0, 180.0, 30.0},
        Case{2.2, 50.0, 0.0, 90.0}, Case{2.2, 50.0, 120.0, 40.0}, Case{2.2, 50.0, 0.0, 3.0},
        Case{2.2, 20.0, 90.0, 60.0}, Case{2.2, 20.0, 180.0, 5.0}, Case{2.2, 20.0, 0.0, 20.0},
        Case{2.2, 10.0, 180.0, 30.0}, Case{2.2, 5.0, 90.0, 5.0}, Case{5.0, 80.0, 0.0, 2.0},
        Case{5.0, 80.0, 180.0, 10.0}}) {
    const Atmosphere& air = air_of(c.turbidity);
    const glm::dvec3 to_sun(sun_direction(0.0, radians(c.sun_deg)));
    const glm::dvec3 d(sun_direction(radians(c.azimuth_deg), radians(c.elevation_deg)));
    const glm::vec3 ours = sky_radiance(make_sky_table(air, to_sun, 0.0, workers), d);
    for (const int channel : {0, 1, 2}) {
      const double theirs = LightPaths(c.turbidity).radiance(channel, d, to_sun, 30000);
      EXPECT_NEAR(ours[channel] / theirs, 1.0, 0.05)
          << c.turbidity << " " << c.sun_deg << " " << c.azimuth_deg << " " << c.elevation_deg
          << " channel " << channel;
    }
  }
}

// In thick haze under a low sun most light was scattered many times. The number of paths leaves 1
// to 2 %.
TEST(Atmosphere, IsAsBrightInThickHazeAsPathsOfLightSay) {
  Workers workers(2);
  struct Place {
    double azimuth_deg, elevation_deg;
  };
  for (const double turbidity : {5.0, 10.0}) {
    const Atmosphere& air = air_of(turbidity);
    for (const double sun_deg : {5.0, 2.0}) {
      const glm::dvec3 to_sun(sun_direction(0.0, radians(sun_deg)));
      const SkyTable table = make_sky_table(air, to_sun, 0.0, workers);
      for (const Place& p : {Place{0.0, 5.0}, Place{0.0, 12.0}, Place{30.0, 3.0}, Place{90.0, 1.0},
                             Place{0.0, 90.0}, Place{180.0, 30.0}}) {
        const glm::dvec3 d(sun_direction(radians(p.azimuth_deg), radians(p.elevation_deg)));
        const double theirs = LightPaths(turbidity).radiance(1, d, to_sun, 80000);
        EXPECT_NEAR(sky_radiance(table, d).y / theirs, 1.0, 0.05)
            << turbidity << " " << sun_deg << ": " << p.azimuth_deg << " " << p.elevation_deg;
      }
    }
  }
}

// From high up, against the same paths: overhead, at 10 degrees, at eye height and next to the
// dipped horizon, where the air's bending moves what is seen (horizon_sine).
TEST(Atmosphere, IsAsBrightAloftAsPathsOfLightSay) {
  Workers workers(2);
  const Atmosphere& air = air_of(2.2);
  const glm::dvec3 to_sun(sun_direction(0.0, radians(40.0)));
  LightPaths paths(2.2);
  double lost = 0.0;
  for (const double height_m : {1500.0, 10000.0, 40000.0}) {
    const SkyTable table = make_sky_table(air, to_sun, height_m, workers);
    const double radius_m = kEarthRadius_m + height_m;
    const double straight = -std::sqrt(1.0 - std::pow(kEarthRadius_m / radius_m, 2.0));
    const double seen = horizon_sine(height_m);
    for (const double sine : {1.0, 0.17, 0.0, 0.9 * seen}) {
      const double true_sine = straight + (1.0 - straight) * (sine - seen) / (1.0 - seen);
      const auto at = [](double z) {
        return glm::dvec3(std::sqrt(std::max(1.0 - z * z, 0.0)), 0.0, z);
      };
      const double ours = sky_radiance(table, at(sine)).y;
      const double theirs =
          paths.radiance_at_height(1, height_m, at(true_sine), to_sun, 20000, lost);
      EXPECT_NEAR(ours / theirs, 1.0, 0.05) << height_m << " m, " << sine;
    }
  }
}

// The sun low, by angles from the dipped horizon: beside the sun and under it, opposite to it, and
// the air before the sea. The number of paths leaves 1 to 3 %.
TEST(Atmosphere, IsAsBrightAloftUnderALowSunAsPathsOfLightSay) {
  Workers workers(2);
  struct Place {
    double azimuth_deg, over_horizon_deg;
  };
  const Atmosphere& air = air_of(2.2);
  LightPaths paths(2.2);
  for (const double sun_deg : {5.0, 2.0})
    for (const double height_m : {3000.0, 6000.0, 12000.0, 30000.0}) {
      const glm::dvec3 to_sun(sun_direction(0.0, radians(sun_deg)));
      const SkyTable table = make_sky_table(air, to_sun, height_m, workers);
      const double radius_m = kEarthRadius_m + height_m;
      const double straight = -std::sqrt(1.0 - std::pow(kEarthRadius_m / radius_m, 2.0));
      for (const Place& p :
           {Place{90.0, 10.0}, Place{0.0, 5.0}, Place{180.0, 30.0}, Place{180.0, -25.0}}) {
        const double sine = std::sin(std::asin(straight) + radians(p.over_horizon_deg));
        const double part = (sine - straight) / (sine > straight ? 1.0 - straight : 1.0 + straight);
        const double seen = table.horizon_sine;
        const double seen_sine = seen + part * (sine > straight ? 1.0 - seen : 1.0 + seen);
        const auto at = [&](double z) {
          return glm::dvec3(sun_direction(radians(p.azimuth_deg), std::asin(z)));
        };
        const glm::vec3 ours = sky_radiance(table, at(seen_sine));
        glm::dvec3 mine, theirs;
        for (const int c : {0, 1, 2}) {
          double lost = 1.0;
          theirs[c] = paths.radiance_at_height(c, height_m, at(sine), to_sun, 20000, lost);
          mine[c] = double{ours[c]} * (sine > straight ? 1.0 : lost);
          EXPECT_NEAR(mine[c] / theirs[c], 1.0, 0.09)
              << sun_deg << ", " << height_m << " m: " << p.azimuth_deg << " " << p.over_horizon_deg
              << " channel " << c;
        }
        EXPECT_NEAR(luminance(mine) / luminance(theirs), 1.0, 0.05)
            << sun_deg << ", " << height_m << " m: " << p.azimuth_deg << " " << p.over_horizon_deg;
      }
    }
}

// From 50 m to 60 km no step of the tables shows: the logarithm of light bends as little as one of
// air that thins with the height, at angles from the horizon up and down.
TEST(Atmosphere, ChangesSmoothlyWithTheHeight) {
  constexpr double kRatio = 1.05;
  Workers workers(2);
  const Atmosphere& air = air_of(2.2);
  for (const double sun_deg : {40.0, 5.0, 1.0, -8.0}) {
    const glm::dvec3 to_sun(sun_direction(0.0, radians(sun_deg)));
    std::array<std::array<double, 2>, 5> before{};
    int row = 0;
    for (double height_m = 50.0; height_m < 60000.0; height_m *= kRatio, ++row) {
      const SkyTable table = make_sky_table(air, to_sun, height_m, workers);
      const double horizon = std::asin(table.horizon_sine);
      for (std::size_t n = 0; n < before.size(); ++n) {
        const double over_deg = std::array{1.5, 10.0, 60.0, -1.5, -30.0}[n];
        const glm::dvec3 d(sun_direction(radians(60.0), horizon + radians(over_deg)));
        const double here = std::log(luminance(glm::dvec3(sky_radiance(table, d))));
        auto& [last, but_one] = before[n];
        const double bend = row > 1 ? here - 2.0 * last + but_one : 0.0;
        EXPECT_NEAR(bend, 0.0, 0.005 * (1.0 + height_m / 8000.0))
            << sun_deg << ", " << height_m << " m, " << over_deg;
        but_one = last;
        last = here;
      }
    }
  }
}

// Straight down from 40 km, the air's own light is that of the column below: nearly what pure air
// of its depth scatters once from sun and sea, and blue.
TEST(Atmosphere, AirBelowIsBlue) {
  Workers workers(2);
  const Atmosphere air = make_atmosphere(1.5, workers);
  const SkyTable table =
      make_sky_table(air, glm::dvec3(sun_direction(0.0, radians(40.0))), 40000.0, workers);
  const glm::vec3 below = sky_radiance(table, {0, 0, -1});
  const glm::vec3 depth(air.air.rayleigh_per_m * 8000.0);
  const glm::vec3 veil = below * (glm::vec3(1.0f) - glm::exp(-depth));
  EXPECT_GT(veil.z, 3.0f * veil.x);
  EXPECT_GT(veil.z, 1.5f * veil.y);
}

TEST(Atmosphere, ZenithDarkensWithHeight) {
  Workers workers(2);
  const SkyLight sea_level = light_at(40.0);
  double before = luminance(clear_radiance(sea_level, {0, 0, 1}));
  for (const double height_m : {1500.0, 5000.0, 10000.0, 20000.0, 40000.0}) {
    const SkyLight light = sky_light_at_height(sea_level, height_m, workers);
    const double here = luminance(clear_radiance(light, {0, 0, 1}));
    EXPECT_LT(here, 0.85 * before) << height_m;
    before = here;
  }
  EXPECT_LT(before, 0.01 * luminance(clear_radiance(sea_level, {0, 0, 1})));
}

// A low sun is less red from high up, and stands over the sea's edge when it has set below.
TEST(Atmosphere, TheSunSetsLaterAloft) {
  Workers workers(2);
  const SkyLight sea_level = light_at(-1.5);
  const SkyLight light = sky_light_at_height(sea_level, 10000.0, workers);
  EXPECT_GT(light.sun_disc_radiance.y, 0.0f);
  EXPECT_GT(light_at(1.0).disc_radiance.x / light_at(1.0).disc_radiance.z,
            2.0f * sky_light_at_height(light_at(1.0), 40000.0, workers).disc_radiance.x /
                sky_light_at_height(light_at(1.0), 40000.0, workers).disc_radiance.z);
}

// The optical depth of the air overhead, by hand: density times scale height.
TEST(Atmosphere, OverheadLightPassesTheKnownDepth) {
  Workers workers(1);
  const Atmosphere pure = make_atmosphere(1.0, workers);
  const glm::dvec3 depth = pure.air.rayleigh_per_m * 8000.0 + pure.air.ozone_per_m * 15000.0;
  const glm::vec3 passes = transmittance(pure, 0.0, 1.0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(passes[c], std::exp(-depth[c]), 1e-3) << c;
  EXPECT_NEAR(pure.air.rayleigh_per_m.y * 8000.0, 0.0973, 0.012);  // Bucholtz 1995, 550 nm
  const Atmosphere hazy = make_atmosphere(3.0, workers);
  EXPECT_NEAR(std::log(passes.y / transmittance(hazy, 0.0, 1.0).y),
              2.0 * pure.air.rayleigh_per_m.y * 8000.0, 2e-3);
}

// ---- The light that throws shadows

TEST(Atmosphere, HalfOfASettingSunIsHidden) {
  Workers workers(1);
  const Atmosphere& air = air_of(2.2);
  const double r = kSunRadius_rad;
  EXPECT_EQ(disc_transmittance(air, 0.0, -r), glm::vec3(0.0f));
  EXPECT_NEAR(disc_transmittance(air, 0.0, 0.0).x / transmittance(air, 0.0, 0.0).x, 0.5f, 1e-3f);
  EXPECT_NEAR(disc_transmittance(air, 0.0, r).x / transmittance(air, 0.0, r).x, 1.0f, 1e-3f);
}

TEST(Atmosphere, SunAndMoonGiveWayWithoutAStep) {
  double before = illuminance_lx(light_at(1.0, 1.0));
  for (double altitude_deg = 0.9; altitude_deg > -1.0; altitude_deg -= 0.1) {
    const double now = illuminance_lx(light_at(altitude_deg, 1.0));
    EXPECT_NEAR(now / before, 0.95, 0.05) << altitude_deg;
    before = now;
  }
  EXPECT_GT(light_at(0.0, 1.0).to_light.y, 0.0f);  // the sun
  const SkyLight night = light_at(-30.0, 1.0);
  EXPECT_LT(night.to_light.y, 0.0f);  // the moon, opposite
  EXPECT_NEAR(night.to_light.z, 0.5f, 1e-6f);
}

TEST(Atmosphere, IsTheSameOnAnyNumberOfThreads) {
  const auto of = [](int threads) {
    Workers workers(threads);
    return make_atmosphere(2.2, workers);
  };
  const Atmosphere one = of(1), two = of(2), seven = of(7);
  EXPECT_EQ(one.transmittance, two.transmittance);
  EXPECT_EQ(one.multiple, two.multiple);
  EXPECT_EQ(one.multiple, seven.multiple);
}

TEST(Atmosphere, IsFiniteForAnyTurbidityAndDirection) {
  for (const double turbidity : {1.0, 4.0, 10.0})
    for (const double altitude_deg : {-90.0, -7.0, 0.0, 0.1, 3.0, 90.0}) {
      const SkyLight light = light_at(altitude_deg, 1.0, turbidity);
      for (int n = 0; n < 300; ++n) {
        const glm::vec3 d = sun_direction(6.3 * random_uniform(1, 2 * n),
                                          3.1 * random_uniform(1, 2 * n + 1) - 1.55);
        const glm::vec3 radiance = clear_radiance(light, d);
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(radiance[c] > 0.0f && radiance[c] < 1e3f) << n;
      }
      EXPECT_TRUE(std::isfinite(clear_radiance(light, {0, 0, 1}).x));
    }
}

// ---- Which sky a scene has

TEST(SkyModel, AKeyOfTheGradientMakesItOne) {
  EXPECT_FALSE(is_gradient(Sky()));
  Sky sky;
  sky.zenith = glm::vec3(0.5f);
  EXPECT_TRUE(is_gradient(sky));
  Workers workers(1);
  const glm::vec3 overhead = clear_radiance(make_sky_light(sky, workers), {0, 0, 1});
  EXPECT_EQ(overhead, gradient_radiance(sky, {0, 0, 1}));
}

TEST(SkyModel, ExposureFollowsTheLightButNotQuite) {
  double before = 0.0;
  for (const double light : {1e-8, 1e-5, 1e-2, 1.0, 4.0}) {
    const double shown = light * automatic_exposure(light);
    EXPECT_GT(shown, 1.2 * before) << light;
    before = shown;
  }
  EXPECT_LT(before, 5.0);
  EXPECT_GT(1e-8 * automatic_exposure(1e-8), 0.05);
}

}  // namespace
}  // namespace swell::sky
