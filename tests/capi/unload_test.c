/* A host may load the library, draw and unload it again, as plugins are.
 *   unload_test LIBRARY [TIMES] */
#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <swell.h>
#include <time.h>

static int faults = 0;

#define EXPECT(condition)                                            \
  do {                                                               \
    if (!(condition)) {                                              \
      ++faults;                                                      \
      printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    }                                                                \
  } while (false)

static void sleep_ms(long ms) {
  const struct timespec time = {ms / 1000, ms % 1000 * 1000000L};
  nanosleep(&time, NULL);
}

/* FUNCTION(library, name): the function of swell.h of that name. */
#define FUNCTION(library, name) ((__typeof__(&name))dlsym(library, #name))

static uint64_t draw(void* library) {
  const swell_scene scene = {.size = sizeof scene,
                             .text =
                                 "[sky]\nzenith = [0.1, 0.2, 0.4]\nhorizon = [0.5, 0.6, 0.7]\n"
                                 "[detail]\nwater_triangles = 500\n",
                             .threads = 2};
  const swell_frame frame = {
      .size = sizeof frame, .t_s = 2.0, .width_px = 96, .height_px = 64, .labels = "id"};
  swell_world* world = NULL;
  swell_session* session = NULL;
  swell_picture* picture = NULL;
  uint64_t hash = 0;
  EXPECT(FUNCTION(library, swell_world_create)(&scene, &world) == SWELL_OK);
  EXPECT(FUNCTION(library, swell_session_create)(world, 2, &session) == SWELL_OK);
  EXPECT(FUNCTION(library, swell_picture_create)(&picture) == SWELL_OK);
  EXPECT(FUNCTION(library, swell_render)(session, &frame, picture) == SWELL_OK);
  EXPECT(FUNCTION(library, swell_picture_hash)(picture, &hash) == SWELL_OK);
  FUNCTION(library, swell_picture_destroy)(picture);
  FUNCTION(library, swell_session_destroy)(session);
  FUNCTION(library, swell_world_destroy)(world);
  return hash;
}

int main(int argc, char** argv) {
  const int times = argc > 2 ? atoi(argv[2]) : 50;
  uint64_t first = 0;
  for (int i = 0; i < times; ++i) {
    void* const library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) return fprintf(stderr, "%s\n", dlerror()), 1;
    const uint64_t hash = draw(library);
    if (i == 0) first = hash;
    EXPECT(hash == first && hash != 0);
    EXPECT(dlclose(library) == 0);
    sleep_ms(i < 3 || i + 1 == times ? 300 : 10); /* the threads notice that there is no work */
  }
  printf("%d times: %d faults\n", times, faults);
  return faults == 0 ? 0 : 1;
}
