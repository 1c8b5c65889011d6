// The whole viewer: a camera moved by hand stays in the air, and comes back from what is copied.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "apps/view/eye_floor.h"
#include "apps/view/viewer.h"
#include "scene/water.h"
#include "terrain/height_grid.h"
#include "viewer_harness.h"

namespace swell::view {
namespace {

// Waves of 4 m and an island, an eye over the water before it that looks there, slightly down.
scene::Scene rough_scene() {
  scene::Scene scene = small_scene();
  scene.camera = {.eye_m = {0.0, -120.0, 6.0}, .pitch_rad = -0.15};
  scene.sea.spectrum = false;
  scene.sea.sines = {{.amplitude_m = 2.0, .wavelength_m = 60.0, .to_rad = 0.3}};
  scene.terrain.emplace();
  scene.terrain->island_radius_m = 60.0;
  scene.terrain->floor_depth_m = 30.0;
  return scene;
}

// Small, coarse pictures: what is asked is where the eye goes over hundreds of them.
ViewerSettings flight_settings(ViewerSettings settings) {
  settings.size = {64, 48};
  settings.frame.water_triangles = settings.frame.terrain_triangles = 50;
  return settings;
}

// The ground under the eye of the last frame, asked of the scene alone.
class Below {
 public:
  explicit Below(const scene::Scene& scene) : water_(scene) {}

  double ground_m(const Viewer& viewer) {
    const glm::dvec2 p(viewer.report().camera.eye_m);
    float ground_m = 0.0f;
    terrain::sample_heights(*water_.terrain(), {&p, 1}, {&ground_m, 1});
    on_land_ = on_land_ || ground_m > 1.0f;
    return static_cast<double>(ground_m);
  }
  bool was_on_land() const { return on_land_; }

 private:
  scene::Water water_;
  bool on_land_ = false;
};

TEST_F(ViewerTest, TheEyeStaysAboveTheGroundWhereverItIsFlown) {
  Viewer viewer(rough_scene(), flight_settings(settings_of(1000000)));
  Below below(rough_scene());
  push_key(SDL_KEYDOWN, SDLK_w, SDL_SCANCODE_W);
  push_key(SDL_KEYDOWN, SDLK_LSHIFT, SDL_SCANCODE_LSHIFT);
  double lowest_m = 1e9, deepest_m = 1e9;
  for (int k = 0; k < 400; ++k) {
    if (k == 100) push_key(SDL_KEYDOWN, SDLK_q, SDL_SCANCODE_Q);
    if (k == 250) push_window_event(viewer, SDL_WINDOWEVENT_FOCUS_LOST);
    ASSERT_TRUE(viewer.turn());
    if (k == 0) continue;
    const double z = viewer.report().camera.eye_m.z, over_m = z - below.ground_m(viewer);
    ASSERT_GE(over_m, kEyeClearance_m - 1e-6) << k;
    lowest_m = std::min(lowest_m, over_m);
    deepest_m = std::min(deepest_m, z);
  }
  EXPECT_LT(lowest_m, kEyeClearance_m + 0.01) << "it may come as near as that";
  EXPECT_LT(deepest_m, -0.5) << "and dive";
  EXPECT_TRUE(below.was_on_land());
}

TEST_F(ViewerTest, AnEyeThatWasHeldUpGoesUpAtOnce) {
  Viewer viewer(rough_scene(), flight_settings(settings_of(1000000)));
  push_key(SDL_KEYDOWN, SDLK_q, SDL_SCANCODE_Q);
  for (int k = 0; k < 200; ++k) viewer.turn();
  push_key(SDL_KEYUP, SDLK_q, SDL_SCANCODE_Q);
  push_key(SDL_KEYDOWN, SDLK_e, SDL_SCANCODE_E);
  const double before_m = viewer.report().camera.eye_m.z;
  viewer.turn();
  EXPECT_GT(viewer.report().camera.eye_m.z, before_m + 0.1);
}

TEST_F(ViewerTest, TheScenesOwnCameraIsDrawnWhereTheSceneHasIt) {
  scene::Scene scene = rough_scene();
  scene.camera.eye_m.z = 0.2;
  Viewer viewer(scene, settings_of(3));
  viewer.run();
  EXPECT_EQ(viewer.report().camera.eye_m, scene.camera.eye_m);
  expect_headless_picture(viewer, scene);
}

// A camera on the waves, rolled, with a lens whose middle is not the picture's.
scene::Scene mounted_scene() {
  scene::Scene scene = rough_scene();
  scene.terrain.reset();
  scene.objects = {{.kind = scene::ObjectKind::kBox, .position_m = {5.0, -100.0}, .name = "raft"}};
  scene.camera = {.pitch_rad = -0.05,
                  .roll_rad = 0.2,
                  .focal_px = glm::dvec2(200.0, 180.0),
                  .principal_px = glm::dvec2(90.0, 40.0),
                  .size_px = glm::dvec2(160.0, 100.0),
                  .mount = "raft",
                  .mount_offset_m = {0.0, 2.0, 8.0}};
  return scene;
}

TEST_F(ViewerTest, AMountedCameraRidesOnItsObject) {
  Viewer viewer(mounted_scene(), settings_of(4));
  viewer.run();
  EXPECT_NE(viewer.report().camera.eye_m.z, 8.0) << "the waves lift it";
  expect_headless_picture(viewer, mounted_scene());
}

TEST_F(ViewerTest, AFlightStartsWithTheRollAndTheLensOfTheScenesCamera) {
  Viewer viewer(mounted_scene(), settings_of(1000000));
  viewer.turn();
  const CameraPose start = viewer.report().camera;
  EXPECT_NEAR(start.roll_rad, 0.2, 0.15) << "and what the waves add";
  push_key(SDL_KEYDOWN, SDLK_F2);  // the pointer may be over the panel
  push_key(SDL_KEYDOWN, SDLK_p);
  viewer.turn();
  const render::Target before = viewer.picture();
  push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_RIGHT);
  viewer.turn();
  push_motion(1, 0);
  viewer.turn();
  push_motion(-1, 0);
  viewer.turn();
  ASSERT_TRUE(viewer.has_own_camera());
  EXPECT_EQ(viewer.report().camera.roll_rad, start.roll_rad);

  // Back where it was: the same picture but for the last bits of its angles.
  const std::vector<std::uint32_t>& after = viewer.picture().rgba;
  ASSERT_EQ(after.size(), before.rgba.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < after.size(); ++i) different += after[i] != before.rgba[i];
  EXPECT_LT(different, after.size() / 10);
}

TEST_F(ViewerTest, TheCopiedCameraShowsTheSamePicture) {
  Viewer viewer(small_scene(), settings_of(100));
  viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_w, SDL_SCANCODE_W);
  push_key(SDL_KEYDOWN, SDLK_F2);
  push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_RIGHT);
  viewer.turn();
  push_motion(57, 13);
  for (int k = 0; k < 5; ++k) viewer.turn();
  ASSERT_TRUE(viewer.has_own_camera());
  push_key(SDL_KEYUP, SDLK_w, SDL_SCANCODE_W);
  push_key(SDL_KEYDOWN, SDLK_p);
  viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_c);
  viewer.turn();
  EXPECT_EQ(viewer.report().message, "copied the camera as TOML");

  const std::unique_ptr<char, void (*)(void*)> copied(SDL_GetClipboardText(), SDL_free);
  scene::Scene scene = small_scene();
  scene.camera = scene::parse_scene(copied.get(), "copied.toml").camera;
  EXPECT_EQ(scene.camera.eye_m, viewer.report().camera.eye_m);
  expect_headless_picture(viewer, scene);
}

}  // namespace
}  // namespace swell::view
