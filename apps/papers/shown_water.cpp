#include "apps/papers/shown_water.h"

#include "apps/papers/paper.h"

namespace swell::apps {

ShownWater::ShownWater(PaperStudio& studio, const std::string& file)
    : scene(studio.load(file)),
      water(scene),
      surface(water.at(kShown_s, frame, studio.workers())) {}

glm::dvec2 ShownWater::middle_m() const { return water.terrain()->grid.min_world + 0.5 * side_m(); }

double ShownWater::side_m() const { return water.terrain()->grid.size_m(); }

}  // namespace swell::apps
