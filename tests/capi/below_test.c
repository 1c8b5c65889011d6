/* Below the surface from C: known answers, errors, the same bits. */
#include <math.h>
#include <string.h>

#include "expect.h"

/* A wave of 60 m that runs east. */
#define WAVE(amplitude)                                              \
  "[sea]\nspectrum = false\n[[sea.sines]]\namplitude_m = " amplitude \
  "\nwavelength_m = 60.0\nto_deg = 90.0\n"

static const double kTurn = 6.283185307179586;

static bool near_to(double a, double b, double tolerance) { return fabs(a - b) <= tolerance; }

typedef struct Opened {
  swell_world* world;
  swell_session* session;
} Opened;

static Opened open_scene(const char* text) {
  Opened opened = {NULL, NULL};
  const swell_scene scene = {.size = sizeof scene, .text = text, .threads = 2};
  EXPECT(swell_world_create(&scene, &opened.world) == SWELL_OK);
  EXPECT(swell_session_create(opened.world, 2, &opened.session) == SWELL_OK);
  return opened;
}

static void close_scene(Opened opened) {
  swell_world_destroy(opened.world);
  swell_session_destroy(opened.session);
}

static void check_wave(void) {
  const Opened opened = open_scene(WAVE("1.0"));
  const double k = kTurn / 60.0, omega = sqrt(9.81 * k), t_s = 3.0;
  double xyz[5][3];
  float v[5][3], a[5][3], p[5], z;
  uint8_t place[5];
  const double xy[2] = {7.0, 4.0};
  const swell_query query = {
      .size = sizeof query, .t_s = t_s, .count = 1, .xy_m = xy, .height_m = &z};
  EXPECT(swell_ask(opened.session, &query) == SWELL_OK);
  const double below_m[5] = {-0.5, 0.0, 2.0, 9.0, 25.0};
  for (int i = 0; i < 5; ++i) {
    xyz[i][0] = xy[0], xyz[i][1] = xy[1];
    xyz[i][2] = z - below_m[i];
  }
  swell_below below = {.size = sizeof below,
                       .t_s = t_s,
                       .count = 5,
                       .xyz_m = xyz[0],
                       .velocity_mps = v[0],
                       .acceleration_mps2 = a[0],
                       .pressure_pa = p,
                       .place = place};
  EXPECT(swell_ask_below(opened.session, &below) == SWELL_OK);
  EXPECT(place[0] == SWELL_ABOVE_WATER && v[0][0] == 0.0f && a[0][2] == 0.0f && p[0] == 0.0f);
  const double side = sqrt(1.0 - z * z); /* of the wave's circle, up to its sign */
  for (int i = 1; i < 5; ++i) {
    const double decay = exp(-k * below_m[i]);
    EXPECT(place[i] == SWELL_IN_WATER);
    EXPECT(near_to(v[i][0], omega * z * decay, 0.002) && near_to(v[i][1], 0.0, 1e-6));
    EXPECT(near_to(fabs(v[i][2]), omega * side * decay, 0.002));
    EXPECT(near_to(fabs(a[i][0]), omega * omega * side * decay, 0.002));
    EXPECT(near_to(a[i][2], -omega * omega * z * decay, 0.002));
    EXPECT(near_to(p[i], 1025.0 * 9.81 * z * decay, 25.0));
  }
  /* Fresh water, the pressure alone. */
  float fresh[5];
  below = (swell_below){.size = sizeof below,
                        .t_s = t_s,
                        .count = 5,
                        .xyz_m = xyz[0],
                        .density_kg_m3 = 1000.0,
                        .pressure_pa = fresh};
  EXPECT(swell_ask_below(opened.session, &below) == SWELL_OK);
  for (int i = 0; i < 5; ++i) EXPECT(near_to(fresh[i], p[i] / 1.025, 1e-6 * fabs(p[i])));
  close_scene(opened);
}

/* A session that has been asked for other times, parts and disturbances gives the same bits. */
static void check_same_bits(void) {
  const Opened a = open_scene("[wind]\nspeed_mps = 9\n"), b = open_scene("[wind]\nspeed_mps = 9\n");
  double xyz[300][3];
  for (int i = 0; i < 300; ++i) {
    xyz[i][0] = 1.7 * i, xyz[i][1] = -0.9 * i;
    xyz[i][2] = -0.03 * i;
  }
  float first[300][3], again[300][3], pressure[300];
  const swell_disturbance drop = {
      .size = sizeof drop, .t_s = 4.0, .height_m = 2.0, .radius_m = 3.0};
  swell_below below = {
      .size = sizeof below, .t_s = 5.0, .count = 300, .xyz_m = xyz[0], .velocity_mps = first[0]};
  EXPECT(swell_ask_below(a.session, &below) == SWELL_OK);
  below.velocity_mps = NULL, below.pressure_pa = pressure;
  EXPECT(swell_ask_below(b.session, &below) == SWELL_OK);
  below.t_s = 6.0;
  EXPECT(swell_ask_below(b.session, &below) == SWELL_OK);
  below.disturbances = &drop, below.disturbance_count = 1;
  EXPECT(swell_ask_below(b.session, &below) == SWELL_OK);
  below.disturbances = NULL, below.disturbance_count = 0;
  below.t_s = 5.0, below.pressure_pa = NULL, below.velocity_mps = again[0];
  EXPECT(swell_ask_below(b.session, &below) == SWELL_OK);
  EXPECT(memcmp(first, again, sizeof first) == 0);
  close_scene(a);
  close_scene(b);
}

/* A box of 2 x 3 x 1 m whose top is at this height. */
static const uint32_t kBox[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                     {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                     {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
static void make_box(double top_m, double (*xyz)[3]) {
  for (int i = 0; i < 8; ++i) {
    xyz[i][0] = i & 1 ? 1.0 : -1.0;
    xyz[i][1] = i & 2 ? 1.5 : -1.5;
    xyz[i][2] = top_m - (i & 4 ? 0.0 : 1.0);
  }
}

static void check_hull(void) {
  const Opened still = open_scene("[sea]\nspectrum = false\n");
  double xyz[8][3];
  make_box(0.6, xyz);
  swell_hull hull = {.size = sizeof hull,
                     .t_s = 1.0,
                     .xyz_m = xyz[0],
                     .point_count = 8,
                     .triangles = kBox[0],
                     .triangle_count = 12,
                     .about_m = {1.0, 0.0, 0.0}};
  swell_loads loads = {.size = sizeof loads};
  EXPECT(swell_hull_loads(still.session, &hull, &loads) == SWELL_OK);
  const double lift_n = 1025.0 * 9.81 * 2.0 * 3.0 * 0.4;
  EXPECT(near_to(loads.buoyancy_n[2], lift_n, 1e-6 * lift_n));
  EXPECT(near_to(loads.buoyancy_n[0], 0.0, 1e-6 * lift_n));
  EXPECT(near_to(loads.buoyancy_nm[1], lift_n, 1e-6 * lift_n)); /* 1 m west of about_m */
  EXPECT(loads.froude_krylov_n[0] == 0.0 && loads.froude_krylov_n[2] == 0.0);
  close_scene(still);

  const Opened wave = open_scene(WAVE("0.02"));
  make_box(-3.0, xyz);
  EXPECT(swell_hull_loads(wave.session, &hull, &loads) == SWELL_OK);
  const double centre[3] = {0.0, 0.0, -3.5};
  float a[3];
  const swell_below below = {
      .size = sizeof below, .t_s = 1.0, .count = 1, .xyz_m = centre, .acceleration_mps2 = a};
  EXPECT(swell_ask_below(wave.session, &below) == SWELL_OK);
  for (int c = 0; c < 3; c += 2)
    EXPECT(near_to(loads.froude_krylov_n[c], 1025.0 * 6.0 * a[c], 0.0006 * 1025.0 * 6.0));
  EXPECT(fabs(loads.froude_krylov_n[0]) + fabs(loads.froude_krylov_n[2]) > 50.0);
  close_scene(wave);
}

static void expect_refused(swell_status status, const char* text) {
  EXPECT(status == SWELL_BAD_ARGUMENT);
  if (strstr(swell_last_error(), text) == NULL) {
    ++faults;
    printf("got '%s', not '%s'\n", swell_last_error(), text);
  }
}

static void check_errors(void) {
  const Opened opened = open_scene("[sea]\nspectrum = false\n");
  double xyz[3] = {0.0, 0.0, -1.0};
  float v[3];
  const swell_below good = {
      .size = sizeof good, .t_s = 1.0, .count = 1, .xyz_m = xyz, .velocity_mps = v};
  EXPECT(swell_ask_below(opened.session, &good) == SWELL_OK);
  expect_refused(swell_ask_below(NULL, &good), "session, got null");
  expect_refused(swell_ask_below(opened.session, NULL), "below, got null");
  swell_below bad = good;
  bad.size = 3;
  expect_refused(swell_ask_below(opened.session, &bad), "below.size, got 3");
  bad = good, bad.t_s = NAN;
  expect_refused(swell_ask_below(opened.session, &bad), "t_s, got nan");
  bad = good, bad.xyz_m = NULL;
  expect_refused(swell_ask_below(opened.session, &bad), "below.xyz_m, got null");
  bad = good, bad.count = SIZE_MAX / 8;
  expect_refused(swell_ask_below(opened.session, &bad), "below.xyz_m: their count");
  bad = good, bad.density_kg_m3 = -1.0;
  expect_refused(swell_ask_below(opened.session, &bad), "below.density_kg_m3, got -1");
  const double wrong[5] = {NAN, INFINITY, -INFINITY, 1e10, 1e300};
  for (int i = 0; i < 15; ++i) {
    double place[3] = {0.0, 0.0, -1.0};
    place[i % 3] = wrong[i / 3];
    bad = good, bad.xyz_m = place;
    expect_refused(swell_ask_below(opened.session, &bad), "below.xyz_m[0], got ");
  }
  xyz[2] = 1e7; /* far above: no fault */
  uint8_t place = 9;
  bad = good, bad.place = &place;
  EXPECT(swell_ask_below(opened.session, &bad) == SWELL_OK && place == SWELL_ABOVE_WATER);
  bad.count = 0, bad.xyz_m = NULL;
  EXPECT(swell_ask_below(opened.session, &bad) == SWELL_OK);

  double points[8][3];
  make_box(0.0, points);
  uint32_t triangle[3] = {0, 1, 2};
  const swell_hull hull = {.size = sizeof hull,
                           .xyz_m = points[0],
                           .point_count = 8,
                           .triangles = triangle,
                           .triangle_count = 1};
  swell_loads loads = {.size = sizeof loads};
  EXPECT(swell_hull_loads(opened.session, &hull, &loads) == SWELL_OK);
  expect_refused(swell_hull_loads(opened.session, NULL, &loads), "hull, got null");
  expect_refused(swell_hull_loads(opened.session, &hull, NULL), "loads, got null");
  triangle[1] = 8;
  expect_refused(swell_hull_loads(opened.session, &hull, &loads),
                 "hull.triangles[0], got point 8, allowed below 8");
  triangle[1] = 1;
  swell_hull odd = hull;
  odd.triangles = NULL;
  expect_refused(swell_hull_loads(opened.session, &odd, &loads), "hull.triangles, got null");
  odd = hull, odd.about_m[2] = NAN;
  expect_refused(swell_hull_loads(opened.session, &odd, &loads), "hull.about_m[0], got z = nan");
  points[3][1] = INFINITY;
  expect_refused(swell_hull_loads(opened.session, &hull, &loads), "hull.xyz_m[3], got inf");
  close_scene(opened);
}

int main(void) {
  check_wave();
  check_same_bits();
  check_hull();
  check_errors();
  return faults != 0;
}
