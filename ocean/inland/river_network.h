// The rivers of a scene as one network: who joins whom, how much water flows where, how high it
// stands.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ocean/inland/river.h"
#include "ocean/inland/river_course.h"
#include "ocean/inland/segment_index.h"

namespace swell::ocean {

inline constexpr std::string_view kRiverKey = "river", kLakeKey = "lake";

// Where a river's end meets another river.
struct Joint {
  std::size_t river = 0, on = 0;  // `river` joins `on` or leaves it
  bool joins = true;              // false: it leaves
  double s_m = 0.0;               // on the other's course
  bool on_left = true;            // of the other
  double discharge_m2_s = 0.0;    // through it, over 0
};

// The water at a place, of all channels and lakes near it.
struct WaterPlace {
  double level_m = 0.0;
  double bed_m = 0.0;        // the ground that rivers dig
  double outside_m = 1e30;   // beyond the water's edge; negative in the water
  double width_m = 0.0;      // of the river there, 0 in a lake
  double depth_m = 0.0;      // in the river's middle; of a lake that is dug
  double fall = 0.0;         // of the surface, along the river
  double sea_share = 0.0;    // 1: the sea's surface goes on here
  double speed_share = 1.0;  // of what the flow is where lakes and the sea do not slow it
  bool in_lake = false;
};

// Read-only after it is made.
class RiverNetwork {
 public:
  // Throws RiverError (ocean/inland/river.h), whose keys are "river[0].path_m" and the like: what
  // make_course() throws; names that are none, rivers joined in a circle, ends that do not touch
  // what they join, levels that do not meet, outlines that cross themselves.
  RiverNetwork(std::span<const River> rivers, std::span<const Lake> lakes);

  const std::vector<Course>& courses() const { return courses_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<Lake>& lakes() const { return lakes_; }
  // Water through a river at a place of its course [m^2/s]: speed times width, as the flow is the
  // same at all depths.
  double discharge_m2_s(std::size_t river, double s_m) const;

  // The water near p; nothing further than margin_m() from any river or outlined lake.
  std::optional<WaterPlace> water_near(glm::dvec2 p) const;
  double margin_m() const { return margin_m_; }
  double least_width_m() const { return least_width_m_; }  // infinite without rivers

  // Corners of a box around all water but filled lakes, with its margin; low > high: there is none.
  glm::dvec2 low() const { return low_; }
  glm::dvec2 high() const { return high_; }

 private:
  class NearWater;
  struct CourseSegment {
    std::uint32_t river, node;
  };
  double discharge_at_start(std::size_t river, int depth) const;
  double discharge_at(std::size_t river, double s_m, int depth) const;
  void find_joints();
  void set_all_levels();
  void set_sea_shares();
  void index_segments();

  std::vector<River> rivers_;
  std::vector<Lake> lakes_;
  std::vector<Course> courses_;
  std::vector<Joint> joints_;
  std::vector<CourseSegment> of_segment_;
  SegmentIndex index_;
  double margin_m_ = 60.0, least_width_m_ = 1e30;
  glm::dvec2 low_{1e30}, high_{-1e30};
};

// Metres outside an outline (two crossings of which with itself are none), negative inside.
double outside_outline(std::span<const glm::dvec2> outline, glm::dvec2 p);

}  // namespace swell::ocean
