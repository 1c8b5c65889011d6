// What the labels of a frame are made from, besides its tiles' own pixels: computed once a frame,
// and only what the labels that are asked for need.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ocean/sea.h"
#include "render/frame.h"
#include "render/view/render_view.h"
#include "scene/objects.h"

namespace swell::render {

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

// A rigid object's points p_rel move by turn (p_rel - origin_rel) + shift.
struct ObjectMotion {
  glm::mat3 turn{0.0f};
  glm::vec3 origin_rel{0.0f}, shift{0.0f};
};

struct LabelTables {
  LabelSet set;
  bool from_shading = false;  // some labels come from the shader
  glm::dvec3 eye_world{0.0};
  // By primitive of the window; for kGeometricNormal. Of land that rays find: none.
  std::vector<glm::vec3> normal;
  // For kMotion.
  CameraMotion camera;
  double step_s = 0.0;                      // to the next frame
  std::vector<ObjectMotion> object_motion;  // by object of the scene
  // By triangle of the water: it rises by rise.x + rise.y x + rise.z y at a place (x, y) relative
  // to the eye.
  std::vector<glm::vec3> rise;
  std::vector<glm::vec3> tree_move;  // by vertex of the window's TreeDraws
  // Storage.
  ocean::SeaFrame next_sea;
  std::vector<float> next_height_m;           // per vertex of the water
  std::vector<scene::ObjectPose> next_poses;  // of all objects
};

// What a frame is drawn from, once it is known what is visible.
struct LabelInputs {
  const World::State& world;
  const Meshes& meshes;
  const RenderView& window;
  const FrameOptions& options;  // with the scene's defaults
  double t_s;
};

// Fills what options.labels needs. Allocates nothing in a steady state.
void fill_label_tables(const LabelInputs& in, LabelTables& tables, const StageRun& run);

}  // namespace swell::render
