/* A host's rounding mode changes no bit of a world, an answer or a picture, and no call changes the
 * mode.
 *   rounding_modes_test [--in-turn] SCENE...
 * --in-turn: each scene in one of the modes, the next one in the next. */
#include <fenv.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <swell.h>

enum { kWidth = 64, kHeight = 36, kPoints = 64, kMostObjects = 400, kModes = 4 };

static const int kMode[kModes] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
static const char* const kModeName[kModes] = {"nearest", "upward", "downward", "zero"};

static int faults = 0;
static const char* place = "";

static void expect(bool is_so, const char* what) {
  if (is_so) return;
  ++faults;
  printf("%s: not so: %s (last error: %s)\n", place, what, swell_last_error());
}
#define EXPECT(condition) expect(condition, #condition)

/* The words of control that fesetround() sets: of SSE without its flags, of x87; of Arm. */
static unsigned control(void) {
#if defined(__aarch64__)
  unsigned long fpcr = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
  return (unsigned)fpcr;
#else
  unsigned short x87 = 0;
  unsigned sse = 0;
#if defined(__x86_64__) || defined(__i386__)
  __asm__ volatile("fnstcw %0" : "=m"(x87));
  __asm__ volatile("stmxcsr %0" : "=m"(sse));
#endif
  return (sse & 0xffc0u) << 16 | x87;
#endif
}

/* Whatever a caller may ask. */
typedef struct Answers {
  char* text;
  uint64_t world_hash, picture_hash;
  swell_camera camera;
  swell_pose poses[kMostObjects];
  float height[kPoints], slope[kPoints][2], normal[kPoints][3], velocity[kPoints][3];
  float foam[kPoints], depth[kPoints];
  swell_hit hit;
  swell_pick pick;
  unsigned char rgba[4 * kWidth * kHeight];
  float depth_m[kWidth * kHeight], linear[3 * kWidth * kHeight];
} Answers;

/* A call that succeeds and leaves the caller's mode as it is. */
#define CALL(call)                 \
  do {                             \
    EXPECT((call) == SWELL_OK);    \
    EXPECT(control() == control0); \
  } while (false)

static void ask(swell_session* session, double xy[2 * kPoints], Answers* a) {
  const unsigned control0 = control();
  const swell_query query = {.size = sizeof query,
                             .t_s = 3.7,
                             .count = kPoints,
                             .xy_m = xy,
                             .height_m = a->height,
                             .slope = &a->slope[0][0],
                             .normal = &a->normal[0][0],
                             .velocity_mps = &a->velocity[0][0],
                             .foam = a->foam,
                             .still_depth_m = a->depth};
  CALL(swell_ask(session, &query));
  const double origin[3] = {12.3, -45.6, 30.1}, direction[3] = {0.3, 0.7, -0.2};
  a->hit.size = sizeof a->hit;
  CALL(swell_ray(session, 3.7, origin, direction, 5000.0, &a->hit));
}

static void draw(swell_session* session, Answers* a) {
  const unsigned control0 = control();
  swell_picture* picture = NULL;
  CALL(swell_picture_create(&picture));
  const swell_frame frame = {.size = sizeof frame,
                             .t_s = 5.3,
                             .width_px = kWidth,
                             .height_px = kHeight,
                             .labels = "all",
                             .linear = 1};
  a->camera.size = sizeof a->camera;
  CALL(swell_scene_camera(session, 5.3, kWidth, kHeight, &a->camera));
  CALL(swell_render(session, &frame, picture));
  CALL(swell_picture_hash(picture, &a->picture_hash));
  CALL(swell_picture_copy(picture, "rgba", a->rgba, sizeof a->rgba));
  CALL(swell_picture_copy(picture, "depth", a->depth_m, sizeof a->depth_m));
  CALL(swell_picture_copy(picture, "linear", a->linear, sizeof a->linear));
  a->pick.size = sizeof a->pick;
  CALL(swell_pick_at(session, 31.3, 30.2, &a->pick));
  swell_picture_destroy(picture);
}

static Answers* answers_of(const char* scene, double xy[2 * kPoints]) {
  const unsigned control0 = control();
  Answers* const a = calloc(1, sizeof *a);
  if (!a) exit(1);
  swell_world* world = NULL;
  swell_session* session = NULL;
  CALL(swell_world_load(scene, &world));
  CALL(swell_session_create(world, 2, &session));
  if (!session) exit(1);
  a->text = strdup(swell_world_text(world));
  CALL(swell_world_hash(world, &a->world_hash));
  const size_t objects = swell_object_count(world);
  EXPECT(objects <= kMostObjects);
  for (size_t i = 0; i < objects; ++i) a->poses[i].size = sizeof a->poses[i];
  if (objects > 0) CALL(swell_object_poses(session, 3.7, a->poses, objects));
  ask(session, xy, a);
  draw(session, a);
  swell_session_destroy(session);
  swell_world_destroy(world);
  EXPECT(control() == control0);
  return a;
}

static void expect_same(const Answers* a, const Answers* b) { /* without the gaps in structures */
#define SAME(member) EXPECT(memcmp(&a->member, &b->member, sizeof a->member) == 0)
  EXPECT(strcmp(a->text, b->text) == 0);
  SAME(world_hash), SAME(camera), SAME(poses);
  SAME(height), SAME(slope), SAME(normal), SAME(velocity), SAME(foam), SAME(depth);
  SAME(hit.hits), SAME(hit.position_m), SAME(hit.distance_m), SAME(hit.from_above);
  SAME(pick.what), SAME(pick.position_m), SAME(pick.distance_m), SAME(pick.object), SAME(pick.id);
  SAME(pick.height_m);
  SAME(picture_hash), SAME(rgba), SAME(depth_m), SAME(linear);
#undef SAME
}

static void free_answers(Answers* a) {
  free(a->text);
  free(a);
}

static void test_scene(const char* scene, int first_mode, int last_mode) {
  double xy[2 * kPoints];
  for (int i = 0; i < kPoints; ++i) xy[2 * i] = 7.3 * i - 200.1, xy[2 * i + 1] = 311.7 - 11.9 * i;
  Answers* const expected = answers_of(scene, xy);
  for (int m = first_mode; m <= last_mode; ++m) {
    char name[300];
    snprintf(name, sizeof name, "%s, rounding to %s", scene, kModeName[m]);
    place = name;
    fesetround(kMode[m]);
    Answers* const got = answers_of(scene, xy);
    EXPECT(fegetround() == kMode[m]);
    fesetround(FE_TONEAREST);
    expect_same(expected, got);
    free_answers(got);
    place = scene;
  }
  free_answers(expected);
}

int main(int argc, char** argv) {
  const bool in_turn = argc > 1 && strcmp(argv[1], "--in-turn") == 0;
  const int first = in_turn ? 2 : 1;
  for (int i = first; i < argc; ++i) {
    const int mode = 1 + i % (kModes - 1); /* all but the nearest */
    test_scene(argv[i], in_turn ? mode : 1, in_turn ? mode : kModes - 1);
  }
  printf("%d scenes: %d faults\n", argc - first, faults);
  return argc > first && faults == 0 ? 0 : 1;
}
