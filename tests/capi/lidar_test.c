/* Lidars of the C interface: known answers, and calls that are refused in one line. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <swell.h>

#include "expect.h"

#define STILL                                                                                  \
  "[sky]\nzenith = [0.1, 0.2, 0.4]\nhorizon = [0.5, 0.6, 0.7]\n[sea]\nspectrum = false\n"      \
  "[[object]]\nkind = \"box\"\nmotion = \"fixed\"\nposition_m = [20, 0]\nsize_m = [4, 4, 4]\n" \
  "draught = 0.5\n"
enum { kBeams = 3 };

static const double kBeamList[3 * kBeams] = {0, 0, 0, 90, -30, 0, 45, 20, 0};

static swell_lidar straight(void) {
  const swell_lidar lidar = {.size = sizeof lidar,
                             .position_m = {0, 0, 1},
                             .quaternion_wxyz = {1, 0, 0, 0},
                             .beams = kBeamList,
                             .count = kBeams};
  return lidar;
}

static void test_known_answers(swell_session* session) {
  float range[kBeams], intensity[kBeams], incidence[kBeams], point[3 * kBeams];
  uint32_t id[kBeams], klass[kBeams];
  swell_lidar lidar = straight();
  EXPECT(swell_scan(session, &lidar) == SWELL_OK); /* nothing is wanted */
  lidar.range_m = range, lidar.intensity = intensity, lidar.incidence_deg = incidence;
  lidar.id = id, lidar.klass = klass, lidar.point_m = point;
  EXPECT(swell_scan(session, &lidar) == SWELL_OK);
  EXPECT(fabs(range[0] - 18.0) < 1e-4 && id[0] == 16 && klass[0] == 3);
  EXPECT(fabs(incidence[0]) < 1e-3 && fabs(point[0] - 18.0) < 1e-4 && fabs(point[1]) < 1e-4);
  EXPECT(fabs(range[1] - 2.0) < 1e-4 && id[1] == 1 && fabs(incidence[1] - 60.0) < 1e-2);
  EXPECT(isinf(range[2]) && id[2] == 0 && klass[2] == 0 && isnan(point[6]));
  lidar.duration_s = 0.1;
  memcpy(lidar.end_position_m, lidar.position_m, sizeof lidar.position_m);
  lidar.end_quaternion_wxyz[0] = 2; /* of any length */
  lidar.moments = 3;
  EXPECT(swell_scan(session, &lidar) == SWELL_OK && fabs(range[0] - 18.0) < 1e-4);
  lidar = straight();
  lidar.range_m = range;
  lidar.most_m = 10;
  EXPECT(swell_scan(session, &lidar) == SWELL_OK && isinf(range[0]) && !isinf(range[1]));
}

static void test_patterns(void) {
  size_t models = 0;
  for (; swell_lidar_name(models); ++models)
    EXPECT(swell_lidar_beams(swell_lidar_name(models)) > 0);
  EXPECT(models == 4 && swell_lidar_name(SIZE_MAX) == NULL);
  EXPECT(swell_lidar_beams("vlp-16") == 16 && swell_lidar_beams("no") == 0);
  EXPECT(swell_lidar_beams(NULL) == 0);
  double beams[3 * 64];
  EXPECT(swell_spinning_beams("vlp-16", 4, 90, 0.2, beams, 64) == SWELL_OK);
  EXPECT(fabs(beams[0] - 90) < 1e-9 && fabs(beams[1] + 15) < 1e-9 && beams[2] == 0);
  EXPECT(fabs(beams[3 * 16]) < 1e-9 && fabs(beams[3 * 16 + 2] - 0.05) < 1e-12);
  EXPECT(swell_grid_beams(8, 8, 80, 40, 0, beams, 64) == SWELL_OK);
  EXPECT(fabs(beams[0] - 35) < 1e-9 && fabs(beams[1] - 17.5) < 1e-9);
}

static void expect_refused(swell_status status, int line) {
  if (status == SWELL_BAD_ARGUMENT && *swell_last_error() && !strchr(swell_last_error(), '\n'))
    return;
  ++faults;
  printf("%s:%d: status %d (%s)\n", __FILE__, line, (int)status, swell_last_error());
}
#define REFUSED(call) expect_refused(call, __LINE__)
#define REFUSED_WITH(member, value)                         \
  do {                                                      \
    swell_lidar spoilt = straight();                        \
    spoilt.member = value;                                  \
    expect_refused(swell_scan(session, &spoilt), __LINE__); \
  } while (0)

static void test_refused_scans(swell_session* session) {
  swell_lidar good = straight();
  REFUSED(swell_scan(NULL, &good));
  REFUSED(swell_scan(session, NULL));
  REFUSED_WITH(size, 3);
  REFUSED_WITH(beams, NULL);
  REFUSED_WITH(count, SIZE_MAX);
  REFUSED_WITH(count, SIZE_MAX / 24 + 2);
  const double bad[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300};
  for (int i = 0; i < 5; ++i) {
    REFUSED_WITH(t_s, bad[i]);
    REFUSED_WITH(position_m[1], bad[i]);
    REFUSED_WITH(quaternion_wxyz[2], bad[i]);
    REFUSED_WITH(duration_s, bad[i]);
    REFUSED_WITH(least_m, bad[i]);
    REFUSED_WITH(most_m, bad[i]);
    REFUSED_WITH(reach_m, bad[i]);
    REFUSED_WITH(range_noise_m, bad[i]);
    for (int k = 0; k < 3; ++k) {
      double beams[3 * kBeams] = {0};
      beams[3 + k] = bad[i];
      REFUSED_WITH(beams, beams);
      EXPECT(strstr(swell_last_error(), "beams[1]"));
    }
  }
  REFUSED_WITH(quaternion_wxyz[0], 0);
  REFUSED_WITH(duration_s, 1); /* without an end's quaternion */
  REFUSED_WITH(moments, 2);    /* without a duration */
  REFUSED_WITH(moments, -1);
  REFUSED_WITH(moments, 65);
  REFUSED_WITH(least_m, 120);
  REFUSED_WITH(pose_count, 1);
  REFUSED_WITH(pose_count, SIZE_MAX);
  REFUSED_WITH(disturbance_count, 1);
  REFUSED_WITH(disturbance_count, SIZE_MAX);
}

static void test_refused_patterns(void) {
  double beams[3 * 16];
  REFUSED(swell_spinning_beams(NULL, 1, 0, 0.1, beams, 16));
  REFUSED(swell_spinning_beams("vlp", 1, 0, 0.1, beams, 16));
  EXPECT(strstr(swell_last_error(), "vlp-16"));
  REFUSED(swell_spinning_beams("vlp-16", 0, 0, 0.1, beams, 0));
  REFUSED(swell_spinning_beams("vlp-16", -1, 0, 0.1, beams, 16));
  REFUSED(swell_spinning_beams("vlp-16", 2, 0, 0.1, beams, 16));
  REFUSED(swell_spinning_beams("vlp-16", 1, NAN, 0.1, beams, 16));
  REFUSED(swell_spinning_beams("vlp-16", 1, 0, -1, beams, 16));
  REFUSED(swell_spinning_beams("vlp-16", 1, 0, 0.1, NULL, 16));
  REFUSED(swell_grid_beams(0, 4, 90, 45, 0, beams, 0));
  REFUSED(swell_grid_beams(4, -4, 90, 45, 0, beams, 16));
  REFUSED(swell_grid_beams(4, 4, 0, 45, 0, beams, 16));
  REFUSED(swell_grid_beams(4, 4, 90, NAN, 0, beams, 16));
  REFUSED(swell_grid_beams(4, 4, 90, 45, INFINITY, beams, 16));
  REFUSED(swell_grid_beams(4, 4, 90, 45, 0, NULL, 16));
  REFUSED(swell_grid_beams(4, 4, 90, 45, 0, beams, 15));
}

int main(void) {
  swell_world* world = NULL;
  swell_session* session = NULL;
  const swell_scene scene = {.size = sizeof scene, .text = STILL, .threads = 2};
  EXPECT(swell_world_create(&scene, &world) == SWELL_OK);
  EXPECT(swell_session_create(world, 2, &session) == SWELL_OK);
  if (!session) return 1;
  test_known_answers(session);
  test_patterns();
  test_refused_scans(session);
  test_refused_patterns();
  swell_session_destroy(session);
  swell_world_destroy(world);
  return faults > 0;
}
