// Waves and foam of what disturbs the water: wakes of hulls, rings of drops and footsteps, the
// wind of rotors. A function of the list of disturbances and the time: there are no steps in time,
// so that any frame alone is the frame in a sequence. Costs by what is there now, at most by
// kMostWakeWindows.
//
// Land stops them: there are none where it lies between the water and what disturbs it
// (wake_lee.h). Not counted: the sea's own waves and currents, which would bend and carry wakes;
// surface tension, which holds ripples shorter than 2 cm together; what land throws back.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "math/parallel.h"
#include "ocean/spectrum/fft.h"
#include "ocean/wakes/wake_modes.h"
#include "ocean/wakes/wake_sources.h"
#include "terrain/shore_map.h"

namespace swell::ocean {

// Fills `frame` with both lists' waves at t_s, finite. Allocates nothing once it has been filled
// with as much. A hull's window takes 0.6 to 0.8 ms on one thread, that of a ring 0.3 ms and 0.02
// ms for each ring more; without disturbances nothing. Waves steeper than kMostWakeSlope are laid
// down. shore: of the land; null: there is none. It has to outlive a frame that waits to be asked.
void advance_wakes(std::span<const Disturbance> some, std::span<const Disturbance> others,
                   double gravity_mps2, double t_s, WakeFrame& frame, Workers& workers,
                   const terrain::ShoreMap* shore = nullptr, MakeWakes when = MakeWakes::kNow);

// For those who read a window's fields themselves: makes those that are wanted if they are not
// there yet. Many threads may ask at once.
void need_wake(const WakeFrame& frame, std::size_t window, WakeFields wanted);

// What a window's heights stay within between samples `low` and `high`, in [0, kWakeSamples), their
// wavelength aside. 0.1 ms for all.
WakeBounds bounds_of_wake(const WakeWindow& window, glm::ivec2 low, glm::ivec2 high);

// Fills `velocity` with the windows of `wakes`, where one component of the water's velocity takes
// the place of the heights.
void advance_wake_velocity(const WakeFrame& wakes, WakeField field, WakeFrame& velocity,
                           Workers& workers);

// Adds heights in m (or what stands in their place), bilinear between samples; slopes; foam, of
// which the largest counts, in [0, 1]. Spans of one length. 2 ns a point and window.
void add_wake_heights(const WakeFrame& frame, std::span<const glm::dvec2> p_world,
                      std::span<float> height_m);
void add_window_heights(const WakeWindow& window, std::span<const glm::dvec2> p_world,
                        std::span<float> height_m);
void add_wake_slopes(const WakeFrame& frame, std::span<const glm::dvec2> p_world,
                     std::span<glm::vec2> slope);
void add_wake_foam(const WakeFrame& frame, std::span<const glm::dvec2> p_world,
                   std::span<float> foam);

// Whether a window has something to add at a point.
bool is_inside(const WakeWindow& window, glm::dvec2 p_world);

}  // namespace swell::ocean
