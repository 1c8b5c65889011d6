// Keys of [sky], [clouds] and [[clouds.cumulus]].
#include <array>

#include "scene/file/parameter_row.h"
#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

using Kind = ParameterKind;
using SceneRow = Row<Scene>;

struct SkyModelName {
  using enum SkyModel;
  static constexpr auto words =
      enum_words<SkyModel>({{kAtmosphere, "atmosphere"}, {kGradient, "gradient"}});
  auto& operator()(auto& scene) const { return scene.sky.model; }
};

struct CloudKindName {
  using enum CloudKind;
  static constexpr auto words =
      enum_words<CloudKind>({{kNone, "none"}, {kLayer, "layer"}, {kPlaced, "placed"}});
  auto& operator()(auto& scene) const { return scene.clouds.kind; }
};

struct CloudRaysName {
  using enum CloudRays;
  static constexpr auto words = enum_words<CloudRays>({{kVolume, "volume"}, {kRays, "rays"}});
  auto& operator()(auto& scene) const { return scene.clouds.rays; }
};

#define SWELL_FIELD(PATH) \
  [](auto& object) -> auto& { return object.PATH; }

}  // namespace

std::vector<Parameter<Scene>> sky_parameters() {
  return {
      SceneRow::angle("sky.sun_azimuth_deg", {-360, 360, "deg"}, SWELL_FIELD(sky.sun_azimuth_rad),
                      "where the sun stands, clockwise from north"),
      SceneRow::angle("sky.sun_elevation_deg", {-90, 90, "deg"}, SWELL_FIELD(sky.sun_elevation_rad),
                      "above the horizon"),
      SceneRow::choice("sky.model", SkyModelName{},
                       "light of sun, moon and stars in the earth's air; or a gradient painted "
                       "from the keys below, each of which makes it one"),
      SceneRow::number("sky.turbidity", {1, 10}, SWELL_FIELD(sky.turbidity),
                       "haze: optical depth over that of pure air"),
      SceneRow::number("sky.moon_phase", {0, 1}, SWELL_FIELD(sky.moon_phase),
                       "lit part of the moon's disc"),
      SceneRow::optional_angle("sky.moon_azimuth_deg", {-360, 360, "deg"},
                               SWELL_FIELD(sky.moon_azimuth_rad),
                               "clockwise from north; opposite the sun if "
                               "left out"),
      SceneRow::optional_angle("sky.moon_elevation_deg", {-90, 90, "deg"},
                               SWELL_FIELD(sky.moon_elevation_rad),
                               "above the horizon; as far as the sun is below it if left out"),
      SceneRow::optional_text(
          "sky.time_utc", SWELL_FIELD(sky.time_utc),
          "\"2026-06-21T12:00:00Z\", 1900 to 2100: when sun and moon stand, "
          "and the moon is lit, as they are at t = 0; excludes their five keys"),
      SceneRow::angle("sky.latitude_deg", {-90, 90, "deg"}, SWELL_FIELD(sky.latitude_rad),
                      "of the place, north positive; of `time_utc` and the stars"),
      SceneRow::angle("sky.longitude_deg", {-180, 180, "deg"}, SWELL_FIELD(sky.longitude_rad),
                      "of the place, east positive"),
      SceneRow::optional_vector("sky.sun_radiance", {0, 1000}, SWELL_FIELD(sky.sun_radiance),
                                "of a gradient: linear RGB, strength of direct sunlight, 1 if "
                                "left out"),
      SceneRow::optional_vector("sky.zenith", {0, 2}, SWELL_FIELD(sky.zenith),
                                "of a gradient: linear RGB radiance overhead; at most "
                                "7.66 times `horizon`; [0.1, 0.25, 0.6] if left out"),
      SceneRow::optional_vector(
          "sky.horizon", {0, 1.7}, SWELL_FIELD(sky.horizon),
          "of a gradient: linear RGB radiance 1 degree above the horizon; below "
          "it the gradient goes on, to 1.15 `horizon` - 0.15 `zenith`; [0.65, 0.75, 0.85] if left "
          "out"),
      SceneRow::number("sky.haze_distance_m", {10, 1e7, "m"}, SWELL_FIELD(sky.haze_distance_m),
                       "at sea level 1/e of the contrast is left at this range"),
      SceneRow::number("sky.haze_height_m", {10, 1e7, "m"}, SWELL_FIELD(sky.haze_height_m),
                       "where 1/e of the haze is left; 1e7: the same at all heights"),
      SceneRow::number("sky.cloud_cover", {0, 1}, SWELL_FIELD(sky.cloud_cover),
                       "part of the sky; 1 is overcast"),
      SceneRow::integer("sky.cloud_seed", Kind::kInteger, {0, kMaxSeed},
                        SWELL_FIELD(sky.cloud_seed), "another number, other clouds"),
      SceneRow::optional_number(
          "sky.exposure", {1e-6, 1e9}, SWELL_FIELD(sky.exposure),
          "multiplies radiance, in 10 000 cd/m^2, or a gradient's own unit; if left out it follows "
          "from the sky's light, and is 1 for a gradient"),
  };
}

std::vector<Parameter<Scene>> cloud_parameters() {
  return {
      SceneRow::choice("clouds.kind", CloudKindName{},
                       "volumetric clouds: none, a layer to the horizon, or those of "
                       "[[clouds.cumulus]]; `sky.cloud_cover` is of another, thin layer above"),
      SceneRow::number("clouds.base_m", {50, 12000, "m"}, SWELL_FIELD(clouds.base_m),
                       "height of their flat lower side"),
      SceneRow::number("clouds.top_m", {100, 20000, "m"}, SWELL_FIELD(clouds.top_m),
                       "height that the tallest of a layer reach, 100 m to 8000 m over the base"),
      SceneRow::number("clouds.cover", {0, 1}, SWELL_FIELD(clouds.cover),
                       "of a layer: part of the plane that lies under clouds"),
      SceneRow::number("clouds.size_m", {300, 20000, "m"}, SWELL_FIELD(clouds.size_m),
                       "of a layer: length of its largest forms, about from cloud to cloud; it "
                       "repeats itself after 8 of them"),
      SceneRow::number("clouds.extinction_per_m", {0.001, 1, "1/m"},
                       SWELL_FIELD(clouds.extinction_per_m),
                       "light lost a metre inside clouds; cumulus have 0.02 to 0.1"),
      SceneRow::number("clouds.towers", {0, 1}, SWELL_FIELD(clouds.towers),
                       "of a layer: 0 makes tops of much the same height, 1 a few that tower"),
      SceneRow::number("clouds.raggedness", {0, 1}, SWELL_FIELD(clouds.raggedness),
                       "how deep small forms cut into the edges"),
      SceneRow::number("clouds.threshold", {0, 0.9}, SWELL_FIELD(clouds.threshold),
                       "cuts off what is thinner than this part of the full density"),
      SceneRow::number("clouds.wind_factor", {0, 5}, SWELL_FIELD(clouds.wind_factor),
                       "how much faster they drift than the wind at 10 m"),
      SceneRow::number("clouds.change_mps", {0, 20, "m/s"}, SWELL_FIELD(clouds.change_mps),
                       "how fast small forms rise through their edges"),
      SceneRow::choice("clouds.rays", CloudRaysName{},
                       "how sunlight is found in them: in a volume of depths towards the sun, or "
                       "along a second ray from each sample, which takes several times as long"),
      SceneRow::plain<bool>("clouds.powder", Kind::kBoolean, SWELL_FIELD(clouds.powder),
                            "darkens edges on the sun's side, for the look; it loses light"),
      SceneRow::integer("clouds.seed", Kind::kInteger, {0, kMaxSeed}, SWELL_FIELD(clouds.seed),
                        "another number, other clouds"),
  };
}

std::vector<Parameter<Cumulus>> cumulus_parameters() {
  using CumulusRow = Row<Cumulus>;
  return {
      CumulusRow::vector("position_m", {-20000, 20000, "m"}, SWELL_FIELD(position_m),
                         "of its middle at t = 0: east, north"),
      CumulusRow::number("width_m", {200, 10000, "m"}, SWELL_FIELD(width_m), "across"),
      CumulusRow::number("height_m", {100, 8000, "m"}, SWELL_FIELD(height_m),
                         "of its top over `base_m`"),
      CumulusRow::integer("lobes", Kind::kInteger, {0, 64}, SWELL_FIELD(lobes),
                          "perturbations of its form; 0: an ellipsoid"),
      CumulusRow::integer("seed", Kind::kInteger, {0, kMaxSeed}, SWELL_FIELD(seed),
                          "another number, other lobes"),
  };
}

#undef SWELL_FIELD

}  // namespace swell::scene
