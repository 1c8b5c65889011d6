/* Worlds that are made while their caller watches, from a C11 program: progress, cancelling within
 * 50 ms, lines of log, a bound on memory.
 *   making_test DEADLINE_MS SCENE.toml...
 * 50 ms are what swell.h says, on a machine that does nothing else. */
#define _GNU_SOURCE
#include <malloc.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <swell.h>
#include <time.h>
#include <unistd.h>

#include "expect.h"

static double deadline_s;
enum { kWishes = 6, kTries = 4 };

static double seconds_of(clockid_t clock) {
  struct timespec time;
  clock_gettime(clock, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double now_s(void) { return seconds_of(CLOCK_MONOTONIC); }

/* That all threads of this process have worked. */
static double worked_s(void) { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

/* What a caller sees and wants. */
typedef struct Watch {
  pthread_t thread;
  double start_s, wish_after_s; /* < 0: no wish */
  double wished_s;              /* when it was told; 0: not yet */
  double worked_s;              /* until then */
  const volatile int* wish;     /* of another thread, or null */
  double done;
  int calls, lines;
  bool is_rising, is_own_thread, has_note, lines_are_single;
} Watch;

static int32_t watch_progress(void* user, double done) {
  Watch* const watch = user;
  ++watch->calls;
  watch->is_own_thread = watch->is_own_thread && pthread_equal(watch->thread, pthread_self());
  watch->is_rising = watch->is_rising && done >= watch->done && done <= 1.0;
  watch->done = done;
  const bool wishes =
      (watch->wish_after_s >= 0 && now_s() - watch->start_s >= watch->wish_after_s) ||
      (watch->wish && *watch->wish);
  if (wishes && watch->wished_s == 0) watch->wished_s = now_s(), watch->worked_s = worked_s();
  return wishes;
}

static void watch_log(void* user, const char* line) {
  Watch* const watch = user;
  ++watch->lines;
  watch->has_note = watch->has_note || strncmp(line, "note: ", 6) == 0;
  watch->lines_are_single = watch->lines_are_single && *line && !strchr(line, '\n');
  watch->is_own_thread = watch->is_own_thread && pthread_equal(watch->thread, pthread_self());
}

static Watch new_watch(double wish_after_s) {
  return (Watch){.thread = pthread_self(),
                 .start_s = now_s(),
                 .wish_after_s = wish_after_s,
                 .is_rising = true,
                 .is_own_thread = true,
                 .lines_are_single = true};
}

static swell_scene watched(const char* path, Watch* watch) {
  return (swell_scene){.size = sizeof(swell_scene),
                       .path = path,
                       .progress = watch_progress,
                       .log = watch_log,
                       .user = watch};
}

/* ---- Progress and log */

/* Returns the seconds that it took. */
static double test_watched(const char* path) {
  Watch watch = new_watch(-1);
  const swell_scene scene = watched(path, &watch);
  swell_world* world = NULL;
  EXPECT(swell_world_create(&scene, &world) == SWELL_OK && world);
  const double took_s = now_s() - watch.start_s;
  EXPECT(watch.is_rising && watch.is_own_thread && watch.done == 1.0);
  EXPECT(watch.calls > 0 && watch.calls <= 5 + (int)(took_s / 0.009));
  EXPECT(watch.lines > 3 && watch.lines_are_single);

  /* It is the world that a caller gets who does not watch. */
  swell_world* alone = NULL;
  uint64_t hashes[2] = {0, 1};
  EXPECT(swell_world_load(path, &alone) == SWELL_OK);
  EXPECT(swell_world_hash(world, &hashes[0]) == SWELL_OK);
  EXPECT(swell_world_hash(alone, &hashes[1]) == SWELL_OK && hashes[0] == hashes[1]);
  swell_world_destroy(world);
  swell_world_destroy(alone);
  return took_s;
}

/* ---- Cancelling */

/* The seconds from the wish to the return, or those that were worked then if these are fewer: where
 * other processes work, waiting for them does not count. 0 if the world was made before. */
static double cancel_after(const char* path, double wish_after_s) {
  Watch watch = new_watch(wish_after_s);
  const swell_scene scene = watched(path, &watch);
  swell_world* world = NULL;
  const swell_status status = swell_world_create(&scene, &world);
  const double returned_s = now_s(), working_s = worked_s() - watch.worked_s;
  if (status == SWELL_OK) {
    EXPECT(watch.wished_s == 0);
    swell_world_destroy(world);
    return 0;
  }
  EXPECT(status == SWELL_CANCELLED && !world && *swell_last_error());
  const double late_s = returned_s - watch.wished_s;
  return working_s < late_s ? working_s : late_s;
}

/* Wishes spread over the making. */
static double test_cancel(const char* path, double took_s) {
  double longest_s = 0;
  for (int n = 0; n < kWishes; ++n) {
    double least_s = 1e9;
    for (int i = 0; i < kTries && least_s > deadline_s; ++i) {
      const double late_s = cancel_after(path, took_s * n / kWishes);
      if (late_s < least_s) least_s = late_s;
    }
    if (least_s > longest_s) longest_s = least_s;
  }
  EXPECT(longest_s <= deadline_s);
  return longest_s;
}

static void* set_soon(void* wish) {
  usleep(30000);
  *(volatile int*)wish = 1;
  return NULL;
}

static void test_wish_of_another_thread(const char* path) {
  volatile int wish = 0;
  Watch watch = new_watch(-1);
  watch.wish = &wish;
  const swell_scene scene = watched(path, &watch);
  swell_world* world = NULL;
  pthread_t thread;
  pthread_create(&thread, NULL, set_soon, (void*)&wish);
  const swell_status status = swell_world_create(&scene, &world);
  pthread_join(thread, NULL);
  EXPECT(status == SWELL_CANCELLED || watch.wished_s == 0);
  swell_world_destroy(world);
}

static void test_faults_reach_a_watching_caller(void) {
  Watch watch = new_watch(-1);
  swell_scene scene = watched("no such scene.toml", &watch);
  swell_world* world = NULL;
  EXPECT(swell_world_create(&scene, &world) == SWELL_BAD_SCENE && !world);
  scene.path = NULL, scene.text = "wind.speed_mps = nan";
  EXPECT(swell_world_create(&scene, &world) == SWELL_BAD_SCENE && !world);
  EXPECT(strstr(swell_last_error(), "wind.speed_mps") != NULL);
}

/* ---- Memory */

static size_t kilobytes(const char* key) {
  size_t kb = 0;
  char line[256];
  FILE* const status = fopen("/proc/self/status", "r");
  while (status && fgets(line, sizeof line, status))
    if (strncmp(line, key, strlen(key)) == 0) kb = (size_t)atol(line + strlen(key));
  if (status) fclose(status);
  return kb;
}

/* From here on the peak is that of what follows; false: the system cannot tell, or the address
 * checks take memory of their own. */
static bool forget_peak(void) {
#ifdef SWELL_SANITIZED
  return false;
#endif
  FILE* const file = fopen("/proc/self/clear_refs", "w");
  if (!file) return false;
  const bool is_written = fputs("5", file) >= 0;
  return fclose(file) == 0 && is_written;
}

/* What the refusal of a bound of one byte says that the world needs. */
static size_t need_of(const char* path) {
  const swell_scene scene = {.size = sizeof scene, .path = path, .most_bytes = 1};
  swell_world* world = NULL;
  EXPECT(swell_world_create(&scene, &world) == SWELL_NO_MEMORY && !world);
  EXPECT(strstr(swell_last_error(), "allowed 1") != NULL);
  const char* const need = strstr(swell_last_error(), "up to ");
  EXPECT(need != NULL);
  return need ? (size_t)strtoull(need + 6, NULL, 10) : 0;
}

static void test_bound(const char* path) {
  const size_t need = need_of(path);
  swell_scene scene = {.size = sizeof scene, .path = path, .most_bytes = need - 1};
  swell_world* world = NULL;
  EXPECT(swell_world_create(&scene, &world) == SWELL_NO_MEMORY && !world);
  scene.most_bytes = need;
  malloc_trim(0);
  const bool can_tell = forget_peak();
  const size_t before_kb = kilobytes("VmRSS:");
  EXPECT(swell_world_create(&scene, &world) == SWELL_OK);
  const size_t peak_kb = kilobytes("VmHWM:") - before_kb;
  swell_world_destroy(world);
  if (can_tell) EXPECT(peak_kb <= need / 1024);
  printf("  needs up to %zu MB, took %zu MB\n", need >> 20, peak_kb >> 10);
}

int main(int argc, char** argv) {
  if (argc < 3) return fprintf(stderr, "usage: making_test DEADLINE_MS SCENE...\n"), 2;
  deadline_s = 1e-3 * atof(argv[1]);
  for (int i = 2; i < argc; ++i) {
    const double took_s = test_watched(argv[i]);
    const double late_s = test_cancel(argv[i], took_s);
    printf("%s: made in %.3f s, returned %.0f ms after the wish\n", argv[i], took_s, 1e3 * late_s);
    test_bound(argv[i]);
  }
  test_wish_of_another_thread(argv[2]);
  test_faults_reach_a_watching_caller();
  printf("%s: %d faults\n", argv[0], faults);
  return faults == 0 ? 0 : 1;
}
