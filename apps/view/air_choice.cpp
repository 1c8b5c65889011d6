#include "apps/view/air_choice.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "sky/celestial.h"
#include "sky/sky_light.h"

namespace swell::view {
namespace {

constexpr std::string_view kMidsummer = "2026-06-21T12:00:00Z";
constexpr int kDateLength = 11;         // "2026-06-21T"
constexpr double kKoschmieder = 3.912;  // ln 50, which B = 3.912 / V has

double hour_of(std::string_view time_utc) {
  const double days = sky::parse_time_utc(time_utc).value_or(0.0) + 0.5;  // from midnight
  return 24.0 * (days - std::floor(days));
}

std::string time_at(std::string_view day, double hour_utc) {
  const int minutes = std::clamp(static_cast<int>(std::lround(60.0 * hour_utc)), 0, 24 * 60 - 1);
  return fmt::format("{}{:02}:{:02}:00Z", day.substr(0, kDateLength), minutes / 60, minutes % 60);
}

void choose_sun(const AirChoice& choice, scene::Sky& sky) {
  if (choice.by_time) {
    sky.time_utc = time_at(sky.time_utc.empty() ? kMidsummer : sky.time_utc, choice.hour_utc);
    sky::place_sun_and_moon(*sky::parse_time_utc(sky.time_utc), sky);
  } else {
    sky.time_utc.clear();
    sky.sun_azimuth_rad = choice.sun_azimuth_rad;
    sky.sun_elevation_rad = choice.sun_elevation_rad;
  }
  sky.sun_direction = sky::sun_direction(sky.sun_azimuth_rad, sky.sun_elevation_rad);
}

void choose_fog(const AirChoice& choice, scene::FoggyAir& air) {
  air.attenuation_per_m.reset();
  air.visibility_m.reset();
  if (choice.fog) air.visibility_m = choice.visibility_m;
}

bool same_sun(const AirChoice& a, const AirChoice& b) {
  return a.by_time == b.by_time && (a.by_time ? a.hour_utc == b.hour_utc
                                              : a.sun_azimuth_rad == b.sun_azimuth_rad &&
                                                    a.sun_elevation_rad == b.sun_elevation_rad);
}

}  // namespace

AirChoice air_choice(const scene::Scene& scene) {
  const scene::Sky& sky = scene.sky;
  AirChoice choice = {.by_time = !sky.time_utc.empty(),
                      .sun_azimuth_rad = sky.sun_azimuth_rad,
                      .sun_elevation_rad = sky.sun_elevation_rad,
                      .thin_cover = sky.cloud_cover,
                      .clouds = scene.clouds.kind,
                      .cover = scene.clouds.cover};
  if (choice.by_time) choice.hour_utc = hour_of(sky.time_utc);
  if (const auto& per_m = scene.air.attenuation_per_m) {
    choice.fog = true;
    choice.visibility_m = kKoschmieder / std::max(static_cast<double>(per_m->y), 1e-6);
  } else if (scene.air.visibility_m) {
    choice.fog = true;
    choice.visibility_m = *scene.air.visibility_m;
  }
  return choice;
}

scene::Scene with_air(scene::Scene scene, const AirChoice& choice) {
  const AirChoice own = air_choice(scene);
  if (!same_sun(choice, own)) choose_sun(choice, scene.sky);
  if (choice.fog != own.fog || choice.visibility_m != own.visibility_m)
    choose_fog(choice, scene.air);
  scene.sky.cloud_cover = choice.thin_cover;
  scene.clouds.kind = choice.clouds;
  scene.clouds.cover = choice.cover;
  return scene;
}

}  // namespace swell::view
