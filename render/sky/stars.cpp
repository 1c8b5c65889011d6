#include "render/sky/stars.h"

#include "math/elementary.h"
#include "math/smoothstep.h"
#include "render/sky/sky_maps.h"
#include "render/world/world_state.h"
#include "sky/celestial.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

// The illuminance of a star of magnitude 6 [10 000 lx]: magnitude 0 is 2.54e-6 lx.
// Source: C. W. Allen, Astrophysical Quantities, 1973, section 95.
constexpr double kFaintest = 2.54e-10 * 3.9811e-3;
// Sines of the sun's elevation: between them stars come out.
constexpr double kDay = -0.035, kDusk = -0.1;
constexpr double kSiderealPerDay = 1.00273790935;

}  // namespace

Stars make_stars(const WorldState& world, double t_s, PartSet without) {
  const scene::Sky& sky = world.scene.sky;
  Stars stars;
  const double night = smoothstep<double>(kDay, kDusk, sky.sun_direction.z);
  stars.on = night > 0.0 && !sky::is_gradient(sky) && !without.has(Part::kStars);
  if (!stars.on) return stars;
  const double days = sky::parse_time_utc(sky.time_utc).value_or(0.0);
  const double turned = 2.0 * kPi * kSiderealPerDay * t_s / 86400.0;
  const double sidereal_rad = radians(sky::sidereal_degrees(days)) + sky.longitude_rad + turned;
  stars.from_world = glm::mat3(sky::stars_from_world(sidereal_rad, sky.latitude_rad));
  stars.brightness = static_cast<float>(night * kFaintest) * world.sky->stored_exposure;
  return stars;
}

}  // namespace swell::render
