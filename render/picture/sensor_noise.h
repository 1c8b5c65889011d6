// What a camera's sensor adds to the light of a picture.
#pragma once

#include <cstddef>
#include <span>

#include "scene/camera.h"

namespace swell::render {

// Exposed light that fills a pixel: more is not told apart. The tone curve shows it at 0.95.
inline constexpr double kFullLight = 8.0;

// Electrons that a channel of a pixel gathers of exposed light 1.
double electrons_of_unit_light(const scene::SensorNoise& noise);

// Adds noise to light, three floats a pixel, of which the first is number `first_pixel` of the
// picture of time t_s. A channel gathers light * exposure * electrons_of_unit_light() electrons e,
// at most those of kFullLight; they get the variance e + read_noise_e^2: of shot noise and of
// reading them. The result is turned back to light, which may be below 0. The noise is a function
// of (seed, t_s, pixel, channel): a sum of eight uniform numbers, which is normal but for having no
// tails beyond 4.9 standard deviations.
// Source: EMVA Standard 1288, release 4.0, 2021, eq. 10, without the noise of quantization.
void add_sensor_noise(const scene::SensorNoise& noise, double t_s, float exposure,
                      std::size_t first_pixel, std::span<float> light);

}  // namespace swell::render
