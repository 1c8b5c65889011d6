// Pictures: drawing them, and their planes.
#include <algorithm>
#include <deque>
#include <span>
#include <type_traits>
#include <variant>

#include "capi/call.h"
#include "capi/camera.h"
#include "capi/disturbances.h"
#include "capi/handles.h"
#include "render/labels/label_channels.h"
#include "render/labels/labels.h"
#include "render/world_view.h"

namespace swell::capi {
namespace {

using render::Label;

render::LabelSet label_set(const char* names) {
  if (!names || *names == '\0') return {};
  if (std::string_view(names) == "all") return render::LabelSet::all();
  render::LabelSet set;
  std::string_view rest = names;
  for (;;) {
    const std::string_view name = rest.substr(0, rest.find(','));
    const render::LabelInfo* info = render::find_label(name);
    if (!info) {
      std::string known;
      for (const render::LabelInfo& row : render::label_table())
        known += fmt::format("{}, ", row.name);
      refuse("frame.labels, got '{}', allowed {}all", name.substr(0, 100), known);
    }
    set.add(info->label);
    if (name.size() == rest.size()) return set;
    rest.remove_prefix(name.size() + 1);
  }
}

render::PartSet part_set(const char* names) {
  if (!names || *names == '\0') return {};
  const auto parts = render::parse_parts(names);
  if (parts) return *parts;
  std::string known;
  for (const std::string_view name : render::kPartNames) known += fmt::format(" {}", name);
  refuse("frame.without, got '{}', allowed with commas{}", std::string_view(names).substr(0, 100),
         known);
}

int triangle_count(const char* name, int32_t given) {
  if (given != 0) check_range(name, given, 2, render::kMostTriangles);
  return given;
}

double next_frame_s(const swell_frame& given) {
  if (given.next_frame_s == 0.0) return 1.0 / 60.0;
  check_range("frame.next_frame_s", given.next_frame_s, 1e-9, 1e9);
  return given.next_frame_s;
}

render::FrameOptions options_of(const swell_frame& given) {
  render::FrameOptions options;
  options.labels = label_set(given.labels);
  options.keep_linear = given.linear != 0;
  options.next_frame_s = next_frame_s(given);
  options.without = part_set(given.without);
  options.water_triangles = triangle_count("frame.water_triangles", given.water_triangles);
  options.terrain_triangles = triangle_count("frame.terrain_triangles", given.terrain_triangles);
  if (given.lookup_scale != 0.0) check_range("frame.lookup_scale", given.lookup_scale, 0.01, 1.0);
  options.lookup_scale = given.lookup_scale;
  const int32_t samples = given.edge_samples;
  if (samples != 0 && samples != 1 && samples != 4 && samples != 8)
    refuse("frame.edge_samples, got {}, allowed 0, 1, 4 or 8", samples);
  options.edge_samples = samples == 0 ? -1 : samples == 1 ? 0 : samples;
  return options;
}

// A frame as the library has it. The options point into the lists: not to be copied.
struct Asked {
  Asked(const swell_frame& frame, const render::World& world) : given(frame) {
    check_time(given.t_s);
    const PictureSize size = checked_size(given.width_px, given.height_px);
    size_px = {size.width_px, size.height_px};
    options = options_of(given);
    const std::size_t objects = world.scene().objects.size();
    poses = given_poses(given.poses, given.pose_count, objects, "frame.poses");
    next_poses = given_poses(given.next_poses, given.next_pose_count, objects, "frame.next_poses");
    disturbances = given_disturbances(given.disturbances, given.disturbance_count);
    options.poses = poses;
    options.next_poses = next_poses;
    options.disturbances = disturbances;
  }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

  const swell_frame& given;
  glm::ivec2 size_px;
  render::FrameOptions options;
  std::vector<scene::GivenPose> poses, next_poses;
  std::vector<ocean::Disturbance> disturbances;
};

View given_view(const swell_camera* camera, const char* name, glm::ivec2 size_px) {
  return view_of(camera, name, {size_px.x, size_px.y});
}

// The camera of the frame: the caller's, or the scene's, which goes with the object that it is
// mounted on.
View frame_view(const Asked& asked, swell_session& session) {
  if (asked.given.camera) return given_view(asked.given.camera, "camera", asked.size_px);
  return render::world_view(session.named->world, asked.given.t_s, asked.options, asked.size_px,
                            session.camera_sea, session.workers);
}

// The scene's camera in the moments of the frame; none: it stands still.
std::vector<View> exposed_views(const Asked& asked, swell_session& session) {
  if (asked.given.camera) return {};
  return render::exposed_views(session.named->world, asked.given.t_s, asked.options, asked.size_px,
                               session.camera_sea, session.workers);
}

// The camera of the next frame, where a label needs one; none: as this frame's.
std::optional<View> next_view(const Asked& asked, swell_session& session) {
  const swell_frame& given = asked.given;
  if (given.next_camera) return given_view(given.next_camera, "next_camera", asked.size_px);
  if (given.camera || !asked.options.labels.has(Label::kMotion)) return std::nullopt;
  return render::next_world_view(session.named->world, given.t_s, asked.options, asked.size_px,
                                 session.camera_sea, session.workers);
}

// Forgets what was drawn before.
void clear(swell_picture& picture) {
  picture.view.reset();
  for (auto& values : picture.lengths) values.clear();
  for (auto& values : picture.places) values.clear();
}

void draw(swell_session& session, const swell_frame& given, swell_picture& picture) {
  const render::World& world = session.named->world;
  Asked asked(given, world);
  const View view = frame_view(asked, session);
  asked.options.next_view = next_view(asked, session);
  const std::vector<View> exposed = exposed_views(asked, session);
  asked.options.exposed_views = exposed;
  clear(picture);
  session.drawn_view.reset();
  render::render_frame(world, view, given.t_s, asked.options, session.workspace, picture.target,
                       session.workers);
  session.drawn_view = picture.view = view;
}

void check_same_sea(const Asked& frame, const Asked& first) {
  if (frame.given.t_s != first.given.t_s)
    refuse("frame.t_s, got {}, allowed that of the others, {}", frame.given.t_s, first.given.t_s);
  if (frame.options.without != first.options.without)
    refuse("frame.without, got {}, allowed that of the others",
           frame.given.without ? frame.given.without : "null");
  if (frame.given.disturbances != first.given.disturbances ||
      frame.given.disturbance_count != first.given.disturbance_count)
    refuse("frame.disturbances, got another list, allowed that of the others");
}

void draw_many(swell_session& session, std::span<const swell_frame* const> frames,
               std::span<swell_picture* const> pictures) {
  const render::World& world = session.named->world;
  std::deque<swell_frame> given;
  std::deque<Asked> asked;
  std::deque<Held<swell_picture>> held;
  std::deque<std::vector<View>> exposed;
  std::vector<render::FrameRequest> requests;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    held.emplace_back(pictures[k], "picture");
    Asked& frame = asked.emplace_back(given.emplace_back(taken(frames[k], "frame")), world);
    check_same_sea(frame, asked.front());
    frame.options.disturbances = asked.front().disturbances;
    frame.options.next_view = next_view(frame, session);
    frame.options.exposed_views = exposed.emplace_back(exposed_views(frame, session));
    requests.push_back({frame_view(frame, session), frame.options, &pictures[k]->target});
  }
  for (swell_picture* const picture : pictures) clear(*picture);
  render::render_many(world, requests, given.front().t_s, session.workspaces, session.workers);
  for (std::size_t k = 0; k < frames.size(); ++k) pictures[k]->view = requests[k].view;
}

// ---- Planes

template <class Element>
constexpr swell_type type_of() {
  if constexpr (std::is_same_v<Element, float>) return SWELL_FLOAT32;
  if constexpr (std::is_same_v<Element, double>) return SWELL_FLOAT64;
  if constexpr (std::is_same_v<Element, std::uint8_t>) return SWELL_UINT8;
  return SWELL_UINT32;
}

template <class Element, class Stored>
swell_plane plane_of(const std::vector<Stored>& values, const View& view) {
  return {sizeof(swell_plane),
          values.data(),
          values.size() * sizeof(Stored),
          type_of<Element>(),
          view.width_px,
          view.height_px,
          static_cast<int32_t>(values.size() * sizeof(Stored) / sizeof(Element) /
                               (static_cast<std::size_t>(view.width_px) * view.height_px))};
}

// What a plane holds side by side of a label's values.
template <class Number>
Number element_of(Number);
template <glm::length_t kSize, class Number>
Number element_of(glm::vec<kSize, Number>);

// The plane of values that follow from the depth, which are filled if they are not there yet.
template <class Stored, class Value>
swell_plane plane_from_depth(const swell_picture& picture,
                             Value (*of_depth)(const View&, int, int, float),
                             std::vector<Stored>& values) {
  const std::vector<float>& depth_m = picture.target.labels.depth_m;
  if (values.size() != depth_m.size()) {
    const std::vector<Value> found = render::from_depth(*picture.view, depth_m, of_depth);
    values.assign(found.begin(), found.end());
  }
  return plane_of<decltype(element_of(Stored()))>(values, *picture.view);
}

swell_plane label_plane(swell_picture& picture, const render::LabelInfo& info) {
  const auto label = static_cast<std::size_t>(info.label);
  return std::visit(
      [&]<class Values>(const Values values) {
        if constexpr (std::is_member_pointer_v<Values>) {
          const auto& stored = picture.target.labels.*values;
          return plane_of<decltype(element_of(stored[0]))>(stored, *picture.view);
        } else if constexpr (std::is_same_v<Values, double (*)(const View&, int, int, float)>) {
          return plane_from_depth(picture, values, picture.lengths[label]);
        } else {
          return plane_from_depth(picture, values, picture.places[label]);
        }
      },
      info.values);
}

const View& drawn_view(const swell_picture& picture) {
  if (!picture.view)
    refuse("picture, got one that nothing was drawn into, allowed one of swell_render");
  return *picture.view;
}

swell_plane find_plane(swell_picture& picture, const char* name) {
  check_not_null(name, "name");
  const View& view = drawn_view(picture);
  const render::Target& target = picture.target;
  if (std::string_view(name) == "rgba") return plane_of<std::uint8_t>(target.rgba, view);
  if (std::string_view(name) == "linear" && !target.linear.empty())
    return plane_of<float>(target.linear, view);
  const render::LabelInfo* info = render::find_label(name);
  if (info && target.labels.set.has(info->label)) return label_plane(picture, *info);
  refuse("plane, got '{}', allowed rgba, linear and labels that the frame was asked for",
         std::string_view(name).substr(0, 100));
}

}  // namespace
}  // namespace swell::capi

using namespace swell;
using namespace swell::capi;

swell_status swell_picture_create(swell_picture** picture) {
  return guarded([&] {
    check_not_null(picture, "picture");
    *picture = new swell_picture;
  });
}

void swell_picture_destroy(swell_picture* picture) { delete picture; }

swell_status swell_render(swell_session* session, const swell_frame* frame,
                          swell_picture* picture) {
  return guarded([&] {
    const Held held(session, "session");
    const Held into(picture, "picture");
    draw(*held, taken(frame, "frame"), *into);
  });
}

swell_status swell_render_many(swell_session* session, const swell_frame* const* frames,
                               swell_picture* const* pictures, size_t count) {
  return guarded([&] {
    const Held held(session, "session");
    if (count == 0) return;
    check_not_null(frames, "frames");
    check_not_null(pictures, "pictures");
    if (count > 65536) refuse("count, got {}, allowed [0, 65536]", count);
    draw_many(*held, {frames, count}, {pictures, count});
  });
}

swell_status swell_frame_camera(swell_session* session, const swell_frame* frame,
                                swell_camera* camera) {
  return guarded([&] {
    const Held held(session, "session");
    const swell_frame given = taken(frame, "frame");
    give(camera_of(frame_view(Asked(given, held->named->world), *held)), camera, "camera");
  });
}

swell_status swell_picture_plane(swell_picture* picture, const char* name, swell_plane* plane) {
  return guarded([&] {
    const Held held(picture, "picture");
    give(find_plane(*held, name), plane, "plane");
  });
}

swell_status swell_picture_copy(swell_picture* picture, const char* name, void* buffer,
                                size_t bytes) {
  return guarded([&] {
    const Held held(picture, "picture");
    check_not_null(buffer, "buffer");
    const swell_plane plane = find_plane(*held, name);
    if (bytes != plane.bytes)
      refuse("bytes, got {}, allowed {}: {} x {} pixels of {}", bytes, plane.bytes, plane.width_px,
             plane.height_px, name);
    std::memcpy(buffer, plane.data, bytes);
  });
}

swell_status swell_picture_hash(const swell_picture* picture, uint64_t* hash) {
  return guarded([&] {
    const Held held(const_cast<swell_picture*>(picture), "picture");
    check_not_null(hash, "hash");
    drawn_view(*held);
    *hash = render::picture_hash(held->target);
  });
}

swell_status swell_picture_camera(const swell_picture* picture, swell_camera* camera) {
  return guarded([&] {
    const Held held(const_cast<swell_picture*>(picture), "picture");
    give(camera_of(drawn_view(*held)), camera, "camera");
  });
}

swell_status swell_pick_at(swell_session* session, double x_px, double y_px, swell_pick* pick) {
  return guarded([&] {
    const Held held(session, "session");
    if (!held->drawn_view) refuse("session, got one that has drawn no frame, allowed one that has");
    if (held->drawn_view->projection.is_wide())
      refuse("session, got one whose last frame is wide, allowed a perspective one");
    check_range("x_px", x_px, 0.0, held->drawn_view->width_px);
    check_range("y_px", y_px, 0.0, held->drawn_view->height_px);
    const auto met = render::pick(held->named->world, *held->drawn_view, held->workspace,
                                  glm::vec2(x_px, y_px), held->pick_scratch);
    swell_pick found{};
    if (met) {
      const bool is_object = met->what == render::Shown::kObject;
      found.what = met->what == render::Shown::kWater  ? SWELL_SHOWS_WATER
                   : met->what == render::Shown::kLand ? SWELL_SHOWS_LAND
                                                       : SWELL_SHOWS_OBJECT;
      for (int i = 0; i < 3; ++i) found.position_m[i] = met->p_world[i];
      found.distance_m = met->distance_m;
      found.object = is_object ? met->object : 0;
      found.id = is_object ? render::kFirstObjectId + static_cast<std::uint32_t>(met->object)
                 : met->what == render::Shown::kLand ? render::kLandId
                                                     : render::kWaterId;
      found.height_m = met->model_height_m;
    }
    give(found, pick, "pick");
  });
}

const char* swell_label_name(size_t label) {
  const auto table = render::label_table();
  return label < table.size() ? table[label].name.data() : nullptr;
}

const char* swell_part_name(size_t part) {
  return part < render::kPartNames.size() ? render::kPartNames[part].data() : nullptr;
}
