// What the labels of a frame are made from, besides its tiles' own pixels: computed once a frame,
// and only what the labels that are asked for need.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ocean/open_sea/sea.h"
#include "render/frame/options.h"
#include "render/frame/profile.h"
#include "render/view/render_view.h"
#include "scene/objects.h"

namespace swell::render {

struct WorldState;

// Where pixels move to from a camera to the next. With q = (x, y, 1), x and y a pixel's centre as
// seen from the middle of the picture, z its depth and m how far its point moves in the world, the
// next camera sees it at (q + turn q + (shift + next m) / z), a homogeneous point. The parts that
// are no motion are left out, so that what stands still has one of exactly 0.
struct CameraMotion {
  glm::mat3 turn{0.0f};
  glm::mat3 next{1.0f};  // homogeneous points in pixels, from points relative to the next eye [m]
  glm::vec3 shift{0.0f};
};

CameraMotion camera_motion(const View& now, const View& next);

// How far a point p_rel of a primitive moves to the next frame: move * (p_rel, 1), relative to the
// eye [m], on a flat earth. What stands still has one of exactly 0.
using AffineMove = glm::mat4x3;

struct LabelTables {
  LabelSet set;
  bool from_shading = false;  // some labels come from the shader
  glm::dvec3 eye_world{0.0};
  // By primitive of the window, each where a label that is asked for needs it.
  std::vector<std::uint32_t> id, klass;  // of water that is no foam
  std::vector<glm::vec3> normal;         // for kGeometricNormal; of land that rays find: none
  std::vector<AffineMove> move;          // for kMotion
  CameraMotion camera;                   // likewise
  // Storage.
  ocean::SeaFrame next_sea;
  std::vector<float> next_height_m;           // per vertex of the water
  std::vector<glm::vec3> vertex_move;         // of a surface whose vertices move one by one
  std::vector<scene::ObjectPose> next_poses;  // of all objects
};

// What a frame is drawn from, once it is known what is visible.
struct LabelInputs {
  const WorldState& world;
  const Meshes& meshes;
  const RenderView& window;
  const FrameOptions& options;  // with the scene's defaults
  double t_s;
};

// Fills what options.labels needs. Allocates nothing in a steady state.
void fill_label_tables(const LabelInputs& in, LabelTables& tables, const StageRun& run);

}  // namespace swell::render
