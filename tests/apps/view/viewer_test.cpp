// The whole viewer, driven by SDL events. SWELL_TEST_VIDEO names SDL's video driver; without it
// the dummy driver is used, which needs no display.
#include "apps/view/viewer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <random>
#include <set>
#include <thread>

#include "apps/picture_file.h"
#include "texture/image_io.h"
#include "view_scene.h"

namespace swell::view {
namespace {

class ViewerTest : public testing::Test {
 protected:
  ViewerTest() {
    const char* driver = std::getenv("SWELL_TEST_VIDEO");
    setenv("SDL_VIDEODRIVER", driver ? driver : "dummy", 1);
  }
};

ViewerSettings settings_of(int frames, WindowSize size = {160, 100}) {
  return {.size = size, .threads = 2, .frames = frames, .frame = {}};
}

void push_key(Uint32 type, SDL_Keycode key, SDL_Scancode place = SDL_SCANCODE_UNKNOWN) {
  SDL_Event event{};
  event.key.type = type;
  event.key.keysym.sym = key;
  event.key.keysym.scancode = place;
  SDL_PushEvent(&event);
}

void push_button(Uint32 type, Uint8 button) {
  SDL_Event event{};
  event.button.type = type;
  event.button.button = button;
  SDL_PushEvent(&event);
}

void push_motion(int x_px, int y_px) {
  SDL_Event event{};
  event.motion.type = SDL_MOUSEMOTION;
  event.motion.xrel = x_px;
  event.motion.yrel = y_px;
  SDL_PushEvent(&event);
}

void push_window_event(Viewer& viewer, int what, int data1 = 0, int data2 = 0) {
  SDL_Event event{};
  event.window.type = SDL_WINDOWEVENT;
  event.window.windowID = SDL_GetWindowID(viewer.window().handle());
  event.window.event = static_cast<Uint8>(what);
  event.window.data1 = data1;
  event.window.data2 = data2;
  SDL_PushEvent(&event);
}

// What a program without a window draws.
render::Target headless_picture(const scene::Scene& scene, double t_s, int width_px, int height_px,
                                const render::FrameOptions& options = {}) {
  const render::World world{scene::Scene(scene)};
  Workers workers(1);
  render::Workspace workspace;
  render::Target target;
  render::render_frame(world, scene::camera_view(scene.camera, t_s, width_px, height_px), t_s,
                       options, workspace, target, workers);
  return target;
}

void expect_headless_picture(const Viewer& viewer, const scene::Scene& scene,
                             const render::FrameOptions& options = {}) {
  const render::Target& picture = viewer.picture();
  EXPECT_EQ(picture.rgba, headless_picture(scene, viewer.picture_time_s(), picture.width_px,
                                           picture.height_px, options)
                              .rgba);
}

TEST_F(ViewerTest, DrawsTheCountedFramesAtExactTimesAndEnds) {
  Viewer viewer(small_scene(), settings_of(7));
  viewer.run();
  EXPECT_EQ(viewer.frames_drawn(), 7);
  EXPECT_EQ(viewer.picture_time_s(), 6 / 60.0);
  EXPECT_EQ(viewer.picture().width_px, 160);
  EXPECT_EQ(viewer.picture().height_px, 100);
}

TEST_F(ViewerTest, ThePictureIsTheHeadlessPicture) {
  Viewer viewer(small_scene(), settings_of(5));
  viewer.run();
  expect_headless_picture(viewer, small_scene());
}

TEST_F(ViewerTest, AfterAnyResizesThePictureFitsTheWindowAndIsTheHeadlessPicture) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> side(1, 300);
  Viewer viewer(small_scene(), settings_of(1000000));
  for (int i = 0; i < 250; ++i) {
    int width = side(random), height = side(random);
    if (i % 25 == 0) width = height = 1;
    if (i % 60 == 0) width = 1600;  // wider than the screen
    if (i % 10 == 0) SDL_SetWindowSize(viewer.window().handle(), 0, height);  // refused by SDL
    SDL_SetWindowSize(viewer.window().handle(), width, height);
    if (i % 7 == 0) push_window_event(viewer, SDL_WINDOWEVENT_SIZE_CHANGED, 0, 0);
    if (i % 9 == 0) push_window_event(viewer, SDL_WINDOWEVENT_EXPOSED);
    if (i % 3 != 0) continue;  // several resizes between two frames
    ASSERT_TRUE(viewer.turn());
  }
  SDL_SetWindowSize(viewer.window().handle(), 123, 77);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  do {
    ASSERT_TRUE(viewer.turn());
  } while (viewer.picture().width_px != 123 && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(viewer.picture().width_px, 123);
  EXPECT_EQ(viewer.picture().height_px, 77);
  expect_headless_picture(viewer, small_scene());
}

TEST_F(ViewerTest, ClosingTheWindowEndsTheRun) {
  for (const bool by_quit : {false, true}) {
    Viewer viewer(small_scene(), settings_of(0));
    ASSERT_TRUE(viewer.turn());
    if (by_quit) {
      SDL_Event event{};
      event.type = SDL_QUIT;
      SDL_PushEvent(&event);
    } else {
      push_window_event(viewer, SDL_WINDOWEVENT_CLOSE);
    }
    EXPECT_FALSE(viewer.turn());
    EXPECT_EQ(viewer.frames_drawn(), 1);
  }
}

TEST_F(ViewerTest, KeysSwitchWireframePanelAndHelp) {
  Viewer viewer(small_scene(), settings_of(100));
  for (const bool on : {true, false}) {
    push_key(SDL_KEYDOWN, SDLK_F3);
    push_key(SDL_KEYDOWN, SDLK_F1);
    push_key(SDL_KEYDOWN, SDLK_F2);
    ASSERT_TRUE(viewer.turn());
    EXPECT_EQ(viewer.panel().frame.wireframe, on);
    EXPECT_EQ(viewer.shows_help(), on);
    EXPECT_EQ(viewer.shows_panel(), !on);
    expect_headless_picture(viewer, small_scene(), viewer.panel().frame);
  }
}

TEST_F(ViewerTest, ARepeatedKeySwitchesOnce) {
  Viewer viewer(small_scene(), settings_of(100));
  SDL_Event event{};
  event.key.type = SDL_KEYDOWN;
  event.key.keysym.sym = SDLK_F3;
  for (const Uint8 repeat : std::array<Uint8, 3>{0, 1, 1}) {
    event.key.repeat = repeat;
    SDL_PushEvent(&event);
  }
  ASSERT_TRUE(viewer.turn());
  EXPECT_TRUE(viewer.panel().frame.wireframe);
}

TEST_F(ViewerTest, PauseStopsTheSeaAndFullStopStepsIt) {
  Viewer viewer(small_scene(), settings_of(100));
  for (int i = 0; i < 3; ++i) viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_p);
  for (int i = 0; i < 3; ++i) viewer.turn();
  EXPECT_EQ(viewer.picture_time_s(), 2 / 60.0);
  push_key(SDL_KEYDOWN, SDLK_PERIOD);
  for (int i = 0; i < 3; ++i) viewer.turn();
  EXPECT_EQ(viewer.picture_time_s(), 3 / 60.0);
  push_key(SDL_KEYDOWN, SDLK_p);
  viewer.turn();
  EXPECT_EQ(viewer.picture_time_s(), 4 / 60.0);
}

TEST_F(ViewerTest, TheCameraFollowsTheSceneUntilItIsMovedAndAgainAfterReset) {
  Viewer viewer(small_scene(), settings_of(100));
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
  push_key(SDL_KEYDOWN, SDLK_w, SDL_SCANCODE_W);
  viewer.turn();
  EXPECT_TRUE(viewer.has_own_camera());
  push_key(SDL_KEYUP, SDLK_w, SDL_SCANCODE_W);
  push_key(SDL_KEYDOWN, SDLK_r);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
  expect_headless_picture(viewer, small_scene());
}

TEST_F(ViewerTest, KeysAreLetGoWhenTheWindowLosesTheFocus) {
  Viewer viewer(small_scene(), settings_of(100));
  push_key(SDL_KEYDOWN, SDLK_w, SDL_SCANCODE_W);
  push_window_event(viewer, SDL_WINDOWEVENT_FOCUS_LOST);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
}

TEST_F(ViewerTest, TheMouseLooksOnlyWhileItIsCaptured) {
  Viewer viewer(small_scene(), settings_of(100));
  push_key(SDL_KEYDOWN, SDLK_F2);  // no panel under the pointer
  viewer.turn();
  viewer.turn();
  push_motion(50, 10);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
  push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_RIGHT);
  viewer.turn();  // SDL drops older motion when the mouse is captured
  EXPECT_FALSE(viewer.has_own_camera());
  push_motion(50, 10);
  push_button(SDL_MOUSEBUTTONUP, SDL_BUTTON_RIGHT);
  viewer.turn();
  EXPECT_TRUE(viewer.has_own_camera());
  push_key(SDL_KEYDOWN, SDLK_r);
  push_motion(50, 10);
  viewer.turn();
  EXPECT_FALSE(viewer.has_own_camera());
}

TEST_F(ViewerTest, EscapeReleasesTheMouseFirstAndThenQuits) {
  Viewer viewer(small_scene(), settings_of(100));
  push_key(SDL_KEYDOWN, SDLK_F2);
  viewer.turn();
  viewer.turn();
  push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_LEFT);
  push_button(SDL_MOUSEBUTTONUP, SDL_BUTTON_LEFT);
  push_key(SDL_KEYDOWN, SDLK_ESCAPE);
  EXPECT_TRUE(viewer.turn());
  push_key(SDL_KEYDOWN, SDLK_ESCAPE);
  EXPECT_FALSE(viewer.turn());
}

TEST_F(ViewerTest, AHiddenWindowIsNotDrawnAndHardlyUsesTheProcessor) {
  Viewer viewer(small_scene(), settings_of(0));
  viewer.turn();
  SDL_HideWindow(viewer.window().handle());
  while (viewer.window().is_visible()) viewer.turn();
  for (int i = 0; i < 5; ++i) viewer.turn();  // events of the change itself
  const int drawn = viewer.frames_drawn();
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpu_begin = std::clock();
  std::chrono::duration<double> passed{0.0};
  while (passed.count() < 1.0) {
    viewer.turn();
    passed = std::chrono::steady_clock::now() - begin;
  }
  const double cpu_s = static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
  EXPECT_EQ(viewer.frames_drawn(), drawn);
  EXPECT_LT(cpu_s, 0.05 * passed.count());

  SDL_ShowWindow(viewer.window().handle());
  const auto shown = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (viewer.frames_drawn() == drawn && std::chrono::steady_clock::now() < shown) viewer.turn();
  EXPECT_GT(viewer.frames_drawn(), drawn);
}

TEST_F(ViewerTest, LostDevicesAreMadeAnew) {
  Viewer viewer(small_scene(), settings_of(100));
  for (const Uint32 type : {SDL_RENDER_TARGETS_RESET, SDL_RENDER_DEVICE_RESET}) {
    viewer.turn();
    SDL_Event event{};
    event.type = type;
    SDL_PushEvent(&event);
    EXPECT_TRUE(viewer.turn());
  }
  EXPECT_TRUE(viewer.window().draw_picture(viewer.picture()));
}

TEST_F(ViewerTest, AStormOfEventsInAnyOrderIsSurvived) {
  std::mt19937 random(9);
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  Viewer viewer(small_scene(), settings_of(1000000));
  for (int i = 0; i < 4000; ++i) {
    const auto place = static_cast<SDL_Scancode>(below(SDL_NUM_SCANCODES));
    switch (below(6)) {
      case 0:
        push_key(SDL_KEYDOWN, below(128) == 0 ? SDLK_F11 : SDLK_F3, place);
        break;
      case 1:
        push_key(SDL_KEYUP, SDLK_w, place);
        break;
      case 2:
        push_motion(below(2000) - 1000, below(2000) - 1000);
        break;
      case 3:
        push_button(SDL_MOUSEBUTTONDOWN, static_cast<Uint8>(below(8)));
        break;
      case 4:
        push_button(SDL_MOUSEBUTTONUP, static_cast<Uint8>(below(8)));
        break;
      default:
        if (const int what = below(20); what != SDL_WINDOWEVENT_CLOSE)
          push_window_event(viewer, what, below(5000) - 100, below(5000) - 100);
    }
    if (i % 40 != 0) continue;
    ASSERT_TRUE(viewer.turn());
  }
  push_window_event(viewer, SDL_WINDOWEVENT_CLOSE);
  EXPECT_FALSE(viewer.turn());
}

TEST_F(ViewerTest, NewWavesAppearWhileFramesGoOn) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  WaveChoice choice = wave_choice(small_scene());
  for (int i = 0; i < 10; ++i) {  // a slider being dragged
    choice.wind_speed_mps = 5.0 + i;
    viewer.choose_waves(choice);
    viewer.turn();
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (viewer.is_rebuilding() && std::chrono::steady_clock::now() < end) viewer.turn();
  viewer.turn();
  EXPECT_EQ(viewer.world().scene().sea.wind_speed_mps, 14.0);
  expect_headless_picture(viewer, with_waves(small_scene(), choice));
}

// The trains of a coast take a hundred frames' time to work out.
TEST_F(ViewerTest, NoFrameWaitsForNewWaves) {
  scene::Scene coast = small_scene();
  coast.terrain.emplace();
  coast.terrain->coast_m = {{-500.0, 200.0}, {500.0, 200.0}};
  coast.coast.model = scene::CoastModel::kBlend;
  Viewer viewer(coast, settings_of(1000000));
  for (int i = 0; i < 3; ++i) viewer.turn();

  using Clock = std::chrono::steady_clock;
  WaveChoice choice = wave_choice(coast);
  choice.wind_speed_mps = 11.0;
  const Clock::time_point asked = Clock::now();
  viewer.choose_waves(choice);
  Clock::duration longest{0};
  int frames = 0;
  for (; viewer.world().scene().sea.wind_speed_mps != 11.0; ++frames) {
    const Clock::time_point begin = Clock::now();
    ASSERT_TRUE(viewer.turn());
    longest = std::max(longest, Clock::now() - begin);
    ASSERT_LT(begin - asked, std::chrono::seconds(60));
  }
  EXPECT_LT(2 * longest, Clock::now() - asked);
  EXPECT_GE(frames, 4);
}

TEST_F(ViewerTest, AnotherTriangulationAppearsLikeNewWaves) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  scene::Scene other = small_scene();
  other.detail.triangulation = scene::Triangulation::kRadial;
  viewer.choose_detail(other.detail);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (viewer.is_rebuilding() && std::chrono::steady_clock::now() < end) viewer.turn();
  viewer.turn();
  expect_headless_picture(viewer, other);
}

void push_pointer(int x, int y) {
  SDL_Event event{};
  event.motion.type = SDL_MOUSEMOTION;
  event.motion.x = x;
  event.motion.y = y;
  SDL_PushEvent(&event);
}

TEST_F(ViewerTest, ThePointerPicksTheWaterThatIsDrawnThere) {
  Viewer viewer(small_scene(), settings_of(1000000, {640, 400}));
  viewer.turn();
  push_pointer(600, 390);  // beside the panel
  viewer.turn();
  ASSERT_TRUE(viewer.report().pick);
  const render::Pick pick = *viewer.report().pick;
  EXPECT_EQ(pick.what, render::Shown::kWater);
  const View view = scene::camera_view(small_scene().camera, viewer.picture_time_s(), 640, 400);
  const glm::vec4 clip = view.clip_from_rel * glm::vec4(pick.p_world - view.eye_world, 1.0);
  EXPECT_NEAR((clip.x / clip.w + 1.0f) * 320.0f, 600.5f, 0.01f);
  EXPECT_NEAR((1.0f - clip.y / clip.w) * 200.0f, 390.5f, 0.01f);

  push_pointer(600, 10);  // the sky
  viewer.turn();
  EXPECT_FALSE(viewer.report().pick);
  push_pointer(600, 390);
  push_window_event(viewer, SDL_WINDOWEVENT_LEAVE);
  viewer.turn();
  EXPECT_FALSE(viewer.report().pick);
}

TEST_F(ViewerTest, ThePointerPicksWhatFloatsThere) {
  scene::Scene scene = small_scene();
  scene.objects.resize(2);
  scene.objects[0].position_m = {0.0, -50.0};  // behind the eye
  scene.objects[1].kind = scene::ObjectKind::kBox;
  scene.objects[1].position_m = {6.0, 30.0};
  scene.objects[1].size_m = glm::dvec3(4.0);
  Viewer viewer(scene, settings_of(1000000, {640, 400}));
  viewer.turn();
  push_pointer(420, 240);
  viewer.turn();
  ASSERT_TRUE(viewer.report().pick);
  const render::Pick pick = *viewer.report().pick;
  EXPECT_EQ(pick.what, render::Shown::kObject);
  EXPECT_EQ(pick.object, 1);
  EXPECT_EQ(pick.object_kind, scene::ObjectKind::kBox);
  EXPECT_NEAR(pick.p_world.y, 28.0, 1.0);
}

TEST_F(ViewerTest, FarWavesAreLeftOutAndDrawnAgainFromFrameToFrame) {
  scene::Scene scene = small_scene();
  scene.detail.background_error_px = 2.0;
  Viewer viewer(scene, settings_of(100));
  viewer.turn();
  render::FrameOptions quality = viewer.panel().frame;
  EXPECT_EQ(quality.background_error_px, 2.0);
  std::set<std::uint64_t> pictures;
  push_key(SDL_KEYDOWN, SDLK_p);
  for (const double error_px : {0.0, 2.0, 8.0}) {
    quality.background_error_px = error_px;
    viewer.choose_quality(quality);
    viewer.turn();
    scene.detail.background_error_px = error_px;
    expect_headless_picture(viewer, scene);
    pictures.insert(render::picture_hash(viewer.picture()));
  }
  EXPECT_EQ(pictures.size(), 3);
}

TEST_F(ViewerTest, TheGovernorIsOnUnlessFramesAreCounted) {
  EXPECT_TRUE(Viewer(small_scene(), settings_of(0)).panel().governed);
  EXPECT_FALSE(Viewer(small_scene(), settings_of(5)).panel().governed);
}

TEST_F(ViewerTest, FramesDrawLessToKeepASmallBudgetAndAllWithoutOne) {
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.turn();
  const int all = viewer.report().statistics.water_triangles;
  viewer.choose_budget(true, 0.01);
  for (int i = 0; i < 60; ++i) viewer.turn();
  EXPECT_LT(viewer.report().statistics.water_triangles, all / 2);
  EXPECT_LT(viewer.report().picture_scale, 1.0);
  viewer.choose_budget(false, 0.01);
  viewer.turn();
  EXPECT_EQ(viewer.report().picture_scale, 1.0);
  expect_headless_picture(viewer, small_scene());
}

namespace fs = std::filesystem;

// A working folder of this process alone, for as long as it lives.
class ScreenshotFolder {
 public:
  ScreenshotFolder()
      : old_(fs::current_path()),
        own_(fs::path(testing::TempDir()) / ("swell_shots_" + std::to_string(getpid()))) {
    fs::create_directories(own_);
    fs::current_path(own_);
  }
  ~ScreenshotFolder() {
    fs::current_path(old_);
    fs::remove_all(own_);
  }
  ScreenshotFolder(const ScreenshotFolder&) = delete;
  ScreenshotFolder& operator=(const ScreenshotFolder&) = delete;

 private:
  fs::path old_, own_;
};

TEST_F(ViewerTest, ScreenshotsGetTheNextFreeName) {
  const ScreenshotFolder folder;
  Viewer viewer(small_scene(), settings_of(100));
  push_key(SDL_KEYDOWN, SDLK_F12);  // there is no picture yet
  viewer.turn();
  for (int i = 0; i < 2; ++i) {
    push_key(SDL_KEYDOWN, SDLK_F12);
    viewer.turn();
  }
  EXPECT_TRUE(fs::exists("swell_0001.png"));
  EXPECT_TRUE(fs::exists("swell_0002.png"));
  EXPECT_FALSE(fs::exists("swell_0003.png"));
}

TEST_F(ViewerTest, AScreenshotIsThePictureAtFullQualityAndTheGovernorGoesOnAsBefore) {
  const ScreenshotFolder folder;
  Viewer viewer(small_scene(), settings_of(1000000));
  viewer.choose_budget(true, 0.01);
  for (int i = 0; i < 60; ++i) viewer.turn();
  push_key(SDL_KEYDOWN, SDLK_p);
  viewer.turn();
  viewer.turn();
  ASSERT_LT(viewer.report().picture_scale, 1.0);
  const std::uint64_t shown = render::picture_hash(viewer.picture());
  const int step_changes = viewer.report().governor.step_changes;

  push_key(SDL_KEYDOWN, SDLK_F12);
  viewer.turn();
  apps::write_picture(headless_picture(small_scene(), viewer.picture_time_s(), 160, 100),
                      "expected.png");
  EXPECT_EQ(texture::read_image("swell_0001.png").pixels,
            texture::read_image("expected.png").pixels);
  EXPECT_EQ(render::picture_hash(viewer.picture()), shown);
  EXPECT_EQ(viewer.report().governor.step_changes, step_changes);
  EXPECT_EQ(viewer.report().statistics.splits + viewer.report().statistics.merges, 0)
      << "frames go on from the mesh of the last one";
}

}  // namespace
}  // namespace swell::view
