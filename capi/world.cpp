// Worlds, and what they know of their scenes.
#define XXH_INLINE_ALL
#include <fmt/core.h>
#include <xxhash.h>

#include "capi/call.h"
#include "capi/handles.h"
#include "capi/make_told.h"
#include "math/simd_target.h"
#include "math/stop.h"
#include "render/labels/classes.h"
#include "scene/settings.h"

namespace swell::capi {
namespace {

constexpr int kMostThreads = 256;
constexpr std::size_t kMostSettings = 100'000;

std::vector<std::string> settings_of(const swell_scene& given) {
  if (given.setting_count > kMostSettings)
    refuse("scene.setting_count, got {}, allowed 0 to {}", given.setting_count, kMostSettings);
  if (given.setting_count > 0) check_not_null(given.settings, "scene.settings");
  std::vector<std::string> settings;
  for (std::size_t i = 0; i < given.setting_count; ++i) {
    check_not_null(given.settings[i], "scene.settings[]");
    settings.emplace_back(given.settings[i]);
  }
  return settings;
}

scene::Scene scene_of(const swell_scene& given) {
  const std::vector<std::string> settings = settings_of(given);
  check_stop();
  if (given.path) {
    if (given.text) refuse("scene, got path and text, allowed one of them");
    return scene::load_scene(given.path, settings);
  }
  check_not_null(given.text, "scene.path and scene.text");
  const std::filesystem::path folder = given.folder ? given.folder : "";
  return scene::parse_scene(given.text, folder / "scene", settings);
}

void check_cpu() {
  if (!cpu_is_supported())
    throw std::runtime_error(
        fmt::format("this CPU cannot run swell: it needs {}", cpu_requirement()));
}

int thread_count(const char* name, int32_t given) {
  if (given == 0) return available_cpus();
  check_range(name, given, 1, kMostThreads);
  return given;
}

const NamedWorld& named(const swell_world* world) {
  check_not_null(world, "world");
  return *world->named;
}

}  // namespace

NamedWorld::NamedWorld(scene::Scene scene, const render::WorldMaking& making)
    : world(std::move(scene), making),
      text(scene::dump_scene(world.scene())),
      class_names(render::class_names(world.scene())),
      object_classes(render::object_classes(world.scene())) {}

}  // namespace swell::capi

using namespace swell;
using namespace swell::capi;

swell_status swell_world_create(const swell_scene* scene, swell_world** world) {
  return guarded([&] {
    check_not_null(world, "world");
    const swell_scene given = taken(scene, "scene");
    check_cpu();
    const int threads = thread_count("scene.threads", given.threads);
    const auto make = [&](render::WorldMaking making) {
      making.threads = threads;
      making.most_bytes = given.most_bytes;
      if (given.cache_folder) making.cache_folder = given.cache_folder;
      return std::make_shared<const NamedWorld>(scene_of(given), making);
    };
    *world = new swell_world{make_told(given, make)};
  });
}

swell_status swell_world_load(const char* path, swell_world** world) {
  swell_scene scene{};
  scene.size = sizeof(scene);
  scene.path = path;
  return swell_world_create(&scene, world);
}

void swell_world_destroy(swell_world* world) { delete world; }

const char* swell_world_text(const swell_world* world) {
  return world ? world->named->text.c_str() : "";
}

swell_status swell_world_hash(const swell_world* world, uint64_t* hash) {
  return guarded([&] {
    const std::string& text = named(world).text;
    check_not_null(hash, "hash");
    *hash = XXH3_64bits(text.data(), text.size());
  });
}

size_t swell_object_count(const swell_world* world) {
  return world ? world->named->world.scene().objects.size() : 0;
}

swell_status swell_object_info(const swell_world* world, size_t object, swell_object* info) {
  return guarded([&] {
    const NamedWorld& of = named(world);
    const auto& objects = of.world.scene().objects;
    if (object >= objects.size())
      refuse("object, got {}, allowed below {}", object, objects.size());
    swell_object found{};
    found.id = render::kFirstObjectId + static_cast<std::uint32_t>(object);
    found.klass = of.object_classes[object];
    found.name = objects[object].name.c_str();
    found.class_name = of.class_names[found.klass].c_str();
    found.kind = scene::kObjectKindNames[objects[object].kind].data();
    give(found, info, "info");
  });
}

const char* swell_class_name(const swell_world* world, uint32_t klass) {
  if (!world || klass >= world->named->class_names.size()) return nullptr;
  return world->named->class_names[klass].c_str();
}

swell_status swell_session_create(const swell_world* world, int32_t threads,
                                  swell_session** session) {
  return guarded([&] {
    named(world);
    check_not_null(session, "session");
    *session = new swell_session(world->named, thread_count("threads", threads));
  });
}

void swell_session_destroy(swell_session* session) { delete session; }
