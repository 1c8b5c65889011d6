// Swell for programs in C++20: draws the sea, and answers what it is like at a place and time.
// docs/do/embedding.md introduces it, swell.h says more of each value, with its unit and its range;
// docs/look_up/conventions.md has axes and units.
//
//   swell::World world("scenes/buoys.toml", {.settings = {"sea.douglas=4"}});
//   auto picture = world.render(5.0, {1280, 720}, {.labels = {"depth", "id"}});
//   float ahead_m = picture.plane<float>("depth").at(640, 500);
//   std::vector<float> height_m = world.height({{0.0, 50.0}, {3.0, 60.0}}, 5.0);
//
// Link libswell alone: this header is written on its C interface, and needs no other package. What
// fails throws swell::Error, whose text says in one line what was given and what is allowed. No
// value that is given ends the program.
//
// Threads. A World is used by one thread at a time. Its copies share what was made of the scene,
// cost nothing to make and are independent of each other: give each thread a copy. A Picture is
// used by one thread at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "swell.h"

namespace swell {

class Error : public std::runtime_error {
 public:
  Error(swell_status status, const char* text) : std::runtime_error(text), status_(status) {}
  swell_status status() const { return status_; }

 private:
  swell_status status_;
};

using Point2 = std::array<double, 2>;   // east, north [m], or pixels
using Point3 = std::array<double, 3>;   // east, north, up [m]
using Matrix3 = std::array<Point3, 3>;  // of rows

struct PictureSize {
  int width_px = 1280, height_px = 720;
};

// A list that a call takes: a vector, an array, or values in braces. Not to be kept.
template <class Value>
class ListOf : public std::span<const Value> {
 public:
  ListOf() = default;
  ListOf(std::initializer_list<Value> values)
      : std::span<const Value>(values.begin(), values.size()) {}
  template <class Range>
  requires std::is_constructible_v < std::span<const Value>,
  const Range& > ListOf(const Range& values) : std::span<const Value>(values) {}
};

// A camera (swell_camera), pinhole unless it has another projection. Its frame is the optical one:
// x to the right of the picture, y down, z ahead.
struct Camera {
  Point3 eye_m = {};
  std::array<double, 4> quaternion_wxyz = {1.0, 0.0, 0.0, 0.0};
  Point2 focal_px = {1.0, 1.0}, principal_px = {};
  double near_m = 0.25;
  swell_projection projection = SWELL_PERSPECTIVE;
  std::array<double, 4> fisheye_k = {};
  double fisheye_fov_deg = 180.0;

  // Where a camera of the scene's kind looks (swell_camera_look); degrees.
  struct Look {
    double heading_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0, fov_y_deg = 50.0;
  };
  static Camera look(Point3 eye_m, const Look& look, PictureSize size);

  // Of a rotation that turns optical vectors into the world, and of its matrix
  // {{fx, 0, cx}, {0, fy, cy}, {0, 0, 1}}.
  static Camera from_pose(Point3 eye_m, const Matrix3& world_from_optical, const Matrix3& k);
  // Of OpenCV's matrix, whose cx and cy count from the first pixel's centre, and of its extrinsics:
  // a world point p has the optical coordinates rotation p + translation.
  static Camera from_opencv(const Matrix3& k, const Matrix3& rotation, Point3 translation_m);
};

// Where an object is (swell_pose).
struct Pose {
  std::size_t object = 0;  // its index
  Point3 position_m = {};
  std::array<double, 4> quaternion_wxyz = {1.0, 0.0, 0.0, 0.0};
};

// What disturbs the water (swell_disturbance): 0 stands for the default.
struct Disturbance {
  swell_disturbance_kind kind = SWELL_DROP;
  Point2 position_m = {};
  double t_s = 0.0, duration_s = 0.0, radius_m = 0.0, height_m = 0.0;
  std::vector<Point2> path_m = {};  // of a hull
  double speed_mps = 0.0;
  bool path_open = false;
  Point3 hull_m = {};  // beam, length, draught
  double depth_m = 0.0;
};

// How a world is made (swell_scene).
struct WorldOptions {
  std::vector<std::string> settings = {};  // "wind.speed_mps=12", as swell-render --set has them
  std::filesystem::path folder = {};       // that paths of a scene's text are relative to
  int threads = 0;                         // that make the world, draw and answer; 0: all there are
  std::size_t most_bytes = 0;              // of memory that the world may take; 0: no bound
  std::filesystem::path cache_folder = {};  // where parts of worlds are kept; empty: nowhere
  // Is told the part that is done, in [0, 1], every 10 ms; false ends the making.
  std::function<bool(double done)> progress = {};
  std::function<void(std::string_view line)> log = {};
};

// What a picture is drawn with (swell_frame): what is left out is the scene's.
struct RenderOptions {
  std::vector<std::string> labels = {};  // "depth", ... (docs/look_up/labels.md), or "all"
  bool linear = false;
  std::optional<Camera> camera = {};
  std::vector<Pose> poses = {};  // of objects that are elsewhere in this picture
  // Of the next picture, for the label of motion.
  double next_frame_s = 0.0;
  std::optional<Camera> next_camera = {};
  std::vector<Pose> next_poses = {};
  std::vector<std::string> without = {};
  int water_triangles = 0, terrain_triangles = 0;
  double lookup_scale = 0.0;
  int edge_samples = 0;
  std::vector<Disturbance> disturbances = {};
};

struct Object {
  std::uint32_t id = 0, klass = 0;  // in the labels "id" and "class"
  std::string name, class_name, kind;
};

// Where a ray passes the water.
struct Hit {
  Point3 position_m = {};
  double distance_m = 0.0;
  bool from_above = false;
};

// How the water moves at a point (swell_below): 0 out of the water.
struct Motion {
  swell_place place = SWELL_IN_WATER;
  std::array<float, 3> velocity_mps = {}, acceleration_mps2 = {};
  float pressure_pa = 0.0f;  // of the waves, without that of still water
};

// A closed hull of triangles (swell_hull), corners counter-clockwise as seen from outside.
struct Hull {
  std::vector<Point3> xyz_m = {};
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  Point3 about_m = {};         // what the moments are about
  double density_kg_m3 = 0.0;  // of the water; 0: 1025
};

// What presses on it (swell_loads): newtons and newton metres, east, north, up.
struct Load {
  Point3 force_n = {}, moment_nm = {};
};
struct HullLoads {
  Load buoyancy, froude_krylov;
};

// A beam of a lidar, where it is, what else it is asked, and what a beam got back (swell_lidar,
// which has their ranges). The sensor's frame is that of REP 103: x ahead, y left, z up.
struct LidarBeam {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
  double time_s = 0.0;  // it leaves so long after the scan's time
};
struct LidarPose {
  Point3 position_m = {};
  std::array<double, 4> quaternion_wxyz = {1.0, 0.0, 0.0, 0.0};
};
struct LidarOptions {
  std::optional<LidarPose> end = {};  // where it is duration_s later; none: it stays
  double duration_s = 0.0;
  int moments = 1;
  double least_m = 0.0, most_m = 120.0;
  double reach_m = 0.0, range_noise_m = 0.0;
  std::uint64_t seed = 1;
  std::vector<Pose> poses = {};
  std::vector<Disturbance> disturbances = {};
};
struct LidarReturn {
  float range_m = 0.0f;  // infinity: nothing came back
  float intensity = 0.0f;
  float incidence_deg = 0.0f;
  std::uint32_t id = 0, klass = 0;
  std::array<float, 3> point_m = {};  // in the sensor's frame; NaN: nothing
};

// What a point of a picture shows (swell_pick).
struct Pick {
  swell_shown what = SWELL_SHOWS_SKY;
  Point3 position_m = {};
  double distance_m = 0.0;
  std::optional<std::size_t> object = {};  // its index
  std::uint32_t id = 0;
  double height_m = 0.0;
};

struct Key {
  std::string table, name, unit, allowed, meaning;
};

// An array [height_px][width_px][components], rows from the top.
template <class Value>
struct Plane {
  std::span<const Value> values;  // until its picture is gone
  int width_px = 0, height_px = 0, components = 1;

  // The value of a pixel within the picture.
  const Value& at(int x_px, int y_px, int component = 0) const {
    const std::size_t pixel = static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width_px) +
                              static_cast<std::size_t>(x_px);
    return values[pixel * static_cast<std::size_t>(components) +
                  static_cast<std::size_t>(component)];
  }
};

namespace door {  // what the classes below are made with

inline void check(swell_status status) {
  if (status != SWELL_OK) throw Error(status, swell_last_error());
}

[[noreturn]] inline void refuse(const std::string& text) {
  throw Error(SWELL_BAD_ARGUMENT, text.c_str());
}

template <class Struct>
Struct sized() {
  Struct made{};
  made.size = sizeof(Struct);
  return made;
}

// As C has it, which would end the text at a NUL.
inline const char* c_text(const std::string& text) {
  if (text.find('\0') != std::string::npos) refuse("a text, got one with a NUL, allowed others");
  return text.c_str();
}

inline std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

inline std::string hex(std::uint64_t hash) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

template <class Numbers, std::size_t N>
void set(Numbers (&to)[N], const std::array<Numbers, N>& from) {
  for (std::size_t i = 0; i < N; ++i) to[i] = from[i];
}
template <class Numbers, std::size_t N>
std::array<Numbers, N> array_of(const Numbers (&from)[N]) {
  return std::to_array(from);
}

inline swell_camera c_camera(const Camera& camera) {
  auto c = sized<swell_camera>();
  set(c.eye_m, camera.eye_m);
  set(c.quaternion_wxyz, camera.quaternion_wxyz);
  set(c.focal_px, camera.focal_px);
  set(c.principal_px, camera.principal_px);
  c.near_m = camera.near_m;
  c.projection = camera.projection;
  set(c.fisheye_k, camera.fisheye_k);
  c.fisheye_fov_deg = camera.fisheye_fov_deg;
  return c;
}

inline Camera camera_of(const swell_camera& c) {
  return {array_of(c.eye_m),
          array_of(c.quaternion_wxyz),
          array_of(c.focal_px),
          array_of(c.principal_px),
          c.near_m,
          static_cast<swell_projection>(c.projection),
          array_of(c.fisheye_k),
          c.fisheye_fov_deg == 0.0 ? 180.0 : c.fisheye_fov_deg};
}

inline std::vector<swell_pose> c_poses(const std::vector<Pose>& poses) {
  std::vector<swell_pose> all;
  for (const Pose& pose : poses) {
    auto c = sized<swell_pose>();
    c.object = pose.object;
    set(c.position_m, pose.position_m);
    set(c.quaternion_wxyz, pose.quaternion_wxyz);
    all.push_back(c);
  }
  return all;
}

inline std::vector<swell_disturbance> c_disturbances(std::span<const Disturbance> disturbances) {
  static_assert(sizeof(Point2) == 2 * sizeof(double));
  std::vector<swell_disturbance> all;
  for (const Disturbance& d : disturbances) {
    auto c = sized<swell_disturbance>();
    c.kind = d.kind;
    set(c.position_m, d.position_m);
    c.t_s = d.t_s;
    c.duration_s = d.duration_s;
    c.radius_m = d.radius_m;
    c.height_m = d.height_m;
    c.path_m = d.path_m.empty() ? nullptr : d.path_m.front().data();
    c.path_count = d.path_m.size();
    c.speed_mps = d.speed_mps;
    c.path_open = d.path_open;
    set(c.hull_m, d.hull_m);
    c.depth_m = d.depth_m;
    all.push_back(c);
  }
  return all;
}

// A frame with what it points at.
class Frame {
 public:
  Frame(double t_s, PictureSize size, const RenderOptions& options)
      : labels_(joined(options.labels)),
        without_(joined(options.without)),
        poses_(c_poses(options.poses)),
        next_poses_(c_poses(options.next_poses)),
        disturbances_(c_disturbances(options.disturbances)) {
    frame_.t_s = t_s;
    frame_.width_px = size.width_px;
    frame_.height_px = size.height_px;
    frame_.camera = kept(options.camera, camera_);
    frame_.labels = c_text(labels_);
    frame_.linear = options.linear;
    frame_.next_frame_s = options.next_frame_s;
    frame_.next_camera = kept(options.next_camera, next_camera_);
    frame_.poses = poses_.data();
    frame_.next_poses = next_poses_.data();
    frame_.pose_count = poses_.size();
    frame_.next_pose_count = next_poses_.size();
    frame_.without = c_text(without_);
    frame_.water_triangles = options.water_triangles;
    frame_.terrain_triangles = options.terrain_triangles;
    frame_.lookup_scale = options.lookup_scale;
    frame_.edge_samples = options.edge_samples;
    frame_.disturbances = disturbances_.data();
    frame_.disturbance_count = disturbances_.size();
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  const swell_frame* get() const { return &frame_; }

 private:
  static const swell_camera* kept(const std::optional<Camera>& given, swell_camera& camera) {
    if (!given) return nullptr;
    camera = c_camera(*given);
    return &camera;
  }

  std::string labels_, without_;
  std::vector<swell_pose> poses_, next_poses_;
  std::vector<swell_disturbance> disturbances_;
  swell_camera camera_{}, next_camera_{};
  swell_frame frame_ = sized<swell_frame>();
};

// What the callbacks of a making are given. A callback that throws ends the making; its exception
// is thrown when that has ended.
struct Told {
  const WorldOptions& options;
  std::exception_ptr fault = {};

  template <class Call>
  bool goes_on(const Call& call) noexcept {
    if (fault) return false;
    try {
      return call();
    } catch (...) {
      fault = std::current_exception();
      return false;
    }
  }
  static std::int32_t progress(void* user, double done) {
    Told& told = *static_cast<Told*>(user);
    const bool goes_on =
        told.goes_on([&] { return !told.options.progress || told.options.progress(done); });
    return goes_on ? 0 : 1;
  }
  static void log(void* user, const char* line) {
    Told& told = *static_cast<Told*>(user);
    told.goes_on([&] { return told.options.log(line), true; });
  }
};

inline std::shared_ptr<const swell_world> make_world(swell_scene scene,
                                                     const WorldOptions& options) {
  std::vector<const char*> settings;
  for (const std::string& setting : options.settings) settings.push_back(c_text(setting));
  const std::string folder = options.folder.string();
  scene.folder = options.folder.empty() ? nullptr : c_text(folder);
  scene.settings = settings.data();
  scene.setting_count = settings.size();
  scene.threads = options.threads;
  scene.most_bytes = options.most_bytes;
  const std::string cache_folder = options.cache_folder.string();
  if (!cache_folder.empty()) scene.cache_folder = c_text(cache_folder);
  Told told{options};
  if (options.progress || options.log) scene.progress = Told::progress;
  if (options.log) scene.log = Told::log;
  scene.user = &told;
  swell_world* world = nullptr;
  const swell_status status = swell_world_create(&scene, &world);
  std::shared_ptr<const swell_world> made(
      world, [](const swell_world* w) { swell_world_destroy(const_cast<swell_world*>(w)); });
  if (told.fault) std::rethrow_exception(told.fault);
  check(status);
  return made;
}

template <class Handle, void (*destroy)(Handle*)>
struct Destroys {
  void operator()(Handle* handle) const { destroy(handle); }
};
template <class Handle, void (*destroy)(Handle*)>
using Owned = std::unique_ptr<Handle, Destroys<Handle, destroy>>;

template <class Value>
constexpr swell_type type_of() {
  static_assert(std::is_same_v<Value, std::uint8_t> || std::is_same_v<Value, std::uint32_t> ||
                    std::is_same_v<Value, float> || std::is_same_v<Value, double>,
                "planes hold std::uint8_t, std::uint32_t, float or double");
  if constexpr (std::is_same_v<Value, std::uint8_t>) return SWELL_UINT8;
  if constexpr (std::is_same_v<Value, std::uint32_t>) return SWELL_UINT32;
  if constexpr (std::is_same_v<Value, float>) return SWELL_FLOAT32;
  return SWELL_FLOAT64;
}

}  // namespace door

inline Camera Camera::look(Point3 eye_m, const Look& look, PictureSize size) {
  auto camera = door::sized<swell_camera>();
  door::check(swell_camera_look(eye_m.data(), look.heading_deg, look.pitch_deg, look.roll_deg,
                                look.fov_y_deg, size.width_px, size.height_px, &camera));
  return door::camera_of(camera);
}

namespace door {

// The quaternion of a rotation matrix, by its largest component.
// Source: S. W. Shepperd, Quaternion from Rotation Matrix, 1978.
inline std::array<double, 4> quaternion_of(const Matrix3& r) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  if (trace > 0.0) return {1.0 + trace, r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
  const std::size_t i = r[0][0] >= r[1][1] && r[0][0] >= r[2][2] ? 0 : r[1][1] >= r[2][2] ? 1 : 2;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  std::array<double, 4> q{};
  q[0] = r[k][j] - r[j][k];
  q[1 + i] = 1.0 + r[i][i] - r[j][j] - r[k][k];
  q[1 + j] = r[j][i] + r[i][j];
  q[1 + k] = r[k][i] + r[i][k];
  return q;  // of some length
}

// Whether its rows are unit vectors at right angles, right-handed.
inline bool is_rotation(const Matrix3& r) {
  const auto dot = [&](std::size_t a, std::size_t b) {
    return r[a][0] * r[b][0] + r[a][1] * r[b][1] + r[a][2] * r[b][2];
  };
  const auto is_near = [](double a, double b) { return a - b < 1e-6 && b - a < 1e-6; };
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      if (!is_near(dot(a, b), a == b ? 1.0 : 0.0)) return false;
  const double turn = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                      r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                      r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
  return turn > 0.0;
}

}  // namespace door

inline Camera Camera::from_pose(Point3 eye_m, const Matrix3& world_from_optical, const Matrix3& k) {
  if (!door::is_rotation(world_from_optical))
    door::refuse(
        "rotation, got a matrix that is none, allowed unit axes at right angles, right-handed");
  if (k[0][1] != 0.0 || k[1][0] != 0.0 || k[2] != Point3{0.0, 0.0, 1.0})
    door::refuse("k, got skew or another last row, allowed {{fx, 0, cx}, {0, fy, cy}, {0, 0, 1}}");
  return {eye_m, door::quaternion_of(world_from_optical), {k[0][0], k[1][1]}, {k[0][2], k[1][2]}};
}

inline Camera Camera::from_opencv(const Matrix3& k, const Matrix3& rotation, Point3 translation_m) {
  const Matrix3& r = rotation;
  Matrix3 transposed{};
  Point3 eye_m{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      transposed[i][j] = r[j][i];
      eye_m[i] -= r[j][i] * translation_m[j];
    }
  Camera camera = from_pose(eye_m, transposed, k);
  for (double& c : camera.principal_px) c += 0.5;
  return camera;
}

// A drawn picture. It can be moved; its planes stay where they are.
class Picture {
 public:
  Picture() = default;

  // A plane by its name: "rgba" (std::uint8_t), "linear" (float), or a label that was drawn
  // (swell_picture_plane has their types). Throws Error where Value is of another type.
  template <class Value>
  Plane<Value> plane(const std::string& name) const {
    auto found = door::sized<swell_plane>();
    door::check(swell_picture_plane(handle_.get(), door::c_text(name), &found));
    if (found.type != door::type_of<Value>())
      door::refuse("plane, got another type than that of '" + name + "', allowed its own");
    return {{static_cast<const Value*>(found.data), found.bytes / sizeof(Value)},
            found.width_px,
            found.height_px,
            found.components};
  }

  // 16 hex digits: what swell-render --hash prints of the same picture.
  std::string hash() const {
    std::uint64_t hash = 0;
    door::check(swell_picture_hash(handle_.get(), &hash));
    return door::hex(hash);
  }

  // The camera that it was drawn with.
  Camera camera() const {
    auto camera = door::sized<swell_camera>();
    door::check(swell_picture_camera(handle_.get(), &camera));
    return door::camera_of(camera);
  }

  // For calls of swell.h; null before something was drawn.
  swell_picture* handle() const { return handle_.get(); }

 private:
  friend class World;
  door::Owned<swell_picture, swell_picture_destroy> handle_;
};

// A scene made ready to draw and to ask.
class World {
 public:
  // Of a scene file, TOML or JSON. Takes 20 ms to some seconds.
  explicit World(const std::filesystem::path& scene, const WorldOptions& options = {})
      : threads_(options.threads) {
    const std::string path = scene.string();
    auto c = door::sized<swell_scene>();
    c.path = door::c_text(path);
    world_ = door::make_world(c, options);
  }
  // Of a scene's text.
  static World of_text(const std::string& text, const WorldOptions& options = {}) {
    auto c = door::sized<swell_scene>();
    c.text = door::c_text(text);
    return {door::make_world(c, options), options.threads};
  }
  World(const World& other) : world_(other.world_), threads_(other.threads_) {}
  World& operator=(const World& other) { return *this = World(other); }
  World(World&&) = default;
  World& operator=(World&&) = default;

  // The scene as TOML with every value written out.
  std::string text() const { return swell_world_text(world_.get()); }
  // 16 hex digits: XXH3-64 of that.
  std::string hash() const {
    std::uint64_t hash = 0;
    door::check(swell_world_hash(world_.get(), &hash));
    return door::hex(hash);
  }
  std::vector<Object> objects() const;
  // The name of each class of the label "class".
  std::vector<std::string> classes() const {
    std::vector<std::string> names;
    const auto count = [&] { return static_cast<std::uint32_t>(names.size()); };
    while (const char* name = swell_class_name(world_.get(), count())) names.emplace_back(name);
    return names;
  }

  // Draws the world at a time.
  Picture render(double t_s, PictureSize size = {}, const RenderOptions& options = {}) {
    Picture picture;
    render_into(picture, t_s, size, options);
    return picture;
  }
  // Into a picture whose memory is used again.
  void render_into(Picture& picture, double t_s, PictureSize size = {},
                   const RenderOptions& options = {});

  // What the last picture that this World drew shows at a point of it; pixel (i, j) has its centre
  // at (i + 0.5, j + 0.5).
  Pick pick(Point2 p_px);

  // The camera that render() would draw with.
  Camera camera(double t_s, PictureSize size = {}, const RenderOptions& options = {}) {
    const door::Frame frame(t_s, size, options);
    auto camera = door::sized<swell_camera>();
    door::check(swell_frame_camera(session(), frame.get(), &camera));
    return door::camera_of(camera);
  }

  // Where the scene and the water have its objects, in its order.
  std::vector<Pose> poses(double t_s);

  // Of the drawn water at points (east, north) and a time: metres over the mean sea level, dz/dx
  // and dz/dy, unit normals, m/s of the surface, and the part that foam hides.
  using Disturbances = ListOf<Disturbance>;
  std::vector<float> height(ListOf<Point2> xy_m, double t_s, Disturbances disturbances = {}) {
    return ask<float>(xy_m, t_s, disturbances, &swell_query::height_m);
  }
  std::vector<std::array<float, 2>> slope(ListOf<Point2> xy_m, double t_s,
                                          Disturbances disturbances = {}) {
    return ask<std::array<float, 2>>(xy_m, t_s, disturbances, &swell_query::slope);
  }
  std::vector<std::array<float, 3>> normal(ListOf<Point2> xy_m, double t_s,
                                           Disturbances disturbances = {}) {
    return ask<std::array<float, 3>>(xy_m, t_s, disturbances, &swell_query::normal);
  }
  std::vector<std::array<float, 3>> velocity(ListOf<Point2> xy_m, double t_s,
                                             Disturbances disturbances = {}) {
    return ask<std::array<float, 3>>(xy_m, t_s, disturbances, &swell_query::velocity_mps);
  }
  std::vector<float> foam(ListOf<Point2> xy_m, double t_s) {
    return ask<float>(xy_m, t_s, {}, &swell_query::foam);
  }
  // Of the ground under the mean sea level; infinite without terrain.
  std::vector<float> still_depth(ListOf<Point2> xy_m) {
    return ask<float>(xy_m, 0.0, {}, &swell_query::still_depth_m);
  }

  // How the water moves at points on and below the surface; of this density, 0: 1025 kg/m3.
  std::vector<Motion> below(ListOf<Point3> xyz_m, double t_s, double density_kg_m3 = 0.0,
                            Disturbances disturbances = {});
  // Forces on what of a hull is under the surface.
  HullLoads hull_loads(const Hull& hull, double t_s, Disturbances disturbances = {});

  // The first place where a ray passes the water.
  std::optional<Hit> ray(Point3 origin_m, Point3 direction, double t_s,
                         double max_distance_m = 1e5);

  // What the beams of a lidar get back.
  std::vector<LidarReturn> lidar(double t_s, const LidarPose& pose, ListOf<LidarBeam> beams,
                                 const LidarOptions& options = {});

  // For calls of swell.h.
  const swell_world* handle() const { return world_.get(); }
  // Made with the first call that needs one.
  swell_session* session() {
    if (!session_) {
      swell_session* made = nullptr;
      door::check(swell_session_create(world_.get(), threads_, &made));
      session_.reset(made);
    }
    return session_.get();
  }

 private:
  World(std::shared_ptr<const swell_world> world, int threads)
      : world_(std::move(world)), threads_(threads) {}

  template <class Value>
  std::vector<Value> ask(std::span<const Point2> xy_m, double t_s,
                         std::span<const Disturbance> disturbances, float* swell_query::*answer);

  std::shared_ptr<const swell_world> world_;
  int threads_ = 0;
  door::Owned<swell_session, swell_session_destroy> session_;
};

inline std::vector<Object> World::objects() const {
  std::vector<Object> all;
  for (std::size_t n = 0; n < swell_object_count(world_.get()); ++n) {
    auto o = door::sized<swell_object>();
    door::check(swell_object_info(world_.get(), n, &o));
    all.push_back({o.id, o.klass, o.name, o.class_name, o.kind});
  }
  return all;
}

inline void World::render_into(Picture& picture, double t_s, PictureSize size,
                               const RenderOptions& options) {
  const door::Frame frame(t_s, size, options);
  if (!picture.handle_) {
    swell_picture* made = nullptr;
    door::check(swell_picture_create(&made));
    picture.handle_.reset(made);
  }
  door::check(swell_render(session(), frame.get(), picture.handle_.get()));
}

inline Pick World::pick(Point2 p_px) {
  auto found = door::sized<swell_pick>();
  door::check(swell_pick_at(session(), p_px[0], p_px[1], &found));
  Pick pick{found.what,    door::array_of(found.position_m), found.distance_m, {}, found.id,
            found.height_m};
  if (found.what == SWELL_SHOWS_OBJECT) pick.object = found.object;
  return pick;
}

inline std::vector<Pose> World::poses(double t_s) {
  std::vector<swell_pose> found(swell_object_count(world_.get()), door::sized<swell_pose>());
  door::check(swell_object_poses(session(), t_s, found.data(), found.size()));
  std::vector<Pose> all;
  for (const swell_pose& p : found)
    all.push_back({p.object, door::array_of(p.position_m), door::array_of(p.quaternion_wxyz)});
  return all;
}

template <class Value>
std::vector<Value> World::ask(std::span<const Point2> xy_m, double t_s,
                              std::span<const Disturbance> disturbances,
                              float* swell_query::*answer) {
  static_assert(sizeof(Point2) == 2 * sizeof(double) && sizeof(Value) % sizeof(float) == 0);
  std::vector<Value> values(xy_m.size());
  const std::vector<swell_disturbance> c_list = door::c_disturbances(disturbances);
  auto query = door::sized<swell_query>();
  query.t_s = t_s;
  query.count = xy_m.size();
  query.xy_m = xy_m.empty() ? nullptr : xy_m.front().data();
  query.*answer = reinterpret_cast<float*>(values.data());
  query.disturbances = c_list.data();
  query.disturbance_count = c_list.size();
  door::check(swell_ask(session(), &query));
  return values;
}

inline std::vector<Motion> World::below(ListOf<Point3> xyz_m, double t_s, double density_kg_m3,
                                        Disturbances disturbances) {
  static_assert(sizeof(Point3) == 3 * sizeof(double));
  const std::size_t count = xyz_m.size();
  std::vector<float> velocity(3 * count), acceleration(3 * count), pressure(count);
  std::vector<std::uint8_t> place(count);
  const std::vector<swell_disturbance> c_list = door::c_disturbances(disturbances);
  auto query = door::sized<swell_below>();
  query.t_s = t_s;
  query.count = count;
  query.xyz_m = xyz_m.empty() ? nullptr : xyz_m.front().data();
  query.density_kg_m3 = density_kg_m3;
  query.velocity_mps = velocity.data();
  query.acceleration_mps2 = acceleration.data();
  query.pressure_pa = pressure.data();
  query.place = place.data();
  query.disturbances = c_list.data();
  query.disturbance_count = c_list.size();
  door::check(swell_ask_below(session(), &query));
  std::vector<Motion> motion(count);
  for (std::size_t i = 0; i < count; ++i) {
    motion[i].place = static_cast<swell_place>(place[i]);
    motion[i].pressure_pa = pressure[i];
    for (std::size_t c = 0; c < 3; ++c) {
      motion[i].velocity_mps[c] = velocity[3 * i + c];
      motion[i].acceleration_mps2[c] = acceleration[3 * i + c];
    }
  }
  return motion;
}

inline HullLoads World::hull_loads(const Hull& hull, double t_s, Disturbances disturbances) {
  const std::vector<swell_disturbance> c_list = door::c_disturbances(disturbances);
  auto c = door::sized<swell_hull>();
  c.t_s = t_s;
  c.xyz_m = hull.xyz_m.empty() ? nullptr : hull.xyz_m.front().data();
  c.point_count = hull.xyz_m.size();
  c.triangles = hull.triangles.empty() ? nullptr : hull.triangles.front().data();
  c.triangle_count = hull.triangles.size();
  door::set(c.about_m, hull.about_m);
  c.density_kg_m3 = hull.density_kg_m3;
  c.disturbances = c_list.data();
  c.disturbance_count = c_list.size();
  auto loads = door::sized<swell_loads>();
  door::check(swell_hull_loads(session(), &c, &loads));
  return {{door::array_of(loads.buoyancy_n), door::array_of(loads.buoyancy_nm)},
          {door::array_of(loads.froude_krylov_n), door::array_of(loads.froude_krylov_nm)}};
}

inline std::optional<Hit> World::ray(Point3 origin_m, Point3 direction, double t_s,
                                     double max_distance_m) {
  auto hit = door::sized<swell_hit>();
  door::check(swell_ray(session(), t_s, origin_m.data(), direction.data(), max_distance_m, &hit));
  if (!hit.hits) return std::nullopt;
  return Hit{door::array_of(hit.position_m), hit.distance_m, hit.from_above != 0};
}

inline std::vector<LidarReturn> World::lidar(double t_s, const LidarPose& pose,
                                             ListOf<LidarBeam> beams, const LidarOptions& options) {
  static_assert(sizeof(LidarBeam) == 3 * sizeof(double));
  const std::size_t count = beams.size();
  std::vector<float> range(count), intensity(count), incidence(count), point(3 * count);
  std::vector<std::uint32_t> id(count), klass(count);
  const std::vector<swell_pose> poses = door::c_poses(options.poses);
  const std::vector<swell_disturbance> c_list = door::c_disturbances(options.disturbances);
  auto c = door::sized<swell_lidar>();
  c.t_s = t_s;
  door::set(c.position_m, pose.position_m);
  door::set(c.quaternion_wxyz, pose.quaternion_wxyz);
  c.beams = beams.empty() ? nullptr : &beams.front().azimuth_deg;
  c.count = count;
  const LidarPose end = options.end.value_or(pose);
  c.duration_s = options.duration_s;
  door::set(c.end_position_m, end.position_m);
  door::set(c.end_quaternion_wxyz, end.quaternion_wxyz);
  c.moments = options.moments;
  c.least_m = options.least_m, c.most_m = options.most_m;
  c.reach_m = options.reach_m, c.range_noise_m = options.range_noise_m;
  c.seed = options.seed;
  c.poses = poses.data(), c.pose_count = poses.size();
  c.disturbances = c_list.data(), c.disturbance_count = c_list.size();
  c.range_m = range.data(), c.intensity = intensity.data(), c.incidence_deg = incidence.data();
  c.id = id.data(), c.klass = klass.data(), c.point_m = point.data();
  door::check(swell_scan(session(), &c));
  std::vector<LidarReturn> returns(count);
  for (std::size_t i = 0; i < count; ++i)
    returns[i] = {range[i], intensity[i], incidence[i],
                  id[i],    klass[i],     {point[3 * i], point[3 * i + 1], point[3 * i + 2]}};
  return returns;
}

// A clockwise turn of a model whose beams are known ("hdl-32e"), column after column from the
// lowest beam up, and an even grid, rows from the top: swell_spinning_beams(), swell_grid_beams().
inline std::vector<LidarBeam> spinning_beams(const std::string& model, int columns = 1024,
                                             double start_deg = 0.0, double duration_s = 0.1) {
  std::vector<LidarBeam> beams(static_cast<std::size_t>(columns > 0 ? columns : 0) *
                               swell_lidar_beams(model.c_str()));
  LidarBeam none;
  door::check(swell_spinning_beams(model.c_str(), columns, start_deg, duration_s,
                                   beams.empty() ? &none.azimuth_deg : &beams.front().azimuth_deg,
                                   beams.size()));
  return beams;
}
inline std::vector<LidarBeam> grid_beams(PictureSize size, double fov_x_deg, double fov_y_deg,
                                         double duration_s = 0.0) {
  std::vector<LidarBeam> beams;
  if (size.width_px > 0 && size.height_px > 0)
    beams.resize(static_cast<std::size_t>(size.width_px) *
                 static_cast<std::size_t>(size.height_px));
  LidarBeam none;
  door::check(swell_grid_beams(size.width_px, size.height_px, fov_x_deg, fov_y_deg, duration_s,
                               beams.empty() ? &none.azimuth_deg : &beams.front().azimuth_deg,
                               beams.size()));
  return beams;
}

// Every key of scene files.
inline std::vector<Key> keys() {
  std::vector<Key> all;
  for (std::size_t n = 0; n < swell_key_count(); ++n) {
    auto key = door::sized<swell_key>();
    door::check(swell_key_info(n, &key));
    all.push_back({key.table, key.name, key.unit, key.allowed, key.meaning});
  }
  return all;
}

// The names of the labels, and of the parts that a picture can be drawn without.
inline std::vector<std::string> labels() {
  std::vector<std::string> names;
  while (const char* name = swell_label_name(names.size())) names.emplace_back(name);
  return names;
}
inline std::vector<std::string> parts() {
  std::vector<std::string> names;
  while (const char* name = swell_part_name(names.size())) names.emplace_back(name);
  return names;
}

}  // namespace swell
