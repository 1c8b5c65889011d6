/* The C interface from a C11 program: known answers, errors, threads, memory.
 *   c_interface_test [WORLDS]      WORLDS: how many are made and destroyed, 20 if left out */
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <swell.h>

#include "expect.h"

/* Draws in a few ms and is made in 40 ms: a gradient for a sky, few triangles. */
#define SMALL                                                                                     \
  "[sky]\nzenith = [0.1, 0.2, 0.4]\nhorizon = [0.5, 0.6, 0.7]\n[detail]\nwater_triangles = 500\n" \
  "[sea]\nspectrum = false\n"
#define BUOY "[[object]]\nkind = \"buoy\"\nname = \"red\"\nclass = \"buoy\"\nposition_m = [0, 30]\n"

static const double kNotANumber = NAN, kHuge = 1e300;

static swell_world* make_world(const char* text) {
  swell_world* world = NULL;
  const swell_scene scene = {.size = sizeof scene, .text = text, .threads = 2};
  EXPECT(swell_world_create(&scene, &world) == SWELL_OK);
  if (!world) exit(1);
  return world;
}

typedef struct Opened {
  swell_world* world;
  swell_session* session;
  swell_picture* picture;
} Opened;

static Opened open_scene(const char* text) {
  Opened opened = {make_world(text), NULL, NULL};
  EXPECT(swell_session_create(opened.world, 2, &opened.session) == SWELL_OK);
  EXPECT(swell_picture_create(&opened.picture) == SWELL_OK);
  return opened;
}

static void close_scene(Opened opened) {
  swell_world_destroy(opened.world); /* before what uses it */
  swell_session_destroy(opened.session);
  swell_picture_destroy(opened.picture);
}

static swell_frame small_frame(void) {
  return (swell_frame){.size = sizeof(swell_frame), .t_s = 2.0, .width_px = 96, .height_px = 64};
}

static swell_plane plane(Opened opened, const char* name) {
  swell_plane found = {.size = sizeof found};
  EXPECT(swell_picture_plane(opened.picture, name, &found) == SWELL_OK);
  return found;
}

static bool near_to(double a, double b, double tolerance) { return fabs(a - b) <= tolerance; }

/* ---- Known answers */

static void test_still_water(void) {
  const Opened o = open_scene(SMALL);
  const double xy[6] = {0, 0, 1000, -2000, -3.5, 7};
  float height[3], slope[6], normal[9], velocity[9], foam[3], depth[3];
  const swell_query query = {.size = sizeof query,
                             .t_s = 5.0,
                             .count = 3,
                             .xy_m = xy,
                             .height_m = height,
                             .slope = slope,
                             .normal = normal,
                             .velocity_mps = velocity,
                             .foam = foam,
                             .still_depth_m = depth};
  EXPECT(swell_ask(o.session, &query) == SWELL_OK);
  for (int i = 0; i < 3; ++i) {
    EXPECT(height[i] == 0.0f && slope[2 * i] == 0.0f && slope[2 * i + 1] == 0.0f);
    EXPECT(normal[3 * i] == 0.0f && normal[3 * i + 1] == 0.0f && normal[3 * i + 2] == 1.0f);
    EXPECT(velocity[3 * i] == 0.0f && velocity[3 * i + 1] == 0.0f && velocity[3 * i + 2] == 0.0f);
    EXPECT(foam[i] == 0.0f && isinf(depth[i]) && depth[i] > 0.0f);
  }
  const double from[3] = {1, 2, 10}, down[3] = {0, 0, -3};
  swell_hit hit = {.size = sizeof hit};
  EXPECT(swell_ray(o.session, 5.0, from, down, 100, &hit) == SWELL_OK);
  EXPECT(hit.hits == 1 && hit.from_above == 1 && near_to(hit.distance_m, 10.0, 1e-5));
  EXPECT(near_to(hit.position_m[0], 1.0, 1e-9) && near_to(hit.position_m[2], 0.0, 1e-5));
  EXPECT(swell_ray(o.session, 5.0, from, down, 9, &hit) == SWELL_OK && hit.hits == 0);
  close_scene(o);
}

/* A sine of 1.5 m and 80 m that goes east over deep water. */
static void test_sine(void) {
  const Opened o = open_scene(
      "[sky]\nzenith = [0.1, 0.2, 0.4]\nhorizon = [0.5, 0.6, 0.7]\n[wind]\nspeed_mps = 0.0\n"
      "[[sea.sines]]\namplitude_m = 1.5\nwavelength_m = 80.0\nto_deg = 90.0\n");
  const double pi = acos(-1.0), k = 2.0 * pi / 80.0, omega = sqrt(9.81 * k), step_s = 0.01;
  enum { kPoints = 200 };
  double xy[2 * kPoints];
  for (int i = 0; i < kPoints; ++i) xy[2 * i] = 0.8 * i, xy[2 * i + 1] = 10.0 * i;
  float before[kPoints], height[kPoints], after[kPoints], slope[2 * kPoints], velocity[3 * kPoints];
  swell_query query = {.size = sizeof query, .t_s = 7.0 - step_s, .count = kPoints, .xy_m = xy};
  query.height_m = before;
  EXPECT(swell_ask(o.session, &query) == SWELL_OK);
  query.t_s = 7.0 + step_s, query.height_m = after;
  EXPECT(swell_ask(o.session, &query) == SWELL_OK);
  query.t_s = 7.0, query.height_m = height, query.slope = slope, query.velocity_mps = velocity;
  EXPECT(swell_ask(o.session, &query) == SWELL_OK);
  double least = 0, most = 0;
  for (int i = 0; i < kPoints; ++i) {
    least = fmin(least, height[i]), most = fmax(most, height[i]);
    const float* v = velocity + 3 * i;
    const double rise = ((double)after[i] - (double)before[i]) / (2 * step_s);
    EXPECT(near_to(v[2], rise, 0.01));              /* up is the rate of the height */
    EXPECT(near_to(v[0], omega * height[i], 0.02)); /* forward on the crests */
    EXPECT(near_to(v[1], 0.0, 1e-5));
    EXPECT(near_to(hypot(slope[2 * i] / k, height[i]), 1.5, 0.02)); /* sine and cosine */
    EXPECT(near_to(slope[2 * i + 1], 0.0, 1e-5));
  }
  EXPECT(near_to(most, 1.5, 0.01) && near_to(least, -1.5, 0.01));
  close_scene(o);
}

static void test_picture(void) {
  const Opened o = open_scene(SMALL BUOY);
  swell_frame frame = small_frame();
  frame.labels = "all", frame.linear = 1;
  swell_camera camera = {.size = sizeof camera};
  const double eye[3] = {0, 0, 4};
  EXPECT(swell_camera_look(eye, 0, -5, 0, 50, 96, 64, &camera) == SWELL_OK);
  EXPECT(near_to(camera.focal_px[1], 32.0 / tan(25.0 * acos(-1.0) / 180.0), 1e-9));
  frame.camera = &camera;
  EXPECT(swell_render(o.session, &frame, o.picture) == SWELL_OK);

  const struct {
    const char* name;
    swell_type type;
    int components;
    size_t bytes;
  } planes[] = {{"rgba", SWELL_UINT8, 4, 4},
                {"linear", SWELL_FLOAT32, 3, 12},
                {"depth", SWELL_FLOAT32, 1, 4},
                {"distance", SWELL_FLOAT32, 1, 4},
                {"position", SWELL_FLOAT64, 3, 24},
                {"normal", SWELL_FLOAT32, 3, 12},
                {"geometric_normal", SWELL_FLOAT32, 3, 12},
                {"id", SWELL_UINT32, 1, 4},
                {"class", SWELL_UINT32, 1, 4},
                {"motion", SWELL_FLOAT32, 2, 8},
                {"elevation", SWELL_FLOAT32, 1, 4},
                {"foam", SWELL_FLOAT32, 1, 4},
                {"flags", SWELL_UINT8, 1, 1}};
  static unsigned char copy[96 * 64 * 24];
  for (size_t i = 0; i < sizeof planes / sizeof *planes; ++i) {
    const swell_plane p = plane(o, planes[i].name);
    const size_t bytes = 96 * 64 * planes[i].bytes;
    EXPECT(p.width_px == 96 && p.height_px == 64 && p.type == planes[i].type);
    EXPECT(p.components == planes[i].components && p.bytes == bytes);
    EXPECT(swell_picture_copy(o.picture, planes[i].name, copy, bytes) == SWELL_OK);
    EXPECT(memcmp(copy, p.data, bytes) == 0);
    EXPECT(swell_picture_copy(o.picture, planes[i].name, copy, bytes - 1) == SWELL_BAD_ARGUMENT);
  }

  /* The buoy stands in the middle of the picture, 30 m ahead. */
  const size_t middle = 32 * 96 + 48, sky = 48;
  swell_object object = {.size = sizeof object};
  EXPECT(swell_object_count(o.world) == 1);
  EXPECT(swell_object_info(o.world, 0, &object) == SWELL_OK);
  EXPECT(strcmp(object.name, "red") == 0 && strcmp(object.kind, "buoy") == 0);
  EXPECT(strcmp(object.class_name, "buoy") == 0);
  EXPECT(strcmp(swell_class_name(o.world, object.klass), "buoy") == 0);
  EXPECT(strcmp(swell_class_name(o.world, 1), "water") == 0);
  const uint32_t *id = plane(o, "id").data, *klass = plane(o, "class").data;
  const float *depth = plane(o, "depth").data, *distance = plane(o, "distance").data;
  const double* position = plane(o, "position").data;
  EXPECT(id[middle] == object.id && klass[middle] == object.klass && id[sky] == 0);
  EXPECT(isinf(depth[sky]) && depth[middle] > 25 && depth[middle] < 31);
  EXPECT(distance[middle] >= depth[middle]);
  EXPECT(near_to(position[3 * middle + 1], 30, 2) && near_to(position[3 * middle], 0, 2));
  swell_pick pick = {.size = sizeof pick};
  EXPECT(swell_pick_at(o.session, 48.5, 32.5, &pick) == SWELL_OK);
  EXPECT(pick.what == SWELL_SHOWS_OBJECT && pick.object == 0 && pick.id == object.id);
  EXPECT(near_to(pick.distance_m, distance[middle], 0.1));
  EXPECT(swell_pick_at(o.session, 48.5, 0.5, &pick) == SWELL_OK && pick.what == SWELL_SHOWS_SKY);
  EXPECT(swell_pick_at(o.session, 5, 63, &pick) == SWELL_OK && pick.what == SWELL_SHOWS_WATER);
  EXPECT(pick.id == 1 && pick.height_m == 0.0);

  /* Elsewhere it leaves its place to the water. */
  uint64_t hash[3] = {0};
  EXPECT(swell_picture_hash(o.picture, &hash[0]) == SWELL_OK);
  swell_pose pose = {.size = sizeof pose};
  EXPECT(swell_object_poses(o.session, 2.0, &pose, 1) == SWELL_OK);
  EXPECT(near_to(pose.position_m[1], 30, 1e-9) && near_to(pose.quaternion_wxyz[0], 1, 1e-9));
  pose.position_m[1] = -500;
  frame.poses = &pose, frame.pose_count = 1;
  EXPECT(swell_render(o.session, &frame, o.picture) == SWELL_OK);
  id = plane(o, "id").data;
  EXPECT(id[middle] == 1);
  EXPECT(swell_picture_hash(o.picture, &hash[1]) == SWELL_OK && hash[0] != hash[1]);
  frame.poses = NULL, frame.pose_count = 0, frame.labels = NULL;
  EXPECT(swell_render(o.session, &frame, o.picture) == SWELL_OK);
  EXPECT(swell_picture_hash(o.picture, &hash[2]) == SWELL_OK && hash[0] == hash[2]);
  swell_plane none = {.size = sizeof none};
  EXPECT(swell_picture_plane(o.picture, "id", &none) == SWELL_BAD_ARGUMENT);

  swell_camera drawn = {.size = sizeof drawn};
  EXPECT(swell_picture_camera(o.picture, &drawn) == SWELL_OK);
  EXPECT(near_to(drawn.focal_px[0], camera.focal_px[0], 1e-4) && drawn.eye_m[2] == 4.0);
  close_scene(o);
}

static void test_scene_texts(void) {
  const char* settings[] = {"wind.speed_mps=7.5", "sea.spectrum=true"};
  swell_scene scene = {.size = sizeof scene, .text = "{\"wind\": {\"speed_mps\": 3}}"};
  scene.settings = settings, scene.setting_count = 2;
  swell_world* world = NULL;
  EXPECT(swell_world_create(&scene, &world) == SWELL_OK);
  EXPECT(strstr(swell_world_text(world), "speed_mps = 7.5") != NULL);
  uint64_t hash = 0;
  EXPECT(swell_world_hash(world, &hash) == SWELL_OK && hash != 0);
  swell_world_destroy(world);

  size_t found = 0;
  for (size_t i = 0; i < swell_key_count(); ++i) {
    swell_key key = {.size = sizeof key};
    EXPECT(swell_key_info(i, &key) == SWELL_OK && *key.name && *key.allowed && *key.meaning);
    found += strcmp(key.name, "wind.speed_mps") == 0 && strcmp(key.unit, "m/s") == 0;
    found += strcmp(key.table, "object") == 0 && strcmp(key.name, "kind") == 0;
  }
  EXPECT(found == 2);
}

/* ---- Errors */

static void expect_fault(swell_status status, swell_status expected, int line) {
  if (status != expected || *swell_last_error() == '\0' || strchr(swell_last_error(), '\n')) {
    ++faults;
    printf("%s:%d: status %d, expected %d (%s)\n", __FILE__, line, (int)status, (int)expected,
           swell_last_error());
  }
}
#define BAD(call) expect_fault(call, SWELL_BAD_ARGUMENT, __LINE__)
#define BAD_SCENE(call) expect_fault(call, SWELL_BAD_SCENE, __LINE__)

static swell_status ask_at(swell_session* session, double t_s, double x_m, size_t count) {
  const double xy[2] = {x_m, 0.0};
  float height = 0.0f;
  const swell_query query = {
      .size = sizeof query, .t_s = t_s, .count = count, .xy_m = xy, .height_m = &height};
  return swell_ask(session, &query);
}

static void test_scene_faults(void) {
  swell_world* world = NULL;
  swell_scene scene = {.size = sizeof scene};
  BAD(swell_world_create(NULL, &world));
  BAD(swell_world_create(&scene, NULL));
  BAD(swell_world_create(&scene, &world)); /* neither path nor text */
  BAD(swell_world_load(NULL, &world));
  scene.text = "", scene.size = offsetof(swell_scene, text) + 5; /* a part of a pointer */
  BAD(swell_world_create(&scene, &world));
  scene.size = sizeof scene, scene.path = "x.toml";
  BAD(swell_world_create(&scene, &world));
  scene.path = NULL, scene.threads = -1;
  BAD(swell_world_create(&scene, &world));
  scene.threads = 1 << 30;
  BAD(swell_world_create(&scene, &world));
  scene.threads = 1, scene.setting_count = 1;
  BAD(swell_world_create(&scene, &world));
  scene.setting_count = SIZE_MAX;
  BAD(swell_world_create(&scene, &world));
  const char* settings[] = {"wind.speed_mps=900", NULL};
  scene.settings = settings, scene.setting_count = 2;
  BAD(swell_world_create(&scene, &world));
  scene.setting_count = 1;
  BAD_SCENE(swell_world_create(&scene, &world));
  EXPECT(strstr(swell_last_error(), "wind.speed_mps, got 900, allowed 0 to 60 m/s"));
  BAD_SCENE(swell_world_load("/nowhere/x.toml", &world));
  BAD_SCENE(swell_world_load("/", &world));
  BAD_SCENE(swell_world_load("", &world));
  EXPECT(world == NULL);
  BAD(swell_object_info(NULL, 0, NULL));
  BAD(swell_world_hash(NULL, NULL));
  swell_key key = {.size = sizeof key};
  BAD(swell_key_info(SIZE_MAX, &key));
  BAD(swell_key_info(0, NULL));
  EXPECT(swell_object_count(NULL) == 0 && *swell_world_text(NULL) == '\0');
  EXPECT(swell_class_name(NULL, 0) == NULL);
  swell_world_destroy(NULL);
  swell_session_destroy(NULL);
  swell_picture_destroy(NULL);
}

static void test_camera_faults(Opened o) {
  const double eye[3] = {0, 0, 4};
  const double bad[] = {kNotANumber, INFINITY, -INFINITY, kHuge, -kHuge};
  swell_camera camera = {.size = sizeof camera};
  BAD(swell_camera_look(NULL, 0, 0, 0, 50, 9, 9, &camera));
  EXPECT(swell_camera_look(eye, 0, 0, 0, 50, 96, 64, &camera) == SWELL_OK);
  camera.projection = 3;
  swell_frame unknown = small_frame();
  unknown.camera = &camera;
  BAD(swell_render(o.session, &unknown, o.picture));
  BAD(swell_camera_look(eye, 0, 0, 0, 50, 9, 9, NULL));
  BAD(swell_camera_look(eye, 0, 0, 0, 0, 9, 9, &camera));
  BAD(swell_camera_look(eye, 0, 0, 0, 50, 0, 9, &camera));
  BAD(swell_camera_look(eye, 0, 0, 0, 50, 9, INT32_MAX, &camera));
  BAD(swell_scene_camera(NULL, 0, 9, 9, &camera));
  BAD(swell_scene_camera(o.session, 0, 9, 9, NULL));
  BAD(swell_scene_camera(o.session, kNotANumber, 9, 9, &camera));
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
    const double bad_eye[3] = {0, bad[i], 0};
    BAD(swell_camera_look(bad_eye, 0, 0, 0, 50, 9, 9, &camera));
    BAD(swell_camera_look(eye, bad[i], 0, 0, 50, 9, 9, &camera));
    BAD(swell_camera_look(eye, 0, bad[i], 0, 50, 9, 9, &camera));
    BAD(swell_camera_look(eye, 0, 0, bad[i], 50, 9, 9, &camera));
    BAD(swell_camera_look(eye, 0, 0, 0, bad[i], 9, 9, &camera));
    /* Each number of a camera in turn, those of fisheyes in one. */
    double* const numbers[] = {camera.eye_m, camera.fisheye_k};
    const size_t counts[] = {
        (offsetof(swell_camera, projection) - offsetof(swell_camera, eye_m)) / sizeof(double),
        (sizeof camera - offsetof(swell_camera, fisheye_k)) / sizeof(double)};
    for (size_t part = 0; part < 2; ++part)
      for (size_t n = 0; n < counts[part]; ++n) {
        EXPECT(swell_camera_look(eye, 0, 0, 0, 50, 96, 64, &camera) == SWELL_OK);
        if (part == 1) camera.projection = SWELL_FISHEYE;
        numbers[part][n] = bad[i];
        swell_frame frame = small_frame();
        frame.camera = &camera;
        BAD(swell_render(o.session, &frame, o.picture));
      }
  }
  EXPECT(swell_camera_look(eye, 0, 0, 0, 50, 96, 64, &camera) == SWELL_OK);
  memset(camera.quaternion_wxyz, 0, sizeof camera.quaternion_wxyz);
  swell_frame frame = small_frame();
  frame.camera = &camera;
  BAD(swell_render(o.session, &frame, o.picture));
}

static void test_frame_faults(Opened o) {
  swell_frame frame = small_frame();
  BAD(swell_render(NULL, &frame, o.picture));
  BAD(swell_render(o.session, NULL, o.picture));
  BAD(swell_render(o.session, &frame, NULL));
#define BAD_FRAME(member, value)                     \
  do {                                               \
    frame = small_frame();                           \
    frame.member = value;                            \
    BAD(swell_render(o.session, &frame, o.picture)); \
  } while (false)
  BAD_FRAME(size, 0);
  BAD_FRAME(size, SIZE_MAX);
  BAD_FRAME(t_s, kNotANumber);
  BAD_FRAME(t_s, kHuge);
  BAD_FRAME(width_px, 0);
  BAD_FRAME(width_px, INT32_MIN);
  BAD_FRAME(height_px, 8193);
  BAD_FRAME(labels, "depth,deepness");
  BAD_FRAME(labels, ",");
  BAD_FRAME(without, "waves");
  BAD_FRAME(next_frame_s, -1.0);
  BAD_FRAME(next_frame_s, kNotANumber);
  BAD_FRAME(water_triangles, 1);
  BAD_FRAME(terrain_triangles, INT32_MAX);
  BAD_FRAME(lookup_scale, kNotANumber);
  BAD_FRAME(lookup_scale, 2.0);
  BAD_FRAME(edge_samples, 3);
  BAD_FRAME(pose_count, 1);
  BAD_FRAME(pose_count, SIZE_MAX);
  swell_pose pose = {.size = sizeof pose, .object = 7, .quaternion_wxyz = {1}};
  frame = small_frame();
  frame.poses = &pose, frame.pose_count = 1;
  BAD(swell_render(o.session, &frame, o.picture));
  pose.object = 0, pose.position_m[0] = kNotANumber;
  BAD(swell_render(o.session, &frame, o.picture));
  pose.position_m[0] = 0, pose.quaternion_wxyz[0] = 0;
  BAD(swell_render(o.session, &frame, o.picture));
  pose.quaternion_wxyz[0] = kNotANumber;
  BAD(swell_render(o.session, &frame, o.picture));

  /* Nothing has been drawn. */
  swell_pick pick = {.size = sizeof pick};
  uint64_t hash = 0;
  swell_plane p = {.size = sizeof p};
  swell_camera camera = {.size = sizeof camera};
  BAD(swell_pick_at(o.session, 1, 1, &pick));
  BAD(swell_picture_hash(o.picture, &hash));
  BAD(swell_picture_plane(o.picture, "rgba", &p));
  BAD(swell_picture_camera(o.picture, &camera));
  frame = small_frame();
  EXPECT(swell_render(o.session, &frame, o.picture) == SWELL_OK);
  BAD(swell_pick_at(o.session, kNotANumber, 1, &pick));
  BAD(swell_pick_at(o.session, 1, kHuge, &pick));
  BAD(swell_pick_at(o.session, 1, 1, NULL));
  BAD(swell_picture_plane(o.picture, NULL, &p));
  BAD(swell_picture_plane(o.picture, "rgb", &p));
  BAD(swell_picture_plane(o.picture, "rgba", NULL));
  BAD(swell_picture_copy(o.picture, "rgba", NULL, 96 * 64 * 4));
  BAD(swell_picture_copy(o.picture, "rgba", &p, SIZE_MAX));
  BAD(swell_pick_at(NULL, 1, 1, &pick));
  BAD(swell_picture_plane(NULL, "rgba", &p));
  BAD(swell_picture_copy(NULL, "rgba", &p, sizeof p));
  BAD(swell_picture_copy(o.picture, NULL, &p, sizeof p));
  BAD(swell_picture_hash(NULL, &hash));
  BAD(swell_picture_hash(o.picture, NULL));
  BAD(swell_picture_camera(NULL, &camera));
  BAD(swell_picture_camera(o.picture, NULL));
  BAD(swell_picture_create(NULL));

  swell_camera bad = {.size = sizeof bad, .near_m = kNotANumber};
  BAD_FRAME(next_camera, &bad);
  BAD_FRAME(next_pose_count, 1);
  BAD_FRAME(disturbance_count, SIZE_MAX);
  frame = small_frame();
  BAD(swell_frame_camera(NULL, &frame, &camera));
  BAD(swell_frame_camera(o.session, NULL, &camera));
  BAD(swell_frame_camera(o.session, &frame, NULL));
  frame.t_s = -INFINITY;
  BAD(swell_frame_camera(o.session, &frame, &camera));
}

static void test_query_faults(Opened o) {
  BAD(swell_ask(NULL, NULL));
  BAD(swell_ask(o.session, NULL));
  BAD(ask_at(o.session, kNotANumber, 0, 1));
  BAD(ask_at(o.session, kHuge, 0, 1));
  BAD(ask_at(o.session, 0, kNotANumber, 1));
  BAD(ask_at(o.session, 0, INFINITY, 1));
  BAD(ask_at(o.session, 0, 1e9, 1));
  BAD(ask_at(o.session, 0, 0, SIZE_MAX));
  EXPECT(ask_at(o.session, 0, kNotANumber, 0) == SWELL_OK);
  EXPECT(ask_at(o.session, -1e12, -9e8, 1) == SWELL_OK);
  swell_query query = {.size = sizeof query, .count = 1};
  BAD(swell_ask(o.session, &query)); /* no points */
  const double from[3] = {0, 0, 1}, nowhere[3] = {0, 0, 0}, bad[3] = {0, kNotANumber, 0};
  swell_hit hit = {.size = sizeof hit};
  BAD(swell_ray(o.session, 0, NULL, from, 9, &hit));
  BAD(swell_ray(o.session, 0, from, NULL, 9, &hit));
  BAD(swell_ray(o.session, 0, from, nowhere, 9, &hit));
  BAD(swell_ray(o.session, 0, from, bad, 9, &hit));
  BAD(swell_ray(o.session, 0, bad, from, 9, &hit));
  BAD(swell_ray(o.session, 0, from, from, kHuge, &hit));
  BAD(swell_ray(o.session, 0, from, from, 0, &hit));
  BAD(swell_ray(o.session, 0, from, from, 9, NULL));
  BAD(swell_object_poses(o.session, 0, NULL, 1));
  swell_pose pose = {.size = 3};
  BAD(swell_object_poses(o.session, 0, &pose, 1));
  pose.size = sizeof pose;
  BAD(swell_object_poses(o.session, 0, &pose, 2));
  BAD(swell_object_poses(o.session, kNotANumber, &pose, 1));
  BAD(swell_object_poses(o.session, kHuge, &pose, 1));
  BAD(swell_object_poses(o.session, 0, &pose, SIZE_MAX));
  BAD(swell_object_poses(NULL, 0, &pose, 1));
  BAD(swell_ray(NULL, 0, from, from, 9, &hit));
  BAD(swell_ray(o.session, kHuge, from, from, 9, &hit));
  swell_object object = {.size = sizeof object};
  BAD(swell_object_info(o.world, SIZE_MAX, &object));
  BAD(swell_object_info(o.world, 0, NULL));
  BAD(swell_world_hash(o.world, NULL));
  EXPECT(swell_class_name(o.world, UINT32_MAX) == NULL);
  BAD(swell_session_create(NULL, 1, &o.session));
  BAD(swell_session_create(o.world, 1, NULL));
  BAD(swell_session_create(o.world, -5, &o.session));
  BAD(swell_session_create(o.world, 1000000, &o.session));
}

/* ---- What disturbs the water */

/* A drop is a hump of known height at its moment; after it the water has the same volume. */
static void test_disturbances(void) {
  const Opened o = open_scene(SMALL);
  const double at[4] = {0, 30, 0, 900};
  float height[2];
  swell_disturbance drop = {.size = sizeof drop, .kind = SWELL_DROP, .position_m = {0, 30}};
  drop.t_s = 2.0, drop.radius_m = 3.0, drop.height_m = 0.5;
  swell_query query = {.size = sizeof query, .t_s = 2.0, .count = 2, .xy_m = at};
  query.height_m = height, query.disturbances = &drop, query.disturbance_count = 1;
  EXPECT(swell_ask(o.session, &query) == SWELL_OK);
  EXPECT(near_to(height[0], 0.5, 0.02) && height[1] == 0.0f);
  query.t_s = 3.5;
  EXPECT(swell_ask(o.session, &query) == SWELL_OK && height[0] < 0.1f && height[0] != 0.0f);
  query.disturbance_count = 0; /* the same time without: nothing is left of it */
  EXPECT(swell_ask(o.session, &query) == SWELL_OK && height[0] == 0.0f);

  swell_camera camera = {.size = sizeof camera};
  const double eye[3] = {0, 0, 4};
  EXPECT(swell_camera_look(eye, 0, -8, 0, 50, 96, 64, &camera) == SWELL_OK);
  swell_frame frame = small_frame();
  frame.camera = &camera, frame.labels = "elevation";
  frame.disturbances = &drop, frame.disturbance_count = 1;
  EXPECT(swell_render(o.session, &frame, o.picture) == SWELL_OK);
  float most = 0.0f;
  for (size_t i = 0; i < 96 * 64; ++i)
    most = fmaxf(most, ((const float*)plane(o, "elevation").data)[i]);
  EXPECT(most > 0.3f && most < 0.51f);

  /* A hull's wake lies behind it, within Kelvin's angle. */
  const double path[4] = {0, -100, 0, 1000}, around[4] = {4, -20, 40, 0};
  swell_disturbance hull = {
      .size = sizeof hull, .kind = SWELL_HULL, .path_m = path, .path_count = 2};
  hull.path_open = 1, hull.speed_mps = 5.0;
  query.t_s = 20.0, query.disturbances = &hull, query.disturbance_count = 1, query.xy_m = around;
  EXPECT(swell_ask(o.session, &query) == SWELL_OK);
  EXPECT(fabsf(height[0]) > 1e-3f && fabsf(height[1]) < 1e-3f);

  const struct {
    swell_disturbance given;
    size_t count;
  } wrong[] = {
      {{.size = sizeof drop, .kind = 9}, 1},
      {{.size = sizeof drop, .kind = SWELL_HULL}, 1},
      {{.size = sizeof drop, .kind = SWELL_HULL, .path_m = path, .path_count = 1}, 1},
      {{.size = sizeof drop, .kind = SWELL_HULL, .path_count = 2}, 1},
      {{.size = sizeof drop, .kind = SWELL_HULL, .path_m = path, .path_count = SIZE_MAX}, 1},
      {{.size = sizeof drop, .height_m = 99}, 1},
      {{.size = sizeof drop, .radius_m = NAN}, 1},
      {{.size = sizeof drop, .position_m = {0, 1e300}}, 1},
      {{.size = 3}, 1},
      {drop, SIZE_MAX}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
    query.disturbances = frame.disturbances = &wrong[i].given;
    query.disturbance_count = frame.disturbance_count = wrong[i].count;
    BAD(swell_ask(o.session, &query));
    BAD(swell_render(o.session, &frame, o.picture));
  }
  frame.disturbances = NULL, frame.disturbance_count = 1;
  BAD(swell_render(o.session, &frame, o.picture));
  close_scene(o);
}

/* Several frames of one time: each as it is alone, labels too, and what is refused. */
static void test_many_frames(void) {
  enum { kCount = 5 };
  const Opened o = open_scene(SMALL BUOY);
  swell_frame frames[kCount];
  const swell_frame* given[kCount];
  swell_picture* pictures[kCount];
  swell_camera camera = {.size = sizeof camera};
  for (int k = 0; k < kCount; ++k) {
    frames[k] = small_frame();
    frames[k].width_px += k;
    frames[k].labels = k == 2 ? "id,depth" : NULL;
    given[k] = &frames[k];
    EXPECT(swell_picture_create(&pictures[k]) == SWELL_OK);
  }
  EXPECT(swell_frame_camera(o.session, &frames[1], &camera) == SWELL_OK);
  camera.eye_m[2] += 20.0;
  frames[1].camera = &camera;
  EXPECT(swell_render_many(o.session, given, pictures, kCount) == SWELL_OK);
  for (int k = 0; k < kCount; ++k) {
    uint64_t alone = 0, among_others = 1;
    EXPECT(swell_render(o.session, &frames[k], o.picture) == SWELL_OK);
    EXPECT(swell_picture_hash(o.picture, &alone) == SWELL_OK);
    EXPECT(swell_picture_hash(pictures[k], &among_others) == SWELL_OK);
    EXPECT(alone == among_others);
  }
  swell_plane ids = {.size = sizeof ids};
  EXPECT(swell_picture_plane(pictures[2], "id", &ids) == SWELL_OK && ids.width_px == 98);

  EXPECT(swell_render_many(o.session, NULL, NULL, 0) == SWELL_OK);
  BAD(swell_render_many(o.session, NULL, pictures, 1));
  BAD(swell_render_many(o.session, given, NULL, 1));
  BAD(swell_render_many(NULL, given, pictures, 1));
  BAD(swell_render_many(o.session, given, pictures, 65537));
  frames[4].t_s += 1.0;
  BAD(swell_render_many(o.session, given, pictures, kCount));
  frames[4] = frames[0];
  frames[4].without = "haze";
  BAD(swell_render_many(o.session, given, pictures, kCount));
  given[4] = NULL;
  BAD(swell_render_many(o.session, given, pictures, kCount));
  given[4] = &frames[3];
  swell_picture* const last = pictures[4];
  pictures[4] = pictures[3];
  expect_fault(swell_render_many(o.session, given, pictures, kCount), SWELL_BUSY, __LINE__);
  pictures[4] = NULL;
  BAD(swell_render_many(o.session, given, pictures, kCount));
  pictures[4] = last;
  EXPECT(swell_render_many(o.session, given, pictures, kCount) == SWELL_OK);
  for (int k = 0; k < kCount; ++k) swell_picture_destroy(pictures[k]);
  close_scene(o);
}

static void test_names(void) {
  EXPECT(strcmp(swell_label_name(0), "depth") == 0 && swell_label_name(1000) == NULL);
  EXPECT(strcmp(swell_part_name(0), "water") == 0 && swell_part_name(SIZE_MAX) == NULL);
}

/* Structures of an earlier and of a later version. */
static void test_versions(Opened o) {
  struct {
    swell_frame known;
    double later[3];
  } frame = {.known = small_frame()};
  frame.known.size = sizeof frame;
  EXPECT(swell_render(o.session, &frame.known, o.picture) == SWELL_OK);
  frame.later[2] = 1.0;
  BAD(swell_render(o.session, &frame.known, o.picture));
  frame.known = small_frame();
  frame.known.size = offsetof(swell_frame, labels);
  frame.known.labels = "what an earlier version does not read";
  EXPECT(swell_render(o.session, &frame.known, o.picture) == SWELL_OK);
  swell_plane p = {.size = offsetof(swell_plane, type), .components = -7};
  EXPECT(swell_picture_plane(o.picture, "rgba", &p) == SWELL_OK);
  EXPECT(p.bytes == 96 * 64 * 4 && p.components == -7);
}

/* ---- Threads */

typedef struct Drawing {
  Opened opened;
  uint64_t hash;
  int drawn, busy, others;
} Drawing;

static void* draw_some(void* data) {
  Drawing* const drawing = data;
  const swell_frame frame = small_frame();
  for (int i = 0; i < 10; ++i) {
    const swell_status status =
        swell_render(drawing->opened.session, &frame, drawing->opened.picture);
    drawing->drawn += status == SWELL_OK;
    drawing->busy += status == SWELL_BUSY;
    drawing->others += status != SWELL_OK && status != SWELL_BUSY;
  }
  swell_picture_hash(drawing->opened.picture, &drawing->hash);
  return NULL;
}

static void test_threads(bool same_session) {
  const Opened first = open_scene(SMALL BUOY);
  Opened second = first;
  EXPECT(swell_picture_create(&second.picture) == SWELL_OK);
  if (!same_session) EXPECT(swell_session_create(first.world, 1, &second.session) == SWELL_OK);
  Drawing drawings[2] = {{.opened = first}, {.opened = second}};
  pthread_t threads[2];
  for (int i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, draw_some, &drawings[i]);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  for (int i = 0; i < 2; ++i) {
    EXPECT(drawings[i].others == 0 && drawings[i].drawn + drawings[i].busy == 10);
    if (!same_session) EXPECT(drawings[i].drawn == 10);
  }
  if (drawings[0].drawn > 0 && drawings[1].drawn > 0)
    EXPECT(drawings[0].hash == drawings[1].hash && drawings[0].hash != 0);
  if (!same_session) swell_session_destroy(second.session);
  swell_picture_destroy(second.picture);
  close_scene(first);
}

/* ---- Memory */

/* A session has its world as long as it lives. */
static void test_session_without_world(void) {
  const swell_frame frame = small_frame();
  const Opened o = open_scene(SMALL BUOY);
  uint64_t hash[2] = {0, 1};
  EXPECT(swell_render(o.session, &frame, o.picture) == SWELL_OK);
  EXPECT(swell_picture_hash(o.picture, &hash[0]) == SWELL_OK);
  swell_world_destroy(o.world);
  EXPECT(swell_render(o.session, &frame, o.picture) == SWELL_OK);
  EXPECT(swell_picture_hash(o.picture, &hash[1]) == SWELL_OK && hash[0] == hash[1]);
  EXPECT(ask_at(o.session, 3.0, 1.0, 1) == SWELL_OK);
  close_scene((Opened){NULL, o.session, o.picture});
}

static long resident_kb(void) {
  long kb = 0;
  char line[256];
  FILE* const status = fopen("/proc/self/status", "r");
  while (status && fgets(line, sizeof line, status))
    if (strncmp(line, "VmRSS:", 6) == 0) kb = atol(line + 6);
  if (status) fclose(status);
  return kb;
}

static void test_many_worlds(int count) {
  const swell_frame frame = small_frame();
  long settled_kb = 0;
  for (int i = 0; i < count; ++i) {
    const Opened o = open_scene(SMALL BUOY);
    EXPECT(swell_render(o.session, &frame, o.picture) == SWELL_OK);
    EXPECT(ask_at(o.session, 1, 2, 1) == SWELL_OK);
    close_scene(o);
    if (i == count / 2) settled_kb = resident_kb();
  }
  const long grown_kb = resident_kb() - settled_kb;
  printf("%d worlds: %ld MB, grown by %ld kB over the second half\n", count, resident_kb() / 1024,
         grown_kb);
#ifndef SWELL_SANITIZED                     /* the checks keep what is freed */
  EXPECT(grown_kb < 8 * 1024 + 4L * count); /* a world takes 40 MB */
#endif
}

int main(int argc, char** argv) {
  EXPECT(*swell_last_error() == '\0' && *swell_version() != '\0');
  test_still_water();
  test_sine();
  test_picture();
  test_scene_texts();
  test_scene_faults();
  test_disturbances();
  test_many_frames();
  test_names();
  const Opened o = open_scene(SMALL BUOY);
  test_camera_faults(o);
  test_frame_faults(o);
  test_query_faults(o);
  test_versions(o);
  close_scene(o);
  test_threads(false);
  test_threads(true);
  test_session_without_world();
  test_many_worlds(argc > 1 ? atoi(argv[1]) : 20);
  printf("%s: %d faults\n", argv[0], faults);
  return faults == 0 ? 0 : 1;
}
