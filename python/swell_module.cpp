// The part of the Python package swell that is not written in Python: over the C interface, whose
// handles it keeps and whose results it gives as NumPy arrays. python/swell/__init__.py is what
// programs see.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <swell.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "handles.h"
#include "scan.h"
#include "tuples.h"

namespace swell_python {
namespace {

py::dtype dtype_of(swell_type type) {
  switch (type) {
    case SWELL_UINT8:
      return py::dtype::of<std::uint8_t>();
    case SWELL_UINT32:
      return py::dtype::of<std::uint32_t>();
    case SWELL_FLOAT32:
      return py::dtype::of<float>();
    case SWELL_FLOAT64:
      return py::dtype::of<double>();
  }
  throw std::logic_error("a plane of an unknown type");
}

// As C has it, which would end the text at a NUL.
const char* c_text(const std::string& text, const char* name) {
  if (text.find('\0') != std::string::npos)
    throw py::value_error(std::string(name) + ", got a text with a NUL, allowed others");
  return text.c_str();
}

const char* c_text(const std::optional<std::string>& text, const char* name) {
  return text ? c_text(*text, name) : nullptr;
}

// What Python's __new__ gives without __init__ is storage alone, which pybind11 takes from the
// class's own operator new: all zero, so that is_made() can tell.
struct ZeroedStorage {
  static void* operator new(std::size_t bytes) {
    return std::memset(::operator new(bytes), 0, bytes);
  }
  static void* operator new(std::size_t, void* place) { return place; }
  static void operator delete(void* storage) { ::operator delete(storage); }
};

// The object, unless it had no __init__.
template <class Class>
const Class& made(const Class& object) {
  if (!object.is_made()) throw py::type_error("got an object without __init__, allowed one with");
  return object;
}

// A member as a function that refuses an object without __init__.
template <class Class, class Result, class... Arguments>
auto of_made(Result (Class::*member)(Arguments...) const) {
  return [member](const Class& object, Arguments... arguments) -> Result {
    return (made(object).*member)(std::forward<Arguments>(arguments)...);
  };
}

// A drawn picture; its arrays keep it alive.
class Picture : public ZeroedStorage {
 public:
  bool is_made() const { return pool_ != nullptr; }
  Picture(std::shared_ptr<Pool> pool, Owned<swell_picture> handle, std::vector<PickTuple> picks)
      : pool_(std::move(pool)), handle_(std::move(handle)), picks_(std::move(picks)) {}
  Picture(Picture&&) = default;
  ~Picture() {
    if (pool_) pool_->give_back(std::move(handle_));
  }

  static py::array plane(const py::object& self, const std::string& name) {
    const auto& picture = made(self.cast<const Picture&>());
    const char* const c_name = c_text(name, "plane");
    swell_plane plane{};
    plane.size = sizeof(plane);
    call([&] { return swell_picture_plane(picture.handle_.get(), c_name, &plane); });
    std::vector<py::ssize_t> shape = {plane.height_px, plane.width_px};
    if (plane.components > 1) shape.push_back(plane.components);
    return py::array(dtype_of(plane.type), shape, plane.data, self);
  }

  std::uint64_t hash() const {
    std::uint64_t hash = 0;
    call([&] { return swell_picture_hash(handle_.get(), &hash); });
    return hash;
  }

  std::vector<PickTuple> picks() const { return picks_; }

  CameraTuple camera() const {
    swell_camera camera{};
    camera.size = sizeof(camera);
    check(swell_picture_camera(handle_.get(), &camera));
    return tuple_of(camera);
  }

 private:
  std::shared_ptr<Pool> pool_;
  Owned<swell_picture> handle_;
  std::vector<PickTuple> picks_;
};

using SizeTuple = std::array<int, 2>;  // width, height

struct FrameArguments {
  double t_s = 0.0;
  int width_px = 0, height_px = 0;
  std::string labels = {}, without = {};
  bool linear = false;
  std::optional<CameraTuple> camera = {}, next_camera = {};
  double next_frame_s = 0.0;
  std::vector<PoseTuple> poses = {}, next_poses = {};
  int water_triangles = 0, terrain_triangles = 0;
  double lookup_scale = 0.0;
  int edge_samples = 0;
  std::vector<DisturbanceTuple> disturbances = {};
  std::vector<std::array<double, 2>> picks = {};  // in pixels
};

// Arguments as the library takes them, which point into this.
class Frame {
 public:
  explicit Frame(const FrameArguments& in)
      : camera_(in.camera ? camera_of(*in.camera) : swell_camera{}),
        next_camera_(in.next_camera ? camera_of(*in.next_camera) : swell_camera{}),
        poses_(poses_of(in.poses)),
        next_poses_(poses_of(in.next_poses)),
        disturbances_(disturbances_of(in.disturbances)) {
    frame_.size = sizeof(frame_);
    frame_.t_s = in.t_s;
    frame_.width_px = in.width_px;
    frame_.height_px = in.height_px;
    frame_.labels = c_text(in.labels, "labels");
    frame_.without = c_text(in.without, "without");
    frame_.linear = in.linear;
    frame_.camera = in.camera ? &camera_ : nullptr;
    frame_.next_camera = in.next_camera ? &next_camera_ : nullptr;
    frame_.next_frame_s = in.next_frame_s;
    frame_.poses = poses_.data();
    frame_.pose_count = poses_.size();
    frame_.next_poses = next_poses_.data();
    frame_.next_pose_count = next_poses_.size();
    frame_.water_triangles = in.water_triangles;
    frame_.terrain_triangles = in.terrain_triangles;
    frame_.lookup_scale = in.lookup_scale;
    frame_.edge_samples = in.edge_samples;
    frame_.disturbances = disturbances_.data();
    frame_.disturbance_count = disturbances_.size();
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  const swell_frame* get() const { return &frame_; }
  void take_disturbances(const swell_frame& of) {
    frame_.disturbances = of.disturbances;
    frame_.disturbance_count = of.disturbance_count;
  }

 private:
  swell_frame frame_{};
  swell_camera camera_, next_camera_;
  std::vector<swell_pose> poses_, next_poses_;
  std::vector<swell_disturbance> disturbances_;
};

class World : public ZeroedStorage {
 public:
  bool is_made() const { return pool_ != nullptr; }
  World(const std::optional<std::string>& path, const std::optional<std::string>& text,
        const std::optional<std::string>& folder, const std::vector<std::string>& settings,
        int threads, const std::optional<std::string>& cache) {
    std::vector<const char*> setting_texts;
    for (const std::string& setting : settings) setting_texts.push_back(c_text(setting, "set"));
    swell_scene scene{};
    scene.size = sizeof(scene);
    scene.path = c_text(path, "scene's path");
    scene.text = c_text(text, "scene");
    scene.folder = c_text(folder, "folder");
    scene.settings = setting_texts.data();
    scene.setting_count = setting_texts.size();
    scene.threads = threads;
    scene.cache_folder = c_text(cache, "cache");
    swell_world* world = nullptr;
    call([&] { return swell_world_create(&scene, &world); });
    pool_ = std::make_shared<Pool>(Owned<swell_world>(world), threads);
  }

  std::string text() const { return swell_world_text(pool_->world()); }

  std::uint64_t hash() const {
    std::uint64_t hash = 0;
    check(swell_world_hash(pool_->world(), &hash));
    return hash;
  }

  // Id, class, name, name of the class, kind.
  using ObjectTuple =
      std::tuple<std::uint32_t, std::uint32_t, std::string, std::string, std::string>;
  std::vector<ObjectTuple> objects() const {
    std::vector<ObjectTuple> all;
    for (std::size_t n = 0; n < swell_object_count(pool_->world()); ++n) {
      swell_object o{};
      o.size = sizeof(o);
      check(swell_object_info(pool_->world(), n, &o));
      all.emplace_back(o.id, o.klass, o.name, o.class_name, o.kind);
    }
    return all;
  }

  std::vector<std::string> classes() const {
    std::vector<std::string> names;
    while (const char* name = swell_class_name(pool_->world(), std::uint32_t(names.size())))
      names.emplace_back(name);
    return names;
  }

  CameraTuple camera(double t_s, int width_px, int height_px,
                     const std::vector<PoseTuple>& pose_tuples,
                     const std::vector<DisturbanceTuple>& disturbance_tuples) const {
    swell_frame frame{};
    frame.size = sizeof(frame);
    frame.t_s = t_s;
    frame.width_px = width_px;
    frame.height_px = height_px;
    const std::vector<swell_pose> poses = poses_of(pose_tuples);
    frame.poses = poses.data();
    frame.pose_count = poses.size();
    const std::vector<swell_disturbance> disturbances = disturbances_of(disturbance_tuples);
    frame.disturbances = disturbances.data();
    frame.disturbance_count = disturbances.size();
    swell_camera camera{};
    camera.size = sizeof(camera);
    call([&] {
      const Session session(*pool_);
      return swell_frame_camera(session.get(), &frame, &camera);
    });
    return tuple_of(camera);
  }

  Picture render(const FrameArguments& in) const {
    const Frame frame(in);
    Owned<swell_picture> picture = pool_->take_picture();
    std::vector<PickTuple> picks;
    call([&] {
      const Session session(*pool_);
      swell_status status = swell_render(session.get(), frame.get(), picture.get());
      for (std::size_t i = 0; i < in.picks.size() && status == SWELL_OK; ++i) {
        swell_pick pick{};
        pick.size = sizeof(pick);
        status = swell_pick_at(session.get(), in.picks[i][0], in.picks[i][1], &pick);
        picks.emplace_back(
            pick.what,
            std::array<double, 3>{pick.position_m[0], pick.position_m[1], pick.position_m[2]},
            pick.distance_m, pick.object, pick.id, pick.height_m);
      }
      return status;
    });
    return {pool_, std::move(picture), std::move(picks)};
  }

  // Frames of one time with one list of disturbances, the first's.
  std::vector<Picture> render_many(const std::vector<FrameArguments>& in) const {
    std::deque<Frame> frames;
    std::vector<const swell_frame*> given;
    std::vector<Owned<swell_picture>> pictures;
    std::vector<swell_picture*> into;
    for (const FrameArguments& one : in) {
      given.push_back(frames.emplace_back(one).get());
      frames.back().take_disturbances(*given.front());
      into.push_back(pictures.emplace_back(pool_->take_picture()).get());
    }
    call([&] {
      const Session session(*pool_);
      return swell_render_many(session.get(), given.data(), into.data(), given.size());
    });
    std::vector<Picture> drawn;
    for (Owned<swell_picture>& picture : pictures)
      drawn.emplace_back(pool_, std::move(picture), std::vector<PickTuple>());
    return drawn;
  }

  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

  // One result at points [..., 2]: an array of their shape, and of a vector's length if it has more
  // than one component.
  py::array_t<float> ask(const Numbers& xy_m, double t_s, const std::string& what,
                         const std::vector<DisturbanceTuple>& given) const {
    if (xy_m.ndim() < 1 || xy_m.shape(xy_m.ndim() - 1) != 2)
      throw py::value_error(
          "xy, got an array whose last axis is not of length 2, allowed [..., 2]");
    std::vector<py::ssize_t> shape(xy_m.shape(), xy_m.shape() + xy_m.ndim() - 1);
    const std::size_t components = what == "slope"                          ? 2
                                   : what == "normal" || what == "velocity" ? 3
                                                                            : 1;
    if (components > 1) shape.push_back(py::ssize_t(components));
    py::array_t<float> result(shape);
    swell_query query{};
    query.size = sizeof(query);
    query.t_s = t_s;
    query.count = std::size_t(xy_m.size() / 2);
    query.xy_m = xy_m.data();
    *output_of(query, what) = result.mutable_data();
    const std::vector<swell_disturbance> disturbances = disturbances_of(given);
    query.disturbances = disturbances.data();
    query.disturbance_count = disturbances.size();
    call([&] {
      const Session session(*pool_);
      return swell_ask(session.get(), &query);
    });
    return result;
  }

  // Of beams [..., 3]: arrays of their shape.
  py::dict scan(const BeamArray& beams, const ScanArguments& in) const {
    if (beams.ndim() < 1 || beams.shape(beams.ndim() - 1) != 3)
      throw py::value_error(
          "beams, got an array whose last axis is not of length 3, allowed [..., 3]");
    std::vector<py::ssize_t> shape(beams.shape(), beams.shape() + beams.ndim() - 1);
    py::array_t<float> range(shape), intensity(shape), incidence(shape);
    py::array_t<std::uint32_t> id(shape), klass(shape);
    shape.push_back(3);
    py::array_t<float> point(shape);
    swell_lidar lidar = in.lidar();
    lidar.beams = beams.data();
    lidar.count = std::size_t(beams.size() / 3);
    lidar.range_m = range.mutable_data();
    lidar.intensity = intensity.mutable_data();
    lidar.incidence_deg = incidence.mutable_data();
    lidar.id = id.mutable_data();
    lidar.klass = klass.mutable_data();
    lidar.point_m = point.mutable_data();
    const std::vector<swell_pose> objects = poses_of(in.poses);
    lidar.poses = objects.data();
    lidar.pose_count = objects.size();
    const std::vector<swell_disturbance> disturbances = disturbances_of(in.disturbances);
    lidar.disturbances = disturbances.data();
    lidar.disturbance_count = disturbances.size();
    call([&] {
      const Session session(*pool_);
      return swell_scan(session.get(), &lidar);
    });
    using py::literals::operator""_a;
    return py::dict("range"_a = range, "intensity"_a = intensity, "incidence"_a = incidence,
                    "id"_a = id, "klass"_a = klass, "point"_a = point);
  }

  // Of points [..., 3]: velocities and accelerations [..., 3], pressures and places [...].
  using BelowTuple = std::tuple<py::array_t<float>, py::array_t<float>, py::array_t<float>,
                                py::array_t<std::uint8_t>>;
  BelowTuple below(const Numbers& xyz_m, double t_s, double density_kg_m3,
                   const std::vector<DisturbanceTuple>& given) const {
    if (xyz_m.ndim() < 1 || xyz_m.shape(xyz_m.ndim() - 1) != 3)
      throw py::value_error(
          "xyz, got an array whose last axis is not of length 3, allowed [..., 3]");
    const std::vector<py::ssize_t> vectors(xyz_m.shape(), xyz_m.shape() + xyz_m.ndim());
    const std::vector<py::ssize_t> scalars(vectors.begin(), vectors.end() - 1);
    py::array_t<float> velocity(vectors), acceleration(vectors), pressure(scalars);
    py::array_t<std::uint8_t> place(scalars);
    swell_below query{};
    query.size = sizeof(query);
    query.t_s = t_s;
    query.count = std::size_t(xyz_m.size() / 3);
    query.xyz_m = xyz_m.data();
    query.density_kg_m3 = density_kg_m3;
    query.velocity_mps = velocity.mutable_data();
    query.acceleration_mps2 = acceleration.mutable_data();
    query.pressure_pa = pressure.mutable_data();
    query.place = place.mutable_data();
    const std::vector<swell_disturbance> disturbances = disturbances_of(given);
    query.disturbances = disturbances.data();
    query.disturbance_count = disturbances.size();
    call([&] {
      const Session session(*pool_);
      return swell_ask_below(session.get(), &query);
    });
    return {velocity, acceleration, pressure, place};
  }

  // Of points (n, 3) and triangles (m, 3): buoyancy and Froude-Krylov, each force and moment.
  using Vector = std::array<double, 3>;
  std::tuple<Vector, Vector, Vector, Vector> hull_loads(
      const Numbers& xyz_m,
      const py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>& triangles,
      double t_s, const Vector& about_m, double density_kg_m3,
      const std::vector<DisturbanceTuple>& given) const {
    swell_hull hull{};
    hull.size = sizeof(hull);
    hull.t_s = t_s;
    hull.xyz_m = xyz_m.data();
    hull.point_count = std::size_t(xyz_m.size() / 3);
    hull.triangles = triangles.data();
    hull.triangle_count = std::size_t(triangles.size() / 3);
    std::copy(about_m.begin(), about_m.end(), hull.about_m);
    hull.density_kg_m3 = density_kg_m3;
    const std::vector<swell_disturbance> disturbances = disturbances_of(given);
    hull.disturbances = disturbances.data();
    hull.disturbance_count = disturbances.size();
    swell_loads loads{};
    loads.size = sizeof(loads);
    call([&] {
      const Session session(*pool_);
      return swell_hull_loads(session.get(), &hull, &loads);
    });
    return {std::to_array(loads.buoyancy_n), std::to_array(loads.buoyancy_nm),
            std::to_array(loads.froude_krylov_n), std::to_array(loads.froude_krylov_nm)};
  }

  std::vector<PoseTuple> poses(double t_s) const {
    std::vector<swell_pose> found(swell_object_count(pool_->world()));
    for (swell_pose& pose : found) pose.size = sizeof(pose);
    call([&] {
      const Session session(*pool_);
      return swell_object_poses(session.get(), t_s, found.data(), found.size());
    });
    std::vector<PoseTuple> tuples;
    for (const swell_pose& p : found)
      tuples.push_back({p.object,
                        {p.position_m[0], p.position_m[1], p.position_m[2]},
                        {p.quaternion_wxyz[0], p.quaternion_wxyz[1], p.quaternion_wxyz[2],
                         p.quaternion_wxyz[3]}});
    return tuples;
  }

  // Position, distance, whether out of the air; nothing: no hit.
  using HitTuple = std::tuple<std::array<double, 3>, double, bool>;
  std::optional<HitTuple> ray(double t_s, std::array<double, 3> origin_m,
                              std::array<double, 3> direction, double max_distance_m) const {
    swell_hit hit{};
    hit.size = sizeof(hit);
    call([&] {
      const Session session(*pool_);
      return swell_ray(session.get(), t_s, origin_m.data(), direction.data(), max_distance_m, &hit);
    });
    if (!hit.hits) return std::nullopt;
    return HitTuple{{hit.position_m[0], hit.position_m[1], hit.position_m[2]},
                    hit.distance_m,
                    hit.from_above != 0};
  }

 private:
  static float** output_of(swell_query& query, const std::string& what) {
    if (what == "height") return &query.height_m;
    if (what == "slope") return &query.slope;
    if (what == "normal") return &query.normal;
    if (what == "velocity") return &query.velocity_mps;
    if (what == "foam") return &query.foam;
    if (what == "still_depth") return &query.still_depth_m;
    throw std::logic_error("no such result: " + what);
  }

  std::shared_ptr<Pool> pool_;
};

// Table, name, unit, allowed values, meaning.
using KeyTuple = std::tuple<std::string, std::string, std::string, std::string, std::string>;

std::vector<KeyTuple> keys() {
  std::vector<KeyTuple> all;
  for (std::size_t n = 0; n < swell_key_count(); ++n) {
    swell_key key{};
    key.size = sizeof(key);
    check(swell_key_info(n, &key));
    all.emplace_back(key.table, key.name, key.unit, key.allowed, key.meaning);
  }
  return all;
}

// Those of a function of numbers from 0 on that gives null after the last.
std::vector<std::string> names(const char* (*name_of)(std::size_t)) {
  std::vector<std::string> all;
  while (const char* name = name_of(all.size())) all.emplace_back(name);
  return all;
}

}  // namespace
}  // namespace swell_python

PYBIND11_MODULE(_swell, module) {
  using namespace swell_python;
  module.doc() = "What swell is written on: the C interface of the library.";
  py::register_exception<SceneError>(module, "SceneError", PyExc_ValueError);
  module.def("version", &swell_version);
  module.def("keys", &keys);
  module.def("labels", [] { return names(&swell_label_name); });
  module.def("parts", [] { return names(&swell_part_name); });
  module.def("lidars", [] { return names(&swell_lidar_name); });
  module.def(
      "spinning_beams",
      [](const std::string& model, int columns, double start_deg, double duration_s) {
        return spinning_beams(c_text(model, "model"), columns, start_deg, duration_s);
      },
      py::arg("model"), py::arg("columns"), py::arg("start_deg"), py::arg("duration_s"));
  module.def("grid_beams", &grid_beams, py::arg("size"), py::arg("fov_deg"), py::arg("duration_s"));
  module.def("look", &look, py::arg("eye"), py::arg("heading_deg"), py::arg("pitch_deg"),
             py::arg("roll_deg"), py::arg("fov_y_deg"), py::arg("width"), py::arg("height"));

  py::class_<Picture>(module, "Picture")
      .def("plane", &Picture::plane, py::arg("name"))
      .def("hash", of_made(&Picture::hash))
      .def("picks", of_made(&Picture::picks))
      .def("camera", of_made(&Picture::camera));

  py::class_<World>(module, "World")
      .def(py::init<const std::optional<std::string>&, const std::optional<std::string>&,
                    const std::optional<std::string>&, const std::vector<std::string>&, int,
                    const std::optional<std::string>&>(),
           py::arg("path"), py::arg("text"), py::arg("folder"), py::arg("settings"),
           py::arg("threads"), py::arg("cache"))
      .def("text", of_made(&World::text))
      .def("hash", of_made(&World::hash))
      .def("objects", of_made(&World::objects))
      .def("classes", of_made(&World::classes))
      .def("camera", of_made(&World::camera), py::arg("t"), py::arg("width"), py::arg("height"),
           py::arg("poses"), py::arg("disturbances"))
      .def("ask", of_made(&World::ask), py::arg("xy"), py::arg("t"), py::arg("what"),
           py::arg("disturbances"))
      .def("below", of_made(&World::below), py::arg("xyz"), py::arg("t"), py::arg("density"),
           py::arg("disturbances"))
      .def("hull_loads", of_made(&World::hull_loads), py::arg("xyz"), py::arg("triangles"),
           py::arg("t"), py::arg("about"), py::arg("density"), py::arg("disturbances"))
      .def("poses", of_made(&World::poses), py::arg("t"))
      .def("ray", of_made(&World::ray), py::arg("t"), py::arg("origin"), py::arg("direction"),
           py::arg("max_distance"))
      .def(
          "scan",
          [](const World& world, const BeamArray& beams, double t_s, PoseTuple pose,
             std::optional<PoseTuple> end, double duration_s, int moments,
             std::array<double, 2> ranges_m, double reach_m, double range_noise_m,
             std::uint64_t seed, std::vector<PoseTuple> poses,
             std::vector<DisturbanceTuple> disturbances) {
            return made(world).scan(
                beams, {t_s, pose, end, duration_s, moments, ranges_m, reach_m, range_noise_m, seed,
                        std::move(poses), std::move(disturbances)});
          },
          py::arg("beams"), py::arg("t"), py::arg("pose"), py::arg("end"), py::arg("duration_s"),
          py::arg("moments"), py::arg("ranges"), py::arg("reach"), py::arg("range_noise"),
          py::arg("seed"), py::arg("poses"), py::arg("disturbances"))
      .def(
          "render",
          [](const World& world, double t_s, int width_px, int height_px, std::string labels,
             std::string without, bool linear, std::optional<CameraTuple> camera,
             std::optional<CameraTuple> next_camera, double next_frame_s,
             std::vector<PoseTuple> poses, std::vector<PoseTuple> next_poses, int water_triangles,
             int terrain_triangles, double lookup_scale, int edge_samples,
             std::vector<DisturbanceTuple> disturbances, std::vector<std::array<double, 2>> picks) {
            return made(world).render({t_s, width_px, height_px, std::move(labels),
                                       std::move(without), linear, camera, next_camera,
                                       next_frame_s, std::move(poses), std::move(next_poses),
                                       water_triangles, terrain_triangles, lookup_scale,
                                       edge_samples, std::move(disturbances), std::move(picks)});
          },
          py::arg("t"), py::arg("width"), py::arg("height"), py::arg("labels"), py::arg("without"),
          py::arg("linear"), py::arg("camera"), py::arg("next_camera"), py::arg("next_frame_s"),
          py::arg("poses"), py::arg("next_poses"), py::arg("water_triangles"),
          py::arg("terrain_triangles"), py::arg("lookup_scale"), py::arg("edge_samples"),
          py::arg("disturbances"), py::arg("picks"))
      .def(
          "render_many",
          [](const World& world, double t_s, const std::vector<SizeTuple>& sizes,
             const std::vector<CameraTuple>& cameras, const std::string& labels,
             const std::string& without, bool linear, const std::vector<PoseTuple>& poses,
             int water_triangles, int terrain_triangles, double lookup_scale, int edge_samples,
             const std::vector<DisturbanceTuple>& disturbances) {
            std::vector<FrameArguments> frames;
            for (std::size_t k = 0; k < cameras.size(); ++k)
              frames.push_back({.t_s = t_s,
                                .width_px = sizes.at(k)[0],
                                .height_px = sizes.at(k)[1],
                                .labels = labels,
                                .without = without,
                                .linear = linear,
                                .camera = cameras[k],
                                .poses = poses,
                                .water_triangles = water_triangles,
                                .terrain_triangles = terrain_triangles,
                                .lookup_scale = lookup_scale,
                                .edge_samples = edge_samples,
                                .disturbances = disturbances});
            return made(world).render_many(frames);
          },
          py::arg("t"), py::arg("sizes"), py::arg("cameras"), py::arg("labels"), py::arg("without"),
          py::arg("linear"), py::arg("poses"), py::arg("water_triangles"),
          py::arg("terrain_triangles"), py::arg("lookup_scale"), py::arg("edge_samples"),
          py::arg("disturbances"));
}
