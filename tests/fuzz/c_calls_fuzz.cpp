// Sequences of calls of swell.h: bytes choose functions, handles that may be null, and values that
// may be extreme. Pointers are valid or null, texts end, and no struct claims more bytes than it
// has: what swell.h asks of callers. Worlds are small ones, made once.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "fuzz/bytes.h"
#include "fuzz/expect.h"
#include "swell.h"

namespace swell::fuzz {
namespace {

constexpr std::size_t kMostStructBytes = 4096;  // of those that the library looks at
constexpr std::size_t kHandles = 2;             // of a kind
constexpr int kMostCalls = 24, kMostPictures = 2;
constexpr std::int32_t kMostSide_px = 24;

constexpr std::array kScenes = {
    "wind.speed_mps = 7\n[camera]\neye_m = [0, 0, 3]\n",
    "wind.speed_mps = 3\n[camera]\neye_m = [0, -20, 6]\n"
    "[[object]]\nkind = \"buoy\"\nname = \"b\"\nposition_m = [2, 5]\n"
    "[[object]]\nkind = \"boat\"\npath_m = [[-20, 10], [20, 12]]\nspeed_mps = 3\n"
    "[[disturbance]]\nkind = \"drop\"\nposition_m = [0, 5]\nt_s = 1\n"};

// A struct with room behind it, and a size that its caller may give it.
template <class Struct>
class Sized {
 public:
  Struct* operator->() { return &parts_.value; }

  // Null now and then; the size is mostly right.
  Struct* pointer(Bytes& bytes) {
    const auto choice = bytes.take<std::uint8_t>();
    if (choice == 255) return nullptr;
    parts_.value.size = sizeof(Struct);
    if (choice == 254) parts_.value.size = bytes.take<std::uint64_t>();
    if (choice == 253) parts_.value.size = bytes.index(sizeof(Struct) + 1);
    if (choice == 252) parts_.value.size = sizeof(Struct) + bytes.index(256);
    if (choice == 251) parts_.behind[bytes.index(256)] = 1;
    return &parts_.value;
  }

 private:
  struct {
    Struct value{};
    std::array<unsigned char, kMostStructBytes> behind{};
  } parts_;
};

class Calls {
 public:
  explicit Calls(Bytes bytes) : bytes_(bytes) {}
  ~Calls() {
    for (swell_session* session : sessions_) swell_session_destroy(session);
    for (swell_picture* picture : pictures_) swell_picture_destroy(picture);
  }
  Calls(const Calls&) = delete;
  Calls& operator=(const Calls&) = delete;

  void make_all();

 private:
  // What is wrong is said, and it is the caller's values.
  swell_status checked(swell_status status) {
    expect(status == SWELL_OK || status == SWELL_BAD_ARGUMENT || status == SWELL_BAD_SCENE,
           "a call of one thread fails by its values alone");
    if (status != SWELL_OK) expect(*swell_last_error() != '\0', "a failure says why");
    return status;
  }
  bool taken(swell_status status) { return checked(status) == SWELL_OK; }

  const swell_world* world();
  swell_session* session() { return null_too(sessions_[bytes_.index(kHandles)]); }
  swell_picture* picture() { return null_too(pictures_[bytes_.index(kHandles)]); }
  template <class Pointer>
  Pointer null_too(Pointer pointer) {
    return bytes_.take<std::uint8_t>() > 250 ? nullptr : pointer;
  }
  std::int32_t count(std::int32_t most);
  double time_s() { return bytes_.coin() ? bytes_.number() : 1.0; }
  void fill(double* numbers, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) numbers[i] = bytes_.number();
  }
  std::string names(const char* (*name_of)(std::size_t));
  swell_camera camera();
  std::vector<swell_pose> poses();
  std::vector<swell_disturbance> disturbances();

  void make_world();
  void ask_world();
  void change_session();
  void change_picture();
  void draw();
  void look_at_picture();
  void pick();
  void look();
  void ask();
  void ask_below();
  void press_hull();
  void send_ray();
  void scan();
  void list_beams();
  void list_poses();
  void list_names();

  Bytes bytes_;
  int pictures_drawn_ = 0;
  std::array<swell_session*, kHandles> sessions_{};
  std::array<swell_picture*, kHandles> pictures_{};
  std::array<double, 6> path_m_ = {0.0, 0.0, 10.0, 0.0, 20.0, 5.0};
};

// Some time to make, none to use: kept for all inputs.
const std::array<swell_world*, kScenes.size()>& worlds() {
  static const auto made = [] {
    std::array<swell_world*, kScenes.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) {
      swell_scene scene{};
      scene.size = sizeof scene, scene.text = kScenes[i], scene.threads = 1;
      expect(swell_world_create(&scene, &all[i]) == SWELL_OK, "the target's own scene is one");
    }
    return all;
  }();
  return made;
}

const swell_world* Calls::world() { return null_too(worlds()[bytes_.index(kScenes.size())]); }

std::int32_t Calls::count(std::int32_t most) {
  const auto choice = bytes_.take<std::uint8_t>();
  if (choice < 240) return 1 + choice % most;
  return choice < 250 ? -choice : bytes_.take<std::int32_t>() | 0x100000;
}

// "all", some of those that there are, or what is no name.
std::string Calls::names(const char* (*name_of)(std::size_t)) {
  std::string text;
  const auto choice = bytes_.take<std::uint8_t>();
  if (choice == 255) return bytes_.text(200);
  if (choice > 200) return "all";
  for (std::size_t n = choice % 4; n > 0; --n) {
    const char* const name = name_of(bytes_.index(40));
    text += std::string(text.empty() ? "" : ",") + (name ? name : "");
  }
  return text;
}

swell_camera Calls::camera() {
  swell_camera camera{};
  camera.size = sizeof camera;
  if (bytes_.coin()) {
    std::array<double, 3> eye_m = {0.0, 0.0, 4.0};
    checked(swell_camera_look(eye_m.data(), bytes_.number(), bytes_.number(), 0.0, 50.0,
                              kMostSide_px, kMostSide_px, &camera));
  }
  if (bytes_.coin()) fill(camera.eye_m, 3);
  if (bytes_.coin()) fill(camera.quaternion_wxyz, 4);
  if (bytes_.coin()) fill(camera.focal_px, 2), fill(camera.principal_px, 2);
  if (bytes_.coin()) camera.near_m = bytes_.number();
  return camera;
}

std::vector<swell_pose> Calls::poses() {
  std::vector<swell_pose> poses(bytes_.index(4));
  for (swell_pose& pose : poses) {
    pose.size = sizeof pose;
    pose.object = bytes_.index(3);
    fill(pose.position_m, 3);
    pose.quaternion_wxyz[0] = 1.0;
    if (bytes_.coin()) fill(pose.quaternion_wxyz, 4);
  }
  return poses;
}

std::vector<swell_disturbance> Calls::disturbances() {
  std::vector<swell_disturbance> all(bytes_.index(3));
  for (swell_disturbance& one : all) {
    one.size = sizeof one;
    one.kind = static_cast<std::int32_t>(bytes_.index(6)) - 1;
    fill(one.position_m, 2);
    if (bytes_.coin()) one.t_s = bytes_.number();
    if (bytes_.coin()) one.duration_s = bytes_.number();
    if (bytes_.coin()) one.radius_m = bytes_.number();
    if (bytes_.coin()) one.height_m = bytes_.number();
    if (bytes_.coin()) fill(path_m_.data(), path_m_.size());
    if (bytes_.index(8) != 0) one.path_m = path_m_.data(), one.path_count = bytes_.index(4);
    if (bytes_.coin()) one.speed_mps = bytes_.number(), one.depth_m = bytes_.number();
    one.path_open = bytes_.coin();
    if (bytes_.coin()) fill(one.hull_m, 3);
  }
  return all;
}

// Texts that are hardly ever scenes.
void Calls::make_world() {
  const std::string text = bytes_.text(250), setting = bytes_.text(100);
  const std::array<const char*, 2> settings = {setting.c_str(), null_too(text.c_str())};
  Sized<swell_scene> scene;
  scene->text = null_too(text.c_str());
  scene->path = bytes_.index(16) == 0 ? text.c_str() : nullptr;
  scene->settings = null_too(settings.data());
  scene->setting_count = 1 + bytes_.index(2);
  if (bytes_.index(16) == 0 && !scene->settings) scene->setting_count = bytes_.take<std::size_t>();
  scene->threads = bytes_.coin() ? 1 : count(2);
  scene->most_bytes = bytes_.index(8) == 0 ? bytes_.take<std::uint32_t>() : 0;
  std::int32_t goes_on_for = bytes_.index(8) == 0 ? bytes_.take<std::uint8_t>() % 4 : 1 << 30;
  scene->user = &goes_on_for;
  if (bytes_.index(4) == 0)
    scene->progress = [](void* user, double) -> std::int32_t {
      return --*static_cast<std::int32_t*>(user) < 0;
    };
  swell_world* made = nullptr;
  const swell_status status = swell_world_create(scene.pointer(bytes_), null_too(&made));
  const bool is_wished = (status == SWELL_NO_MEMORY && scene->most_bytes != 0) ||
                         (status == SWELL_CANCELLED && goes_on_for < 0);
  if (!is_wished && taken(status)) expect(made != nullptr, "a world that was made is there");
  swell_world_destroy(made);
}

void Calls::ask_world() {
  const swell_world* const of = world();
  expect(swell_world_text(of) != nullptr, "a world has a text");
  std::uint64_t hash = 0;
  checked(swell_world_hash(of, null_too(&hash)));
  Sized<swell_object> info;
  checked(swell_object_info(of, bytes_.index(4), info.pointer(bytes_)));
  swell_class_name(of, bytes_.take<std::uint8_t>());
}

void Calls::change_session() {
  swell_session*& session = sessions_[bytes_.index(kHandles)];
  swell_session_destroy(session);
  session = nullptr;
  checked(swell_session_create(world(), count(2), null_too(&session)));
}

void Calls::change_picture() {
  swell_picture*& picture = pictures_[bytes_.index(kHandles)];
  swell_picture_destroy(picture);
  picture = nullptr;
  checked(swell_picture_create(null_too(&picture)));
}

void Calls::draw() {
  if (pictures_drawn_ == kMostPictures) return;
  const std::string labels = names(swell_label_name), without = names(swell_part_name);
  const swell_camera camera = this->camera(), next_camera = this->camera();
  const auto poses = this->poses(), next_poses = this->poses();
  const auto disturbances = this->disturbances();
  Sized<swell_frame> frame;
  frame->t_s = time_s();
  frame->width_px = count(kMostSide_px), frame->height_px = count(kMostSide_px);
  frame->camera = bytes_.coin() ? &camera : nullptr;
  frame->next_camera = bytes_.coin() ? &next_camera : nullptr;
  frame->labels = null_too(labels.c_str());
  frame->without = null_too(without.c_str());
  frame->linear = bytes_.coin();
  if (bytes_.coin()) frame->next_frame_s = bytes_.number();
  frame->poses = null_too(poses.data()), frame->pose_count = poses.size();
  frame->next_poses = next_poses.data(), frame->next_pose_count = next_poses.size();
  frame->disturbances = null_too(disturbances.data());
  frame->disturbance_count = disturbances.size();
  frame->water_triangles = count(200), frame->terrain_triangles = count(200);
  if (bytes_.coin()) frame->lookup_scale = bytes_.number();
  frame->edge_samples = static_cast<std::int32_t>(bytes_.index(10));
  swell_session* const session = this->session();
  if (taken(swell_render(session, frame.pointer(bytes_), picture()))) ++pictures_drawn_;
}

void Calls::look_at_picture() {
  swell_picture* const of = picture();
  std::string name = names(swell_label_name);
  if (bytes_.coin()) name = bytes_.coin() ? "rgba" : "linear";
  Sized<swell_plane> plane;
  if (taken(swell_picture_plane(of, null_too(name.c_str()), plane.pointer(bytes_))) &&
      plane->size == sizeof(swell_plane)) {
    std::vector<unsigned char> seen(plane->bytes), copied(plane->bytes);
    std::memcpy(seen.data(), plane->data, plane->bytes);
    if (taken(swell_picture_copy(of, name.c_str(), copied.data(), copied.size())))
      expect(seen == copied, "a plane is copied as it is");
  }
  std::array<unsigned char, 64> few{};
  checked(swell_picture_copy(of, name.c_str(), null_too(few.data()), few.size()));
  std::uint64_t hash = 0;
  checked(swell_picture_hash(of, null_too(&hash)));
  Sized<swell_camera> camera;
  checked(swell_picture_camera(of, camera.pointer(bytes_)));
}

void Calls::pick() {
  Sized<swell_pick> found;
  checked(swell_pick_at(session(), bytes_.number(), bytes_.number(), found.pointer(bytes_)));
}

void Calls::look() {
  std::array<double, 3> eye_m{};
  fill(eye_m.data(), 3);
  Sized<swell_camera> camera;
  checked(swell_camera_look(null_too(eye_m.data()), bytes_.number(), bytes_.number(),
                            bytes_.number(), bytes_.number(), count(8192), count(8192),
                            camera.pointer(bytes_)));
  checked(
      swell_scene_camera(session(), time_s(), count(8192), count(8192), camera.pointer(bytes_)));
}

void Calls::ask() {
  constexpr std::size_t kMostPoints = 12;
  const std::size_t points = bytes_.index(kMostPoints + 1);
  std::array<double, 2 * kMostPoints> xy_m{};
  fill(xy_m.data(), 2 * points);
  std::array<float, kMostPoints> height_m{}, foam{}, depth_m{};
  std::array<float, 2 * kMostPoints> slope{};
  std::array<float, 3 * kMostPoints> normal{}, velocity_mps{};
  const auto disturbances = this->disturbances();
  Sized<swell_query> query;
  query->t_s = time_s();
  query->count = points;
  query->xy_m = null_too(xy_m.data());
  if (!query->xy_m) query->count = bytes_.take<std::size_t>();
  query->height_m = null_too(height_m.data()), query->slope = null_too(slope.data());
  query->normal = null_too(normal.data()), query->foam = null_too(foam.data());
  query->velocity_mps = bytes_.coin() ? velocity_mps.data() : nullptr;
  query->still_depth_m = null_too(depth_m.data());
  query->disturbances = disturbances.data(), query->disturbance_count = disturbances.size();
  if (!taken(swell_ask(session(), query.pointer(bytes_)))) return;
  for (std::size_t i = 0; i < points; ++i) {
    expect(std::isfinite(height_m[i]) && std::isfinite(slope[2 * i]) &&
               std::isfinite(slope[2 * i + 1]),
           "water has a height and a slope");
    expect(foam[i] >= 0.0f && foam[i] <= 1.0f, "foam hides a part");
    for (std::size_t k = 0; k < 3; ++k)
      expect(std::isfinite(normal[3 * i + k]) && std::isfinite(velocity_mps[3 * i + k]),
             "water has a normal and a velocity");
  }
}

void Calls::ask_below() {
  constexpr std::size_t kMostPoints = 12;
  const std::size_t points = bytes_.index(kMostPoints + 1);
  std::array<double, 3 * kMostPoints> xyz_m{};
  fill(xyz_m.data(), 3 * points);
  std::array<float, 3 * kMostPoints> velocity_mps{}, acceleration_mps2{};
  std::array<float, kMostPoints> pressure_pa{};
  std::array<std::uint8_t, kMostPoints> place{};
  const auto disturbances = this->disturbances();
  Sized<swell_below> below;
  below->t_s = time_s();
  below->count = points;
  below->xyz_m = null_too(xyz_m.data());
  if (!below->xyz_m) below->count = bytes_.take<std::size_t>();
  if (bytes_.coin()) below->density_kg_m3 = bytes_.number();
  below->velocity_mps = bytes_.coin() ? velocity_mps.data() : nullptr;
  below->acceleration_mps2 = bytes_.coin() ? acceleration_mps2.data() : nullptr;
  below->pressure_pa = null_too(pressure_pa.data()), below->place = null_too(place.data());
  below->disturbances = disturbances.data(), below->disturbance_count = disturbances.size();
  if (!taken(swell_ask_below(session(), below.pointer(bytes_)))) return;
  for (std::size_t i = 0; i < points; ++i) {
    expect(std::isfinite(pressure_pa[i]) && place[i] <= SWELL_IN_GROUND, "water has a pressure");
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      expect(std::isfinite(velocity_mps[k]) && std::isfinite(acceleration_mps2[k]), "water moves");
  }
}

void Calls::press_hull() {
  constexpr std::size_t kPoints = 4;
  std::array<double, 3 * kPoints> xyz_m = {0, 0, -1, 3, 0, -1, 0, 3, -1, 0, 0, 2};
  std::array<std::uint32_t, 12> triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  if (bytes_.coin()) fill(xyz_m.data() + 3 * bytes_.index(kPoints), 3);
  if (bytes_.coin()) triangles[bytes_.index(12)] = bytes_.take<std::uint32_t>();
  const auto disturbances = this->disturbances();
  Sized<swell_hull> hull;
  hull->t_s = time_s();
  hull->xyz_m = null_too(xyz_m.data()), hull->point_count = bytes_.index(kPoints + 1);
  hull->triangles = null_too(triangles.data()), hull->triangle_count = bytes_.index(5);
  if (bytes_.coin()) fill(hull->about_m, 3);
  if (bytes_.coin()) hull->density_kg_m3 = bytes_.number();
  hull->disturbances = disturbances.data(), hull->disturbance_count = disturbances.size();
  Sized<swell_loads> loads;
  checked(swell_hull_loads(session(), hull.pointer(bytes_), loads.pointer(bytes_)));
}

void Calls::send_ray() {
  std::array<double, 3> origin_m{}, direction{0.0, 0.5, -1.0};
  fill(origin_m.data(), 3);
  if (bytes_.coin()) fill(direction.data(), 3);
  Sized<swell_hit> hit;
  checked(swell_ray(session(), time_s(), null_too(origin_m.data()), null_too(direction.data()),
                    bytes_.number(), hit.pointer(bytes_)));
}

void Calls::scan() {
  constexpr std::size_t kMostBeams = 12;
  const std::size_t beams = bytes_.index(kMostBeams + 1);
  std::array<double, 3 * kMostBeams> beam_list{};
  fill(beam_list.data(), 3 * beams);
  std::array<float, kMostBeams> range_m{}, intensity{}, incidence_deg{};
  std::array<float, 3 * kMostBeams> point_m{};
  std::array<std::uint32_t, kMostBeams> id{}, klass{};
  const auto poses = this->poses();
  const auto disturbances = this->disturbances();
  Sized<swell_lidar> lidar;
  lidar->t_s = time_s();
  lidar->position_m[2] = 4.0, lidar->quaternion_wxyz[0] = 1.0;
  lidar->end_quaternion_wxyz[1] = 1.0;
  if (bytes_.coin()) fill(lidar->position_m, 3);
  if (bytes_.coin()) fill(lidar->quaternion_wxyz, 4);
  lidar->beams = null_too(beam_list.data()), lidar->count = beams;
  if (!lidar->beams) lidar->count = bytes_.take<std::size_t>();
  if (bytes_.coin()) lidar->duration_s = bytes_.number();
  if (bytes_.coin()) fill(lidar->end_position_m, 3), fill(lidar->end_quaternion_wxyz, 4);
  lidar->moments = static_cast<std::int32_t>(bytes_.index(4)) - 1;
  if (bytes_.coin()) lidar->least_m = bytes_.number(), lidar->most_m = bytes_.number();
  if (bytes_.coin()) lidar->reach_m = bytes_.number(), lidar->range_noise_m = bytes_.number();
  lidar->seed = bytes_.take<std::uint64_t>();
  lidar->poses = null_too(poses.data()), lidar->pose_count = poses.size();
  lidar->disturbances = disturbances.data(), lidar->disturbance_count = disturbances.size();
  lidar->range_m = null_too(range_m.data()), lidar->intensity = null_too(intensity.data());
  lidar->incidence_deg = null_too(incidence_deg.data()), lidar->point_m = null_too(point_m.data());
  lidar->id = null_too(id.data()), lidar->klass = null_too(klass.data());
  if (!taken(swell_scan(session(), lidar.pointer(bytes_)))) return;
  for (std::size_t i = 0; i < beams; ++i) {
    expect(range_m[i] >= 0.0f, "a range is a length, or infinite");
    expect(intensity[i] >= 0.0f && intensity[i] <= 1.0f, "an intensity is a part");
    expect(incidence_deg[i] >= 0.0f && incidence_deg[i] <= 90.01f, "surfaces face the beam");
  }
}

void Calls::list_beams() {
  std::array<double, 3 * 64> beams{};
  const std::string model = names(swell_lidar_name);
  swell_lidar_beams(null_too(model.c_str()));
  checked(swell_spinning_beams(null_too(model.c_str()), count(4), bytes_.number(), bytes_.number(),
                               null_too(beams.data()), bytes_.index(65)));
  checked(swell_grid_beams(count(9), count(9), bytes_.number(), bytes_.number(), bytes_.number(),
                           null_too(beams.data()), bytes_.index(65)));
}

void Calls::list_poses() {
  std::array<swell_pose, 4> poses{};
  for (swell_pose& pose : poses) pose.size = sizeof pose;
  checked(swell_object_poses(session(), time_s(), null_too(poses.data()), bytes_.index(5)));
}

void Calls::list_names() {
  Sized<swell_key> key;
  checked(swell_key_info(bytes_.take<std::uint16_t>(), key.pointer(bytes_)));
  swell_label_name(bytes_.take<std::uint8_t>());
  swell_part_name(bytes_.take<std::uint8_t>());
}

void Calls::make_all() {
  constexpr std::array kCalls = {
      &Calls::make_world,     &Calls::ask_world,  &Calls::change_session,
      &Calls::change_picture, &Calls::draw,       &Calls::pick,
      &Calls::look,           &Calls::ask,        &Calls::look_at_picture,
      &Calls::send_ray,       &Calls::list_poses, &Calls::list_names,
      &Calls::ask_below,      &Calls::press_hull, &Calls::scan,
      &Calls::list_beams};
  checked(swell_session_create(worlds()[bytes_.index(kScenes.size())], 1, &sessions_[0]));
  checked(swell_picture_create(&pictures_[0]));
  for (int n = 0; n < kMostCalls && !bytes_.empty(); ++n)
    (this->*kCalls[bytes_.index(kCalls.size())])();
}

}  // namespace
}  // namespace swell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swell::fuzz::Calls(swell::fuzz::Bytes({data, size})).make_all();
  return 0;
}
