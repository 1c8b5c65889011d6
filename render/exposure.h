// Pictures that let light in for a while: the mean of moments, as many as the scene's camera has,
// with the noise of its sensor.
#pragma once

#include "math/parallel.h"
#include "render/frame.h"

namespace swell::render {

// What moments of a frame are there: sub-times from the frame's own on, evenly over the time that
// the shutter is open. One: a picture of an instant. More are drawn at full size, with every pixel
// shaded.
struct Exposure {
  int moments = 1;
  double step_s = 0.0;
};

Exposure exposure_of(const scene::Camera& camera, const FrameOptions& options);

// The noise of a frame's sensor: the options' or the camera's; without full_well_e none.
scene::SensorNoise noise_of(const scene::Camera& camera, const FrameOptions& options);

// The request for moment k of a frame, drawn into `moment`. Labels are those of the first.
FrameRequest moment_request(const FrameRequest& frame, int k, Target& moment);

// Adds the light of moment k, drawn into `moment`, to the frame's; its labels come over.
void add_moment(int k, Target& moment, Target& frame);

// Turns the sum of moments, with the sensor's noise, into a picture of time t_s; keep_linear: its
// light stays.
void finish_exposure(int moments, const scene::SensorNoise& noise, double t_s, bool keep_linear,
                     Target& frame, Workers& workers);

}  // namespace swell::render
