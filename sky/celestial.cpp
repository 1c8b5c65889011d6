#include "sky/celestial.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "math/elementary.h"

namespace swell::sky {
namespace {

constexpr double kDaysPerCentury = 36525.0;
constexpr double kEarthRadius_km = 6378.14;  // at the equator
constexpr double kAstronomicalUnit_km = 149597870.7;

double sin_deg(double x) { return sin(radians(x)); }
double cos_deg(double x) { return cos(radians(x)); }
double degrees(double rad) { return rad / radians(1.0); }

// In [0, 360).
double wrap_degrees(double x) { return x - 360.0 * std::floor(x / 360.0); }

// So many digits at `at`, less than 0 if there is something else.
int digits_at(std::string_view text, std::size_t at, std::size_t count) {
  int value = 0;
  for (std::size_t i = at; i < at + count; ++i) {
    if (text[i] < '0' || text[i] > '9') return -1;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

int days_in_month(int year, int month) {
  constexpr std::array kDays = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leaps = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && leaps ? 1 : 0);
}

// Counts the days from noon of 2000-01-01 to 0 h of a date of the Gregorian calendar. Source:
// Meeus, equation 7.1.
double days_of_date(int year, int month, int day) {
  const int y = month > 2 ? year : year - 1, m = month > 2 ? month : month + 12;
  const int century = y / 100;
  const double julian_day = std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1)) + day +
                            (2 - century + century / 4) - 1524.5;
  return julian_day - 2451545.0;
}

// Terrestrial time is ahead of universal time: 64 s in 2000, within a minute of that from 1900 to
// 2100. The moon goes 0.01 degrees in a minute.
double centuries(double days) { return (days + 64.0 / 86400.0) / kDaysPerCentury; }

// With the largest term of nutation, as the places below have it. Meeus, chapters 22 and 25.
double obliquity_deg(double t) {
  return 23.439291 - 0.0130042 * t + 0.00256 * cos_deg(125.04 - 1934.136 * t);
}

EquatorialPlace from_ecliptic(double longitude_deg, double latitude_deg, double t) {
  const double tilt = obliquity_deg(t);
  const double sin_l = sin_deg(longitude_deg), cos_l = cos_deg(longitude_deg);
  const double sin_b = sin_deg(latitude_deg), cos_b = cos_deg(latitude_deg);
  const double x = cos_b * cos_l;
  const double y = cos_deg(tilt) * cos_b * sin_l - sin_deg(tilt) * sin_b;
  const double z = sin_deg(tilt) * cos_b * sin_l + cos_deg(tilt) * sin_b;
  return {wrap_degrees(degrees(atan2(y, x))), degrees(atan2(z, std::sqrt(x * x + y * y)))};
}

glm::dvec3 direction_of(const EquatorialPlace& place) {
  const double across = cos_deg(place.declination_deg);
  return {across * cos_deg(place.right_ascension_deg), across * sin_deg(place.right_ascension_deg),
          sin_deg(place.declination_deg)};
}

}  // namespace

std::optional<double> parse_time_utc(std::string_view text) {
  // 2026-06-21T12:00:00Z
  if (text.size() < 20 || text.size() > 30 || text.back() != 'Z') return std::nullopt;
  if (text[4] != '-' || text[7] != '-' || text[10] != 'T' || text[13] != ':' || text[16] != ':')
    return std::nullopt;
  const int year = digits_at(text, 0, 4), month = digits_at(text, 5, 2);
  const int day = digits_at(text, 8, 2), hour = digits_at(text, 11, 2);
  const int minute = digits_at(text, 14, 2);
  if (year < 1900 || year > 2100 || month < 1 || month > 12 || day < 1 ||
      day > days_in_month(year, month) || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
      digits_at(text, 17, 2) < 0)
    return std::nullopt;
  double second = 0.0;
  const char *const begin = text.data() + 17, *const end = text.data() + text.size() - 1;
  const auto [rest, error] = std::from_chars(begin, end, second, std::chars_format::fixed);
  if (error != std::errc() || rest != end || second >= 60.0) return std::nullopt;
  return days_of_date(year, month, day) + (hour + (minute + second / 60.0) / 60.0) / 24.0;
}

EquatorialPlace sun_place(double days) {
  const double t = centuries(days);
  const double mean_longitude = 280.46646 + (36000.76983 + 0.0003032 * t) * t;
  const double anomaly = 357.52911 + (35999.05029 - 0.0001537 * t) * t;
  const double eccentricity = 0.016708634 - (0.000042037 + 0.0000001267 * t) * t;
  const double centre = (1.914602 - (0.004817 + 0.000014 * t) * t) * sin_deg(anomaly) +
                        (0.019993 - 0.000101 * t) * sin_deg(2.0 * anomaly) +
                        0.000289 * sin_deg(3.0 * anomaly);
  const double distance = 1.000001018 * (1.0 - eccentricity * eccentricity) /
                          (1.0 + eccentricity * cos_deg(anomaly + centre));
  const double apparent =
      mean_longitude + centre - 0.00569 - 0.00478 * sin_deg(125.04 - 1934.136 * t);
  EquatorialPlace place = from_ecliptic(apparent, 0.0, t);
  place.distance_km = distance * kAstronomicalUnit_km;
  return place;
}

EquatorialPlace moon_place(double days) {
  const double t = centuries(days);
  const double anomaly = 135.0 + 477198.87 * t, evection = 259.3 - 413335.36 * t;
  const double variation = 235.7 + 890534.22 * t, twice = 269.9 + 954397.74 * t;
  const double longitude = 218.32 + 481267.881 * t + 6.29 * sin_deg(anomaly) -
                           1.27 * sin_deg(evection) + 0.66 * sin_deg(variation) +
                           0.21 * sin_deg(twice) - 0.19 * sin_deg(357.5 + 35999.05 * t) -
                           0.11 * sin_deg(186.5 + 966404.03 * t);
  const double latitude =
      5.13 * sin_deg(93.3 + 483202.02 * t) + 0.28 * sin_deg(228.2 + 960400.89 * t) -
      0.28 * sin_deg(318.3 + 6003.15 * t) - 0.17 * sin_deg(217.6 - 407332.21 * t);
  const double parallax = 0.9508 + 0.0518 * cos_deg(anomaly) + 0.0095 * cos_deg(evection) +
                          0.0078 * cos_deg(variation) + 0.0028 * cos_deg(twice);
  EquatorialPlace place = from_ecliptic(longitude, latitude, t);
  place.distance_km = kEarthRadius_km / sin_deg(parallax);
  return place;
}

double sidereal_degrees(double days) {
  const double t = days / kDaysPerCentury;
  return wrap_degrees(280.46061837 + 360.98564736629 * days + 0.000387933 * t * t);
}

glm::dmat3 stars_from_world(double sidereal_rad, double latitude_rad) {
  const double s = sin(sidereal_rad), c = cos(sidereal_rad);
  const glm::dvec3 east(-s, c, 0.0);
  const double sin_latitude = sin(latitude_rad), cos_latitude = cos(latitude_rad);
  const glm::dvec3 up(cos_latitude * c, cos_latitude * s, sin_latitude);
  return {east, glm::cross(up, east), up};
}

HorizontalPlace horizontal_place(const EquatorialPlace& place, double days, double latitude_rad,
                                 double longitude_rad) {
  const double sidereal_rad = radians(sidereal_degrees(days)) + longitude_rad;
  const glm::dvec3 seen =
      glm::transpose(stars_from_world(sidereal_rad, latitude_rad)) * direction_of(place);
  return {atan2(seen.x, seen.y), atan2(seen.z, std::sqrt(seen.x * seen.x + seen.y * seen.y))};
}

double refraction_rad(double elevation_rad) {
  const double h = degrees(elevation_rad);
  if (h > 85.0) return 0.0;
  const double tangent = tan(elevation_rad);
  double seconds = 0.0;
  if (h > 5.0) {
    const double t3 = tangent * tangent * tangent;
    seconds = 58.1 / tangent - 0.07 / t3 + 0.000086 / (t3 * tangent * tangent);
  } else if (h > -1.0) {
    seconds = 1735.0 + h * (-518.2 + h * (103.4 + h * (-12.79 + h * 0.711)));
  } else {
    seconds = -41.32 / tangent;  // goes on from there, and falls
  }
  return radians(seconds / 3600.0);
}

double moon_lit_part(const EquatorialPlace& sun, const EquatorialPlace& moon) {
  const glm::dvec3 to_sun = sun.distance_km * direction_of(sun);
  const glm::dvec3 to_moon = moon.distance_km * direction_of(moon);
  const double cos_phase = glm::dot(glm::normalize(to_sun - to_moon), glm::normalize(-to_moon));
  return std::clamp(0.5 + 0.5 * cos_phase, 0.0, 1.0);
}

void place_sun_and_moon(double days, Sky& sky) {
  const EquatorialPlace sun = sun_place(days), moon = moon_place(days);
  const auto seen = [&](const EquatorialPlace& place) {
    HorizontalPlace at = horizontal_place(place, days, sky.latitude_rad, sky.longitude_rad);
    // From the earth's surface, and through the air.
    at.elevation_rad -= kEarthRadius_km / place.distance_km * cos(at.elevation_rad);
    at.elevation_rad += refraction_rad(at.elevation_rad);
    return at;
  };
  const HorizontalPlace sun_at = seen(sun), moon_at = seen(moon);
  sky.sun_azimuth_rad = sun_at.azimuth_rad;
  sky.sun_elevation_rad = sun_at.elevation_rad;
  sky.moon_azimuth_rad = moon_at.azimuth_rad;
  sky.moon_elevation_rad = moon_at.elevation_rad;
  sky.moon_phase = moon_lit_part(sun, moon);
}

}  // namespace swell::sky
