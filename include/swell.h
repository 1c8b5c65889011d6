/* Swell for programs in C and in languages that call C: draws the sea, and answers what it is like
 * at a place and time. docs/do/embedding.md introduces it; docs/look_up/conventions.md has axes and
 * units: world x east, y north, z up, metres, seconds, degrees in names that end with _deg alone.
 *
 *   swell_world *world = NULL;
 *   swell_session *session = NULL;
 *   swell_picture *picture = NULL;
 *   if (swell_world_load("scenes/open_ocean.toml", &world) ||
 *       swell_session_create(world, 0, &session) || swell_picture_create(&picture))
 *     return fprintf(stderr, "%s\n", swell_last_error()), 1;
 *   swell_frame frame = {.size = sizeof frame, .width_px = 640, .height_px = 360, .labels = "id"};
 *   swell_plane rgba = {.size = sizeof rgba};
 *   if (swell_render(session, &frame, picture) || swell_picture_plane(picture, "rgba", &rgba))
 *     return fprintf(stderr, "%s\n", swell_last_error()), 1;
 *
 * Errors. Functions that can fail return a swell_status, SWELL_OK (0) if all went well. Otherwise
 * nothing was changed, but what a handle keeps for speed, and swell_last_error() says in one line
 * what was given and what is allowed. Null, NaN, infinities and numbers out of range are errors,
 * not crashes. No C++ exception leaves the library.
 *
 * Structures begin with their size, which the caller sets to sizeof: later versions add members at
 * the end, and take the structures of earlier ones. Members that are 0 have a default. Handles are
 * opaque; destroying a null handle does nothing. Texts are UTF-8.
 *
 * Threads. A swell_world never changes: any number of threads may use it. A swell_session and a
 * swell_picture are used by one thread at a time; a second one meanwhile gets SWELL_BUSY. Each
 * session has threads of its own to draw with. Different handles know nothing of each other. A
 * world may be destroyed before its sessions, which keep what they need. After fork() only the
 * parent may go on using handles. */
#ifndef SWELL_H
#define SWELL_H

#include <stddef.h>
#include <stdint.h>

#define SWELL_API __attribute__((visibility("default")))

#ifdef __cplusplus
extern "C" {
#endif

typedef enum swell_status {
  SWELL_OK = 0,
  SWELL_BAD_ARGUMENT = 1, /* null, out of range, unknown name */
  SWELL_BAD_SCENE = 2,    /* the scene, its settings, or a file that it names */
  SWELL_BUSY = 3,         /* another thread uses the session or picture */
  SWELL_NO_MEMORY = 4,
  SWELL_FAILED = 5,   /* anything else: a CPU without AVX2, no threads to be had */
  SWELL_CANCELLED = 6 /* the caller's progress() wished it */
} swell_status;

typedef struct swell_world swell_world;     /* a scene made ready to draw and to ask */
typedef struct swell_session swell_session; /* what one thread draws and asks with */
typedef struct swell_picture swell_picture; /* a finished frame with its labels */

/* "0.1.0". */
SWELL_API const char* swell_version(void);

/* What was wrong with the last call of this thread that failed; "" if none has. Valid until the
 * next one fails. */
SWELL_API const char* swell_last_error(void);

/* ---- Worlds */

typedef struct swell_scene {
  size_t size;
  const char* path; /* a scene file, TOML or JSON; or null */
  const char* text; /* its text, where path is null */
  const char*
      folder; /* relative paths of a text are relative to this; null: where the program runs */
  const char* const* settings; /* "wind.speed_mps=12" ..., as swell-render --set has them */
  size_t setting_count;
  int32_t threads; /* that make the world, [1, 256]; 0: all that the process may use */
  /* Both are called while the world is made, by the thread that makes the call; null: nobody is
   * told. progress() is told about every 10 ms which part is done, from 0 to 1, by typical times;
   * it returns 0 to go on. Else the call returns SWELL_CANCELLED within 50 ms. log() takes a line
   * for what was made, and for what takes long. */
  int32_t (*progress)(void* user, double done);
  void (*log)(void* user, const char* line);
  void* user;
  /* Of memory that the world may take, also while it is made; a world that might take more is
   * refused before it is made, SWELL_NO_MEMORY. 0: no bound. */
  size_t most_bytes;
  /* A folder where parts of worlds are kept for later processes, which make the same world in a
   * fraction of the time; made if it is not there; 2 GB at most; null: nowhere. Changes no bit. */
  const char* cache_folder;
} swell_scene;

/* Makes a world: 20 ms to some seconds. */
SWELL_API swell_status swell_world_create(const swell_scene* scene, swell_world** world);
SWELL_API swell_status swell_world_load(const char* path, swell_world** world);
SWELL_API void swell_world_destroy(swell_world* world);

/* The scene as TOML with every value written out, for as long as the world lives. */
SWELL_API const char* swell_world_text(const swell_world* world);

/* XXH3-64 of that text. */
SWELL_API swell_status swell_world_hash(const swell_world* world, uint64_t* hash);

typedef struct swell_object {
  size_t size;
  uint32_t id;      /* in the label "id" */
  uint32_t klass;   /* in the label "class" */
  const char* name; /* "" for none; texts live as long as the world */
  const char* class_name;
  const char* kind; /* "buoy", "boat", ... */
} swell_object;

/* The objects of the scene, in its order; 0 of a null world. */
SWELL_API size_t swell_object_count(const swell_world* world);
SWELL_API swell_status swell_object_info(const swell_world* world, size_t object,
                                         swell_object* info);

/* The name of a class of the label "class"; null: there is no such class. */
SWELL_API const char* swell_class_name(const swell_world* world, uint32_t klass);

/* ---- Sessions */

/* `threads` in [1, 256] draw and answer; 0: all that the process may use. They change no bit of any
 * result. */
SWELL_API swell_status swell_session_create(const swell_world* world, int32_t threads,
                                            swell_session** session);
SWELL_API void swell_session_destroy(swell_session* session);

/* ---- Cameras and poses */

/* A pinhole camera. Its frame is the optical one: x to the right of the picture, y down, z ahead.
 */
typedef enum swell_projection {
  SWELL_PERSPECTIVE = 0,
  SWELL_FISHEYE = 1, /* Kannala and Brandt's lens, as OpenCV has it */
  SWELL_EQUIRECTANGULAR =
      2 /* longitude across, from straight back on to the right; latitude down */
} swell_projection;

typedef struct swell_camera {
  size_t size;
  double eye_m[3];           /* each within 1e6 */
  double quaternion_wxyz[4]; /* turns the optical frame into the world; of any length over 0 */
  double focal_px[2];        /* fx, fy in [0.1, 1e7]; of equirectangular cameras all of K is 0 */
  double principal_px[2]; /* cx, cy within 1e6, from the picture's upper left corner: 0.5 more than
                             OpenCV's */
  double near_m;          /* nearer things are cut off, [0.001, 100]; 0: 0.25 */
  int32_t projection;  /* swell_projection. In wide pictures labels are those of the nearest pixel
                          that was drawn for them, and the depth is the distance */
  double fisheye_k[4]; /* k1 to k4 of a fisheye, within 10: the radius theta (1 + k1 theta^2 + ...
                          k4 theta^8) has to grow with the angle up to the rim */
  double fisheye_fov_deg; /* full angle of the cone that a fisheye shows, up to 360; 0: 180 */
} swell_camera;

/* A camera that looks along a heading (clockwise from north) and a pitch (up), turned about that
 * line by roll (positive lowers the right side), whose picture of width_px x height_px spans
 * fov_y_deg in (0, 180) from its lower to its upper edge. */
SWELL_API swell_status swell_camera_look(const double eye_m[3], double heading_deg,
                                         double pitch_deg, double roll_deg, double fov_y_deg,
                                         int32_t width_px, int32_t height_px, swell_camera* camera);

/* The scene's own camera at a time, where the scene and the water have the object that it may be
 * mounted on; swell_frame_camera() knows where the caller puts that object. */
SWELL_API swell_status swell_scene_camera(swell_session* session, double t_s, int32_t width_px,
                                          int32_t height_px, swell_camera* camera);

/* Where an object is. Its axes are right, ahead, up; its origin lies on its vertical axis at the
 * waterline. */
typedef struct swell_pose {
  size_t size;
  size_t object;             /* its index */
  double position_m[3];      /* each within 1e7 */
  double quaternion_wxyz[4]; /* turns its axes into the world */
} swell_pose;

/* Where the scene and the water have its objects at a time: all of them, in order. `count` is their
 * number. */
SWELL_API swell_status swell_object_poses(swell_session* session, double t_s, swell_pose* poses,
                                          size_t count);

/* ---- What disturbs the water */

typedef enum swell_disturbance_kind {
  SWELL_DROP = 0,     /* a hump that is there at t_s, still, and then runs apart in rings */
  SWELL_FOOTSTEP = 1, /* a hollow with as much water around it as is missing in it */
  SWELL_HULL = 2,     /* a ship's that goes along a path */
  SWELL_ROTOR = 3     /* gusts under something that hovers, from t_s on */
} swell_disturbance_kind;

/* What disturbs the water besides the scene's [[disturbance]], with the same values and ranges
 * (docs/look_up/scene.md). Waves follow from the list and the time alone, so give the same list for
 * earlier times and later ones. */
typedef struct swell_disturbance {
  size_t size;
  int32_t kind;         /* swell_disturbance_kind */
  double position_m[2]; /* of its middle: east, north; not of a hull */
  double t_s;           /* not of a hull, which is at its path's first point at 0 */
  double duration_s;    /* of a rotor; 0: 60 */
  double radius_m;      /* not of a hull; 0: 0.25 */
  double height_m;      /* not of a hull; 0: 0.1 */
  const double* path_m; /* of a hull: [path_count][2], two points or more */
  size_t path_count;
  double speed_mps;  /* of a hull; 0: 3 */
  int32_t path_open; /* not 0: the hull stops at the last point, else it goes round */
  double hull_m[3];  /* beam, length, draught; each 0: that of 2.9, 9.2, 0.5 */
  double depth_m;    /* of the water under a hull, which slows long waves; 0: deep */
} swell_disturbance;

/* ---- Pictures */

typedef struct swell_frame {
  size_t size;
  double t_s;                  /* within 1e12 */
  int32_t width_px, height_px; /* each in [1, 8192] */
  const swell_camera* camera;  /* null: the scene's, which goes with the object that it is mounted
                                  on, also where `poses` or `disturbances` put that */
  const char* labels; /* "depth,id", "all" or null: which labels are drawn; docs/look_up/labels.md
                         has their names */
  int32_t linear;     /* not 0: the plane "linear" is drawn as well, and every pixel shaded, as with
                         picture.shading = "full" */
  /* For the label of motion: the next frame's time after this one, over 0 (0: 1/60 s), camera
   * (null: the scene's at that time, with next_poses, if `camera` is null, else the same) and
   * poses. */
  double next_frame_s;
  const swell_camera* next_camera;
  /* Objects that are elsewhere in this frame, at most one pose for each. */
  const swell_pose *poses, *next_poses;
  size_t pose_count, next_pose_count;
  const char* without;     /* parts to leave out, as swell-render --without has them: "haze,clouds";
                              null: none */
  int32_t water_triangles; /* [2, 1e6]; 0: the scene's */
  int32_t terrain_triangles;
  double lookup_scale;  /* [0.01, 1]; 0: the scene's */
  int32_t edge_samples; /* 1 (none), 4 or 8; 0: the scene's */
  const swell_disturbance* disturbances;
  size_t disturbance_count; /* at most 256 */
} swell_frame;

/* The names of the labels, and of the parts that a frame can be drawn without; null: there are not
 * so many. */
SWELL_API const char* swell_label_name(size_t label);
SWELL_API const char* swell_part_name(size_t part);

SWELL_API swell_status swell_picture_create(swell_picture** picture);
SWELL_API void swell_picture_destroy(swell_picture* picture);

/* Draws into the picture, whose memory is used again. The same scene, frame and camera give the
 * same bits. */
SWELL_API swell_status swell_render(swell_session* session, const swell_frame* frame,
                                    swell_picture* picture);

/* Draws frame k into picture k, for k in [0, count), each with the bits of swell_render(). The
 * frames share the sea, and each is drawn by one thread where there are enough: many small ones
 * take far less time than one after the other. They have one t_s, the same parts left out, and the
 * same list of disturbances; the pictures are different ones. At most 65536. */
SWELL_API swell_status swell_render_many(swell_session* session, const swell_frame* const* frames,
                                         swell_picture* const* pictures, size_t count);

/* The camera that swell_render() would draw this frame with. */
SWELL_API swell_status swell_frame_camera(swell_session* session, const swell_frame* frame,
                                          swell_camera* camera);

typedef enum swell_type {
  SWELL_UINT8 = 0,
  SWELL_UINT32 = 1,
  SWELL_FLOAT32 = 2,
  SWELL_FLOAT64 = 3
} swell_type;

/* An array [height_px][width_px][components], rows from the top, without gaps. */
typedef struct swell_plane {
  size_t size;
  const void* data; /* until the picture is drawn into again or destroyed */
  size_t bytes;
  swell_type type;
  int32_t width_px, height_px, components;
} swell_plane;

/* A plane of the picture by its name: "rgba" (uint8: sRGB, alpha 255), "linear" (3 float32: linear
 * RGB light), or a label that was drawn: "depth", "distance", "elevation", "foam" (float32),
 * "normal", "geometric_normal" (3 float32), "motion" (2 float32), "position" (3 float64), "id",
 * "class" (uint32), "flags" (uint8). */
SWELL_API swell_status swell_picture_plane(swell_picture* picture, const char* name,
                                           swell_plane* plane);

/* Copies a plane into the caller's buffer of as many bytes as it has. */
SWELL_API swell_status swell_picture_copy(swell_picture* picture, const char* name, void* buffer,
                                          size_t bytes);

/* The hash that swell-render --hash prints: XXH3-64 of the 8-bit RGB picture. */
SWELL_API swell_status swell_picture_hash(const swell_picture* picture, uint64_t* hash);

/* The camera that the picture was drawn with. */
SWELL_API swell_status swell_picture_camera(const swell_picture* picture, swell_camera* camera);

/* What a place of a picture shows. */
typedef enum swell_shown {
  SWELL_SHOWS_SKY = 0,
  SWELL_SHOWS_WATER = 1,
  SWELL_SHOWS_LAND = 2,
  SWELL_SHOWS_OBJECT = 3
} swell_shown;

typedef struct swell_pick {
  size_t size;
  swell_shown what;
  double position_m[3]; /* on the drawn triangle; 0 for the sky, as all that follows */
  double distance_m;    /* from the eye */
  size_t object;        /* of SWELL_SHOWS_OBJECT: its index */
  uint32_t id;          /* as in the label "id" */
  double height_m;      /* there: of the ground if land is shown, else of the water */
} swell_pick;

/* What the last frame of the session shows at a point of its window, x_px in [0, width_px] and y_px
 * in [0, height_px]; pixel (i, j) has its centre at (i + 0.5, j + 0.5). */
SWELL_API swell_status swell_pick_at(swell_session* session, double x_px, double y_px,
                                     swell_pick* pick);

/* ---- Asking the sea */

/* Asks for the surface that is drawn, at any time, past or to come. Results that are null are not
 * worked out. A session keeps the waves of the last time that was asked for: the same time again
 * costs the points alone. */
typedef struct swell_query {
  size_t size;
  double t_s;           /* within 1e12 */
  size_t count;         /* of points */
  const double* xy_m;   /* [count][2]: east, north; each below 1e9 */
  float* height_m;      /* [count]: of the water over the mean sea level */
  float* slope;         /* [count][2]: dz/dx, dz/dy */
  float* normal;        /* [count][3]: unit vectors */
  float* velocity_mps;  /* [count][3]: of the water at the surface, east, north, up */
  float* foam;          /* [count]: part that whitecaps and surf of trains hide, [0, 1] */
  float* still_depth_m; /* [count]: of the ground under the mean sea level, below 0 on land;
                           infinite without terrain */
  const swell_disturbance* disturbances; /* as in the frame; the waves are worked out anew then */
  size_t disturbance_count;
} swell_query;

SWELL_API swell_status swell_ask(swell_session* session, const swell_query* query);

typedef struct swell_hit {
  size_t size;
  int32_t hits; /* 0: the ray meets no water; the rest is 0 then */
  double position_m[3];
  double distance_m;
  int32_t from_above; /* 1: out of the air */
} swell_hit;

/* The first place where a ray passes the water, at most max_distance_m in (0, 1e6] away. */
SWELL_API swell_status swell_ray(swell_session* session, double t_s, const double origin_m[3],
                                 const double direction[3], double max_distance_m, swell_hit* hit);

/* ---- Lidar */

/* What a lidar, or a depth sensor of single beams, gets back. Beams meet the surfaces that queries
 * answer for, not a picture's triangles: waves, land, trees with all leaves, forms, objects, within
 * 1 mm at 100 m in a flat world. The sensor's frame is that of REP 103: x ahead, y left, z up.
 * Intensities are of light of 905 nm, 1 for a white matt surface that is met squarely: paint by the
 * mean of its colour, leaves 0.45, ground 0.3, foam 0.33, times the cosine of the incidence and
 * what fog leaves; clear water mirrors little back but straight down (Cox, Munk, 1954), and nothing
 * returns from below it. Results that are null are not worked out. */
typedef struct swell_lidar {
  size_t size;
  double t_s;                /* within 1e12 */
  double position_m[3];      /* each within 1e6 */
  double quaternion_wxyz[4]; /* turns the sensor's frame into the world; of any length over 0 */
  const double* beams; /* [count][3]: azimuth_deg from x towards y, elevation_deg from there towards
                          z, each within 1e6, and when it leaves: s after t_s, within 1000 */
  size_t count;        /* at most 1e8 */
  /* Over 0: the sensor is at the end's pose so many seconds after t_s, at most 1000, and beams
   * leave from between both (a rolling shutter). 0: it stays. */
  double duration_s;
  double end_position_m[3];
  double end_quaternion_wxyz[4];
  int32_t moments; /* at which the world stands still in the duration, [1, 64]; 0: one, at t_s */
  double least_m, most_m; /* ranges that it tells, up to 1e5; most_m 0: 120 */
  /* How far a surface of reflectance 0.1 that is met squarely is seen half of the time, at most
   * 1e5; what sends back less is lost sooner. 0: each beam that meets something has a return. */
  double reach_m;
  double range_noise_m; /* standard deviation, [0, 10] */
  uint64_t seed; /* of noise and losses, which follow from it, the beam's number and t_s alone */
  const swell_pose* poses; /* as in the frame */
  size_t pose_count;
  const swell_disturbance* disturbances;
  size_t disturbance_count;
  float* range_m;       /* [count]: infinity: nothing came back */
  float* intensity;     /* [count]: [0, 1] */
  float* incidence_deg; /* [count]: [0, 90], from the surface's normal */
  uint32_t* id;         /* [count]: as in the labels "id" and "class"; 0: nothing */
  uint32_t* klass;
  float* point_m; /* [count][3]: in the sensor's frame as the beam left; NaN: nothing */
} swell_lidar;

SWELL_API swell_status swell_scan(swell_session* session, const swell_lidar* lidar);

/* The spinning lidars whose beams are known: "vlp-16" (16 beams, -15 to 15 deg), "hdl-32e" (32,
 * -30.67 to 10.67), "os1-64" and "os1-128" (-22.5 to 22.5), evenly, by their makers' data sheets;
 * null: there are not so many. */
SWELL_API const char* swell_lidar_name(size_t model);

/* How many beams stand above each other; 0: no such lidar. */
SWELL_API size_t swell_lidar_beams(const char* model);

/* Fills beams [columns][of the model][3] of a clockwise turn that begins at start_deg: columns in
 * [1, 1e6] after each other, beams from the lowest up. duration_s in [0, 1000]: of the turn.
 * `count` is how many beams there are room for, just as many as there will be. */
SWELL_API swell_status swell_spinning_beams(const char* model, int32_t columns, double start_deg,
                                            double duration_s, double* beams, size_t count);

/* Fills beams [height][width][3] of a solid-state lidar or a depth camera: the middles of even
 * cells of a field of view, rows from the top, left to right, width and height in [1, 8192];
 * fov_x_deg in (0, 360], fov_y_deg in (0, 180]. The rows leave one after the other in duration_s.
 */
SWELL_API swell_status swell_grid_beams(int32_t width, int32_t height, double fov_x_deg,
                                        double fov_y_deg, double duration_s, double* beams,
                                        size_t count);

/* ---- Below the surface */

typedef enum swell_place {
  SWELL_IN_WATER = 0, /* on the surface or below it */
  SWELL_ABOVE_WATER = 1,
  SWELL_IN_GROUND = 2
} swell_place;

/* Asks how the water moves below the surface: linear theory, each wave with its own decay,
 * stretched so that it begins at the surface, under crests and troughs alike (Wheeler, 1970). The
 * sea's waves decay as in deep water, the trains of a coast and wakes by the depth; a river's
 * current is the same on the whole depth. At the surface the velocity is swell_query's, bit for
 * bit. In between waves of more than 25 cm are off by at most 0.2 % of what they are at the surface
 * (wakes over a floor by 0.6 %). Results that are null are not worked out; out of the water they
 * are 0. A session keeps what the last time's points needed: 4 ms of one thread for the pressure
 * down to 10 m, 30 ms for all; then a point costs 0.6 us, or 6 us for all. */
typedef struct swell_below {
  size_t size;
  double t_s;               /* within 1e12 */
  size_t count;             /* of points */
  const double* xyz_m;      /* [count][3]: east, north, up; x and y below 1e9, z within 1e7 */
  double density_kg_m3;     /* of the water, [1, 1e5]; 0: 1025 */
  float* velocity_mps;      /* [count][3]: east, north, up */
  float* acceleration_mps2; /* [count][3]: its rate at a place that stands still, by the waves
                               alone; what the water carries along is not counted */
  float* pressure_pa; /* [count]: of the waves, without that of still water; density times gravity
                         times the height over the still level at the surface */
  uint8_t* place;     /* [count]: swell_place */
  const swell_disturbance* disturbances; /* as in the frame; the waves are worked out anew then */
  size_t disturbance_count;
} swell_below;

SWELL_API swell_status swell_ask_below(swell_session* session, const swell_below* below);

/* A closed hull of triangles, whose corners run counter-clockwise as seen from outside. Edges of a
 * tenth of a wavelength are short enough for 1 %. */
typedef struct swell_hull {
  size_t size;
  double t_s;
  const double* xyz_m; /* [point_count][3]: in the world, as of swell_below */
  size_t point_count;
  const uint32_t* triangles; /* [triangle_count][3]: points */
  size_t triangle_count;
  double about_m[3];    /* what the moments are about */
  double density_kg_m3; /* of the water; 0: 1025 */
  const swell_disturbance* disturbances;
  size_t disturbance_count;
} swell_hull;

/* Forces on what of a hull is under the surface, which cuts its triangles, and their moments: east,
 * north, up. Both together are what undisturbed waves press; a hull that throws waves back, makes
 * some of its own or drags water along feels more. */
typedef struct swell_loads {
  size_t size;
  double buoyancy_n[3], buoyancy_nm[3];           /* of the pressure of still water */
  double froude_krylov_n[3], froude_krylov_nm[3]; /* of the waves' pressure */
} swell_loads;

SWELL_API swell_status swell_hull_loads(swell_session* session, const swell_hull* hull,
                                        swell_loads* loads);

/* ---- The keys of scene files */

typedef struct swell_key {
  size_t size;
  const char*
      table; /* "" for keys with their whole name, else the tables [[...]] that have it: "object" */
  const char* name;    /* "wind.speed_mps" */
  const char* unit;    /* "m/s", or "" */
  const char* allowed; /* "0 to 60 m/s" */
  const char* meaning;
} swell_key;

SWELL_API size_t swell_key_count(void);
SWELL_API swell_status swell_key_info(size_t key, swell_key* info);

#ifdef __cplusplus
}
#endif

#endif /* SWELL_H */
