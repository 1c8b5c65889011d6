// The keys of [[river]] and [[lake]].
#include "scene/file/parameter_row.h"
#include "scene/file/parameters.h"

namespace swell::scene {
namespace {

#define SWELL_FIELD(PATH) \
  [](auto& object) -> auto& { return object.PATH; }

}  // namespace

std::vector<Parameter<ocean::River>> river_parameters() {
  using RiverRow = Row<ocean::River>;
  Parameter<ocean::River> surface = RiverRow::list(
      "surface_m", {-1000, 10000, "m"}, 1, kMaxRiverPoints, SWELL_FIELD(surface_m),
      "height of the surface at each point, never rising; at the ends that of what they join takes "
      "its place, at the sea 0");
  surface.is_set = [](const ocean::River& river) { return !river.surface_m.empty(); };
  return {
      RiverRow::optional_text("name", SWELL_FIELD(name), "by which others join it"),
      RiverRow::optional_text("from", SWELL_FIELD(from),
                              "the river that it leaves, or the lake; none: it has a source"),
      RiverRow::optional_text("into", SWELL_FIELD(into),
                              "the river that it joins, or the lake; none: the sea"),
      RiverRow::points("path_m", {-1e6, 1e6, "m"}, 2, kMaxRiverPoints, SWELL_FIELD(path_m),
                       "its middle from the source to the mouth, as points [east, north]; ends lie "
                       "in what they join"),
      RiverRow::list("width_m", {1, 2000, "m"}, 1, kMaxRiverPoints, SWELL_FIELD(width_m),
                     "of the water at each point, or one number for all"),
      RiverRow::list("depth_m", {0.1, 100, "m"}, 1, kMaxRiverPoints, SWELL_FIELD(depth_m),
                     "in the middle, likewise; the bed is dug into the terrain"),
      surface,
      RiverRow::number("speed_mps", {0, 10, "m/s"}, SWELL_FIELD(speed_mps),
                       "of a river with a source: the mean at its first point"),
  };
}

std::vector<Parameter<ocean::Lake>> lake_parameters() {
  using LakeRow = Row<ocean::Lake>;
  return {
      LakeRow::optional_text("name", SWELL_FIELD(name), "by which rivers join it"),
      LakeRow::number("level_m", {-1000, 10000, "m"}, SWELL_FIELD(level_m), "of its surface"),
      LakeRow::points("outline_m", {-1e6, 1e6, "m"}, 3, kMaxRiverPoints, SWELL_FIELD(outline_m),
                      "points [east, north] around it; none: it fills the land up to its level"),
      LakeRow::vector("position_m", {-1e6, 1e6, "m"}, SWELL_FIELD(position_m),
                      "a place in a lake that fills the land: east, north"),
      LakeRow::number("depth_m", {0, 100, "m"}, SWELL_FIELD(depth_m),
                      "the ground in the outline is dug so deep; 0: it stays as it is"),
  };
}

#undef SWELL_FIELD

}  // namespace swell::scene
