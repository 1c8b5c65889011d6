// The water that figures of the papers are made of.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "scene/scene.h"
#include "scene/water.h"

namespace swell::apps {

class PaperStudio;

// A scene's water at the time of the pictures.
struct ShownWater {
  ShownWater(PaperStudio& studio, const std::string& file);

  // Of the terrain's square, which the scene has.
  glm::dvec2 middle_m() const;
  double side_m() const;

  scene::Scene scene;
  scene::Water water;
  ocean::SeaFrame frame;
  scene::WaterSurface surface;
};

}  // namespace swell::apps
