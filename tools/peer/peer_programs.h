// The shader programs of a frame: text put together for what a scene has, and constants from what
// Swell's own shaders read.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "render/tile/shading.h"
#include "tools/peer/gl_program.h"

namespace swell::render {
struct FrameState;
}

namespace swell::apps {

// What a scene needs of the shaders, as preprocessor lines and calls: the same text, the same
// programs.
struct ShaderFeatures {
  std::string water_defines;  // how many maps, coast, planar maps
  std::string water_layers;   // the calls that add the layers, in order
  std::string terrain_defines;
};
ShaderFeatures features_of(const render::FrameState& frame);

// Programs of one view: objects are shaded as they are drawn, land and water once it is known where
// they are nearest.
struct ViewPrograms {
  GlProgram object, distance, terrain;
};

struct PeerPrograms {
  PeerPrograms(const Gl& gl, const ShaderFeatures& features);

  GlProgram water, sky;
  ViewPrograms window, reflection, refraction;
};

// Sets all constants of a frame.
void set_constants(const render::FrameState& frame, const PeerPrograms& programs);

}  // namespace swell::apps
