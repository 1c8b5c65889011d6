// From the faces of a wide picture to its pixels.
#pragma once

#include <span>

#include "render/frame/target.h"
#include "render/picture/wide_plan.h"

namespace swell::render {

// Fills a row of the wide picture's linear light, three floats a pixel, with the mean of its face's
// by the pixel's tent. `faces` are drawn with linear light.
void gather_light(const WidePlan& plan, std::span<const Target> faces, std::size_t row,
                  std::span<float> light);

// Fills a row of the wide picture's labels, which are sized, with those of the nearest pixels of
// its faces. The depth is that of wide pictures: the distance from the eye. Motion is in the wide
// picture's pixels, of equirectangular ones the shorter way round.
void gather_labels(const WidePlan& plan, std::span<const Target> faces, std::size_t row,
                   Labels& labels);

}  // namespace swell::render
