// Sun, moon and stars against published examples.
#include "sky/celestial.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swell::sky {
namespace {

double degrees(double rad) { return rad * 57.295779513082323; }

double days_at(const char* text) {
  const auto days = parse_time_utc(text);
  EXPECT_TRUE(days) << text;
  return days.value_or(0.0);
}

TEST(Celestial, DaysBeginAtNoonOf2000) {
  EXPECT_EQ(days_at("2000-01-01T12:00:00Z"), 0.0);
  EXPECT_EQ(days_at("1987-04-10T00:00:00Z"), 2446895.5 - 2451545.0);
  EXPECT_EQ(days_at("1999-12-31T12:00:00Z"), -1.0);
  EXPECT_NEAR(days_at("2024-02-29T18:30:15.25Z"), 8825.0 + 0.25 + 1815.25 / 86400.0, 1e-9);
}

TEST(Celestial, OtherTextIsNoTime) {
  for (const char* const text :
       {"", "2000-01-01", "2000-01-01T12:00:00", "2000-13-01T12:00:00Z", "2023-02-29T00:00:00Z",
        "1899-12-31T00:00:00Z", "2101-01-01T00:00:00Z", "2000-01-01T24:00:00Z",
        "2000-01-01T00:60:00Z", "2000-01-01T00:00:60Z", "2000-01-01T00:00:0xZ",
        "2000-01-01 12:00:00Z", "2000-01-01T12:00:-1Z", "2000-01-01T12:00:1e1Z"})
    EXPECT_FALSE(parse_time_utc(text)) << text;
}

// Meeus, example 12.a.
TEST(Celestial, SiderealTimeIsMeeuss) {
  EXPECT_NEAR(sidereal_degrees(days_at("1987-04-10T00:00:00Z")), 197.693195, 1e-5);
  EXPECT_NEAR(sidereal_degrees(days_at("1987-04-10T19:21:00Z")), 128.7378734, 1e-5);
}

// Meeus, example 25.a (terrestrial time, which is 59 s ahead of universal time then).
TEST(Celestial, SunIsMeeuss) {
  const EquatorialPlace sun = sun_place(days_at("1992-10-12T23:59:01Z"));
  EXPECT_NEAR(sun.right_ascension_deg, 198.38083, 0.003);
  EXPECT_NEAR(sun.declination_deg, -7.78507, 0.003);
  EXPECT_NEAR(sun.distance_km / 149597870.7, 0.99766, 1e-4);
}

// Meeus, example 47.a, by formulae that are right to 0.3 degrees in longitude and 0.2 in latitude.
TEST(Celestial, MoonIsNearMeeuss) {
  const EquatorialPlace moon = moon_place(days_at("1992-04-11T23:59:01Z"));
  EXPECT_NEAR(moon.right_ascension_deg, 134.688470, 0.35);
  EXPECT_NEAR(moon.declination_deg, 13.768368, 0.3);
  EXPECT_NEAR(moon.distance_km, 368409.7, 1500.0);
}

// Meeus, example 48.a: the same night.
TEST(Celestial, MoonsPhaseIsMeeuss) {
  const double days = days_at("1992-04-11T23:59:01Z");
  EXPECT_NEAR(moon_lit_part(sun_place(days), moon_place(days)), 0.6786, 0.005);
}

// I. Reda, A. Andreas, Solar Position Algorithm for Solar Radiation Applications, 2003, table A5.1:
// topocentric zenith 50.11162 degrees at 820 mbar and 11 degrees Celsius, azimuth 194.34024.
TEST(Celestial, SunStandsWhereItWasOverGolden) {
  Sky sky;
  sky.latitude_rad = radians(39.742476);
  sky.longitude_rad = radians(-105.1786);
  place_sun_and_moon(days_at("2003-10-17T19:30:30Z"), sky);
  EXPECT_NEAR(degrees(sky.sun_elevation_rad), 90.0 - 50.11162, 0.02);
  const double azimuth = degrees(sky.sun_azimuth_rad);
  EXPECT_NEAR(azimuth < 0.0 ? azimuth + 360.0 : azimuth, 194.34024, 0.02);
}

// The noon sun of solstices and equinoxes stands as high as latitude and tilt say.
TEST(Celestial, NoonSunOfTheSeasons) {
  const struct {
    const char* time;
    double declination_deg;
  } days[] = {{"2024-06-20T20:51:00Z", 23.436},
              {"2024-12-21T09:20:00Z", -23.436},
              {"2024-03-20T03:06:00Z", 0.0},
              {"2024-09-22T12:44:00Z", 0.0}};
  for (const auto& day : days)
    EXPECT_NEAR(sun_place(days_at(day.time)).declination_deg, day.declination_deg, 0.005);
}

// Times of the Astronomical Almanac: the sun's upper rim at the horizon, seen through the air, when
// its middle seems to stand a quarter of a degree below.
TEST(Celestial, SunSetsInGreenwichWhenItDid) {
  Sky sky;
  sky.latitude_rad = radians(51.4779);
  place_sun_and_moon(days_at("2024-06-20T20:21:30Z"), sky);
  EXPECT_NEAR(degrees(sky.sun_elevation_rad), -0.267, 0.1);
}

TEST(Celestial, SunOfTheSouthStandsInTheNorth) {
  Sky sky;
  sky.latitude_rad = radians(-33.9);
  sky.longitude_rad = radians(18.4);
  place_sun_and_moon(days_at("2025-01-15T10:56:00Z"), sky);
  EXPECT_NEAR(degrees(sky.sun_azimuth_rad), 0.0, 2.5);
  EXPECT_GT(degrees(sky.sun_elevation_rad), 75.0);
}

TEST(Celestial, RefractionIsThatOfTheHorizon) {
  EXPECT_NEAR(degrees(refraction_rad(0.0)), 1735.0 / 3600.0, 1e-9);
  EXPECT_NEAR(degrees(refraction_rad(radians(45.0))), 58.1 / 3600.0, 1e-4);
  EXPECT_EQ(refraction_rad(radians(90.0)), 0.0);
  for (const double at_deg : {5.0, -1.0, 85.0})
    EXPECT_NEAR(refraction_rad(radians(at_deg - 1e-6)), refraction_rad(radians(at_deg + 1e-6)),
                radians(0.01));
}

// The pole stands in the north as high as the latitude; a day of stars turns them once.
TEST(Celestial, StarsTurnAboutThePole) {
  const double latitude = radians(50.0);
  for (const double turned : {0.0, 1.0, 4.0}) {
    const glm::dvec3 pole = stars_from_world(turned, latitude) *
                            glm::dvec3(0.0, std::cos(latitude), std::sin(latitude));
    EXPECT_NEAR(glm::distance(pole, glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-12);
  }
  // What is due south goes west: to the right ascension that a later sidereal time is.
  const glm::dvec3 south = stars_from_world(0.5, 0.0) * glm::dvec3(0.0, 0.0, 1.0);
  EXPECT_NEAR(std::atan2(south.y, south.x), 0.5, 1e-12);
}

}  // namespace
}  // namespace swell::sky
