// From the light of several moments to a picture.
#pragma once

#include <cstdint>
#include <span>

namespace swell::render {

// Makes the mean of light that was added `moments` times, three floats a pixel, in place, and the
// pixels of row y_px that show it at this exposure, as those of a frame.
void develop_row(std::span<float> light, int moments, float exposure, int y_px,
                 std::span<std::uint32_t> rgba);

}  // namespace swell::render
