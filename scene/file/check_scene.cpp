#include "scene/check_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/projection.h"
#include "ocean/inland/drift.h"
#include "ocean/open_sea/map_waves.h"
#include "scene/coast.h"
#include "scene/file/key_places.h"
#include "scene/file/parameters.h"
#include "scene/obstacles.h"
#include "sky/celestial.h"
#include "sky/sky_light.h"
#include "terrain/sea_floor.h"

namespace swell::scene {
namespace {

using Fault = std::optional<SceneFault>;

constexpr double kShortestStretch_m = 0.5;  // of an object's path

// ---- One value

// `element`: the name of the n-th number.
template <class Object, class Name>
Fault fault_of_numbers(const Parameter<Object>& parameter, const std::vector<double>& numbers,
                       const Name& element) {
  for (std::size_t n = 0; n < numbers.size(); ++n)
    if (!allows(parameter, numbers[n]))
      return SceneFault{element(n), fmt::format("{}", numbers[n]), allowed_text(parameter)};
  return std::nullopt;
}

template <class Object>
Fault fault_of(const Parameter<Object>& parameter, const Object& object, const std::string& key) {
  if (parameter.is_set && !parameter.is_set(object)) return std::nullopt;
  const ParameterValue value = parameter.get(object);
  const auto fault = [&](const std::string& got) {
    return SceneFault{key, got, allowed_text(parameter)};
  };
  const auto fault_of_count = [&](std::size_t count, std::string_view what) -> Fault {
    if (allows_count(parameter, count)) return std::nullopt;
    return fault(fmt::format("{} {}", count, what));
  };
  switch (parameter.kind) {
    case ParameterKind::kNumber:
      return fault_of_numbers(parameter, std::get<std::vector<double>>(value),
                              [&](std::size_t) { return key; });
    case ParameterKind::kNumbers: {
      const auto& numbers = std::get<std::vector<double>>(value);
      if (Fault wrong = fault_of_count(numbers.size(), "numbers")) return wrong;
      return fault_of_numbers(parameter, numbers,
                              [&](std::size_t n) { return fmt::format("{}[{}]", key, n); });
    }
    case ParameterKind::kPoints: {
      const auto& numbers = std::get<std::vector<double>>(value);
      if (Fault wrong = fault_of_count(numbers.size() / 2, "points")) return wrong;
      return fault_of_numbers(parameter, numbers,
                              [&](std::size_t n) { return fmt::format("{}[{}]", key, n / 2); });
    }
    case ParameterKind::kInteger:
    case ParameterKind::kPowerOfTwo: {
      const auto number = std::get<std::int64_t>(value);
      if (allows(parameter, number)) return std::nullopt;
      return fault(fmt::format("{}", number));
    }
    case ParameterKind::kChoice:
    case ParameterKind::kText: {
      const auto& text = std::get<std::string>(value);
      if (allows(parameter, text)) return std::nullopt;
      return fault(fmt::format("\"{}\"", text.substr(0, kMaxTextBytes)));
    }
    case ParameterKind::kBoolean:
    case ParameterKind::kPath:  // reading the file will tell
      break;
  }
  return std::nullopt;
}

// ---- All values

Fault fault_of_keys(const Scene& scene) {
  for (const auto& parameter : scene_parameters()) {
    if (parameter.key.starts_with("terrain.") && !scene.terrain) continue;
    if (Fault fault = fault_of(parameter, scene, std::string(parameter.key))) return fault;
  }
  return std::nullopt;
}

template <class Object>
Fault fault_of_tables(std::string_view key, const std::vector<Object>& objects, std::size_t most,
                      const std::vector<Parameter<Object>>& parameters) {
  if (objects.size() > most)
    return SceneFault{std::string(key), fmt::format("{} tables", objects.size()),
                      fmt::format("at most {} tables [[{}]]", most, key)};
  for (std::size_t n = 0; n < objects.size(); ++n)
    for (const auto& parameter : parameters) {
      const std::string path = fmt::format("{}[{}].{}", key, n, parameter.key);
      if (Fault fault = fault_of(parameter, objects[n], path)) return fault;
    }
  return std::nullopt;
}

// ---- Values that have to agree

Fault fault_of_sky(const Sky& sky) {
  const glm::vec3 direction = sky::sun_direction(sky.sun_azimuth_rad, sky.sun_elevation_rad);
  if (!(glm::distance(sky.sun_direction, direction) < 1e-3f))
    return SceneFault{
        "sky.sun_direction",
        fmt::format("[{}, {}, {}]", sky.sun_direction.x, sky.sun_direction.y, sky.sun_direction.z),
        fmt::format("the direction of the azimuth and the elevation, [{}, {}, {}]", direction.x,
                    direction.y, direction.z)};
  if (!sky.time_utc.empty() && !sky::parse_time_utc(sky.time_utc))
    return SceneFault{"sky.time_utc", fmt::format("\"{}\"", sky.time_utc),
                      "a time as \"2026-06-21T12:00:00Z\", from 1900 to 2100"};
  const sky::GradientSky gradient = sky::gradient_of(sky);
  for (int c = 0; c < 3; ++c)
    if (sky::kBeyondHorizon * gradient.zenith[c] >
        (1.0f + sky::kBeyondHorizon) * gradient.horizon[c])
      return SceneFault{
          fmt::format("sky.zenith[{}]", c), fmt::format("{}", gradient.zenith[c]),
          fmt::format("at most 7.66 times sky.horizon[{}], which is {}", c, gradient.horizon[c])};
  return std::nullopt;
}

// Half the way across a placed cloud from its middle, with its lobes.
double reach_of(const Cumulus& cloud) { return 0.75 * cloud.width_m; }

Fault fault_of_clouds(const CloudField& clouds) {
  if (clouds.kind == CloudKind::kNone) return std::nullopt;
  const double thickness_m = clouds.top_m - clouds.base_m;
  if (clouds.kind == CloudKind::kLayer && !(thickness_m >= 100.0 && thickness_m <= 8000.0))
    return SceneFault{"clouds.top_m", fmt::format("{}", clouds.top_m),
                      "100 to 8000 m over clouds.base_m"};
  if (clouds.kind != CloudKind::kPlaced) return std::nullopt;
  if (clouds.cumulus.empty())
    return SceneFault{"clouds.kind", fmt::format("\"placed\" without [[{}]]", kCumulusKey),
                      "at least one of these tables beside it"};
  glm::dvec2 low(1e9), high(-1e9);
  for (const Cumulus& cloud : clouds.cumulus) {
    low = glm::min(low, cloud.position_m - reach_of(cloud));
    high = glm::max(high, cloud.position_m + reach_of(cloud));
  }
  const double side_m = std::max(high.x - low.x, high.y - low.y);
  if (side_m <= kMostCloudSquare_m) return std::nullopt;
  return SceneFault{std::string(kCumulusKey), fmt::format("clouds over {:.0f} m", side_m),
                    fmt::format("clouds in a square of {:.0f} m", kMostCloudSquare_m)};
}

Fault fault_of_sea(const Scene& scene) {
  const auto& lengths = scene.sea.patch_lengths_m;
  if (std::ranges::adjacent_find(lengths, std::less_equal{}) != lengths.end())
    return SceneFault{"sea.patch_lengths_m", fmt::format("[{}]", fmt::join(lengths, ", ")),
                      "lengths that go down"};
  if (scene.douglas && scene.beaufort)
    return SceneFault{"sea.beaufort", "it besides sea.douglas", "one of them"};
  const bool has_waves = scene.sea.hs_m || scene.sea.tp_s;
  if (scene.douglas && (has_waves || scene.sea.fetch_km))
    return SceneFault{"sea.douglas", "it besides hs_m, tp_s or fetch_km", "one of them"};
  if (has_waves && scene.sea.fetch_km)
    return SceneFault{"sea.fetch_km", "it besides sea.hs_m or sea.tp_s", "one of them"};
  return std::nullopt;
}

Fault fault_of_maps(const ocean::SeaDescription& sea) {
  for (std::size_t n = 0; n < sea.maps.size(); ++n)
    if (sea.maps[n].file.empty())
      return SceneFault{fmt::format("{}[{}].file", kMapsKey, n), "none", "a readable map file"};
  const std::size_t layers = ocean::count_map_layers(sea);
  const std::size_t patches = ocean::wave_systems(sea).empty() ? 0 : sea.patch_lengths_m.size();
  if (layers == 0 || layers + patches <= ocean::kMaxPatches) return std::nullopt;
  return SceneFault{std::string(sea.maps.empty() ? "sea.map_set" : kMapsKey),
                    fmt::format("{} layers beside {} patches of the spectrum", layers, patches),
                    fmt::format("at most {} of both", ocean::kMaxPatches)};
}

Fault fault_of_ripples(const Ripples& ripples) {
  if (!ripples.detail.empty() && ripples.sequence.empty())
    return SceneFault{"ripples.detail", "it without ripples.sequence", "both"};
  if (ripples.sequence.empty() || ripples.kind == RippleKind::kSequence) return std::nullopt;
  return SceneFault{"ripples.sequence", "it with kind = \"layers\"", "it with kind = \"sequence\""};
}

Fault fault_of_coast_line(const TerrainDescription& terrain) {
  const auto& coast = terrain.coast_m;
  for (std::size_t n = 1; n < coast.size(); ++n)
    if (glm::distance(coast[n - 1], coast[n]) < terrain::kShortestStretch_m)
      return SceneFault{
          fmt::format("terrain.coast_m[{}]", n), fmt::format("[{}, {}]", coast[n].x, coast[n].y),
          fmt::format("a point {} m or more from the one before", terrain::kShortestStretch_m)};
  if (!coast.empty() && !terrain.height_image.empty())
    return SceneFault{"terrain.coast_m", "it besides terrain.height_image", "one of them"};
  if (terrain.ground_from_boundary && terrain.boundary.empty())
    return SceneFault{"terrain.ground", "\"boundary\" without terrain.boundary",
                      "\"heights\", or \"boundary\" with its file"};
  return std::nullopt;
}

Fault fault_of_projection(const Camera& camera) {
  if (camera.projection == ProjectionKind::kEquirectangular && camera.focal_px)
    return SceneFault{"camera.focal_px", "it for camera.projection \"equirectangular\"",
                      "it for the others"};
  const glm::dvec4& k = camera.fisheye_k;
  if (camera.projection == ProjectionKind::kFisheye &&
      !is_one_to_one({k[0], k[1], k[2], k[3]}, 0.5 * camera.fisheye_fov_rad))
    return SceneFault{"camera.fisheye_k", fmt::format("[{}, {}, {}, {}]", k[0], k[1], k[2], k[3]),
                      "a lens whose radius grows with the angle up to half of fisheye_fov_deg"};
  return std::nullopt;
}

// Which way the camera looks and what it sees is said in one way only.
Fault fault_of_camera(const Camera& camera) {
  if (camera.quaternion && !(std::abs(glm::length(*camera.quaternion) - 1.0) < 1e-3))
    return SceneFault{"camera.quaternion",
                      fmt::format("a length of {}", glm::length(*camera.quaternion)),
                      "a length of 1, within 0.001"};
  const auto beside_path = [&](std::string_view key) {
    return SceneFault{std::string(key), fmt::format("it besides [[{}]]", kPathKey), "one of them"};
  };
  if (camera.quaternion && !camera.path.empty()) return beside_path("camera.quaternion");
  if (!camera.mount.empty() && !camera.path.empty()) return beside_path("camera.mount");
  const auto alone = [](std::string_view key, std::string_view other) {
    return SceneFault{std::string(key), fmt::format("it without {}", other), "both or neither"};
  };
  if (camera.focal_px && !camera.size_px) return alone("camera.focal_px", "camera.size_px");
  if (camera.size_px && !camera.focal_px) return alone("camera.size_px", "camera.focal_px");
  if (camera.principal_px && !camera.focal_px)
    return alone("camera.principal_px", "camera.focal_px");
  if (camera.mount.empty() && camera.mount_offset_m != glm::dvec3(0.0))
    return alone("camera.mount_offset_m", "camera.mount");
  return fault_of_projection(camera);
}

// An f-number exposes light that has a unit, and nothing else does then.
Fault fault_of_exposure(const Scene& scene) {
  if (scene.camera.f_number == 0.0) return std::nullopt;
  if (scene.camera.exposure_s == 0.0)
    return SceneFault{"camera.f_number", "it without camera.exposure_s", "both"};
  if (sky::is_gradient(scene.sky))
    return SceneFault{"camera.f_number", "it under a gradient, whose light has no unit",
                      "it where sky.model is \"atmosphere\""};
  if (scene.sky.exposure)
    return SceneFault{"camera.f_number", "it besides sky.exposure", "one of them"};
  return std::nullopt;
}

Fault fault_of_names(const Scene& scene) {
  std::vector<std::string_view> names;
  for (std::size_t n = 0; n < scene.objects.size(); ++n) {
    const std::string& name = scene.objects[n].name;
    if (name.empty()) continue;
    if (std::ranges::count(names, name) > 0)
      return SceneFault{fmt::format("{}[{}].name", kObjectsKey, n), fmt::format("\"{}\"", name),
                        "a name that no object before it has"};
    names.push_back(name);
  }
  if (scene.camera.mount.empty() || camera_mount(scene)) return std::nullopt;
  return SceneFault{"camera.mount", fmt::format("\"{}\"", scene.camera.mount),
                    names.empty()
                        ? "the name of an object, which none has"
                        : fmt::format("the name of an object: \"{}\"", fmt::join(names, "\", \""))};
}

// What is wrong with a path of `key`.
Fault fault_of_way(const std::vector<glm::dvec2>& path_m, bool closed, const std::string& key) {
  const auto point = [&](std::size_t i) { return fmt::format("{}[{}]", key, i); };
  for (std::size_t i = 1; i < path_m.size(); ++i)
    if (glm::distance(path_m[i - 1], path_m[i]) < kShortestStretch_m)
      return SceneFault{
          point(i), fmt::format("[{}, {}]", path_m[i].x, path_m[i].y),
          fmt::format("a point {} m or more from the one before", kShortestStretch_m)};
  if (closed && path_m.size() >= 2 &&
      glm::distance(path_m.front(), path_m.back()) < kShortestStretch_m)
    return SceneFault{point(path_m.size() - 1), "a last point at the first",
                      "a closed path that does not repeat it"};
  return std::nullopt;
}

// Only a mesh or a form has a file, and a path leads somewhere.
Fault fault_of_objects(const std::vector<FloatingObject>& objects, bool has_rivers) {
  for (std::size_t n = 0; n < objects.size(); ++n) {
    const FloatingObject& object = objects[n];
    const auto key = [&](std::string_view name) {
      return fmt::format("{}[{}].{}", kObjectsKey, n, name);
    };
    const bool has_file = kObjectKinds[object.kind].is_of_file;
    const std::string kind(kObjectKindNames[object.kind]);
    if (has_file && object.file.empty())
      return SceneFault{key("kind"), fmt::format("\"{}\" without a file", kind),
                        fmt::format("a {} with its file", kind)};
    if (!has_file && !object.file.empty())
      return SceneFault{key("file"), "it of another kind than \"mesh\" or \"form\"",
                        "files of meshes and forms"};
    if (Fault fault = fault_of_way(object.path_m, object.path_closed, key("path_m"))) return fault;
    if (object.drift && !object.path_m.empty())
      return SceneFault{key("drift"), "it besides path_m", "one of them"};
    if (object.drift && object.motion != Motion::kFloat)
      return SceneFault{key("drift"), "it of what does not float", "it with motion = \"float\""};
    if (object.drift && !has_rivers)
      return SceneFault{key("drift"), "it in a scene without rivers", "it on a river"};
  }
  return std::nullopt;
}

Fault fault_of_disturbance_values(const std::vector<ocean::Disturbance>& disturbances) {
  return fault_of_tables(kDisturbancesKey, disturbances, kMaxDisturbances,
                         disturbance_parameters());
}

// A hull has a path.
Fault fault_of_disturbances(const std::vector<ocean::Disturbance>& disturbances) {
  for (std::size_t n = 0; n < disturbances.size(); ++n) {
    const ocean::Disturbance& d = disturbances[n];
    const std::string key = fmt::format("{}[{}].", kDisturbancesKey, n);
    if (d.kind == ocean::DisturbanceKind::kHull && d.path_m.size() < 2)
      return SceneFault{key + "kind", "\"hull\" without a path_m", "a hull with its path"};
    if (Fault fault = fault_of_way(d.path_m, d.path_closed, key + "path_m")) return fault;
  }
  return std::nullopt;
}

// What drifts floats on a river's water, which alone says where it goes.
Fault fault_of_drifters(const std::vector<FloatingObject>& objects,
                        const ocean::RiverNetwork& network, const ocean::RiverFlow& flow) {
  for (std::size_t n = 0; n < objects.size(); ++n) {
    const FloatingObject& object = objects[n];
    const glm::dvec2 p = object.position_m;
    if (object.drift && !ocean::drifts_at(network, flow, p))
      return SceneFault{fmt::format("{}[{}].position_m", kObjectsKey, n),
                        fmt::format("[{}, {}], where no river flows", p.x, p.y),
                        "a place in a river for what drifts"};
  }
  return std::nullopt;
}

// What their network says.
Fault fault_of_rivers(const Scene& scene) {
  if (scene.rivers.empty() && scene.lakes.empty()) return std::nullopt;
  if (!scene.terrain)
    return SceneFault{std::string(scene.rivers.empty() ? kLakesKey : kRiversKey),
                      "it without a terrain", "rivers and lakes on a terrain"};
  try {
    const ocean::RiverNetwork network(scene.rivers, scene.lakes);
    const ocean::RiverFlow flow(network, river_obstacles(scene, network));
    return fault_of_drifters(scene.objects, network, flow);
  } catch (const ocean::RiverError& error) {
    return SceneFault{error.key, error.got, error.allowed};
  }
  return std::nullopt;
}

Fault fault_of_trees(const Scene& scene) {
  if (!scene.trees.empty() && !scene.terrain)
    return SceneFault{std::string(kTreesKey), "it without [terrain]", "both or neither"};
  for (std::size_t n = 0; n < scene.trees.size(); ++n) {
    const auto fault = [&](std::string_view key, glm::dvec2 range) {
      return SceneFault{fmt::format("{}[{}].{}", kTreesKey, n, key),
                        fmt::format("[{}, {}]", range.x, range.y), "the lower one first"};
    };
    const terrain::TreeStand& stand = scene.trees[n];
    if (stand.height_m.x > stand.height_m.y) return fault("height_m", stand.height_m);
    if (stand.ground_m.x > stand.ground_m.y) return fault("ground_m", stand.ground_m);
  }
  return std::nullopt;
}

Fault fault_of_path(const std::vector<Waypoint>& path) {
  const auto late = std::ranges::adjacent_find(path, std::greater_equal{}, &Waypoint::t_s);
  if (late == path.end()) return std::nullopt;
  const auto n = static_cast<std::size_t>(late - path.begin()) + 1;
  return SceneFault{fmt::format("{}[{}].t_s", kPathKey, n), fmt::format("{}", path[n].t_s),
                    fmt::format("more than that of the table before, {}", late->t_s)};
}

std::string name_for_messages(const Scene& scene) {
  const bool has_name = !scene.name.empty() && scene.name.size() <= kMaxTextBytes;
  return has_name ? scene.name : "scene";
}

}  // namespace

std::optional<SceneFault> find_fault(const Scene& scene) {
  if (Fault fault = fault_of_keys(scene)) return fault;
  if (Fault fault =
          fault_of_tables(kPathKey, scene.camera.path, kMaxWaypoints, waypoint_parameters()))
    return fault;
  if (Fault fault =
          fault_of_tables(kSwellKey, scene.sea.swells, ocean::kMaxSwells, swell_parameters()))
    return fault;
  if (Fault fault =
          fault_of_tables(kSinesKey, scene.sea.sines, ocean::kMaxSines, sine_parameters()))
    return fault;
  if (Fault fault = fault_of_tables(kMapsKey, scene.sea.maps, ocean::kMaxPatches, map_parameters()))
    return fault;
  if (Fault fault =
          fault_of_tables(kCumulusKey, scene.clouds.cumulus, kMaxCumulus, cumulus_parameters()))
    return fault;
  if (Fault fault = fault_of_tables(kObjectsKey, scene.objects, kMaxObjects, object_parameters()))
    return fault;
  if (Fault fault = fault_of_disturbance_values(scene.disturbances)) return fault;
  if (Fault fault = fault_of_tables(kRiversKey, scene.rivers, kMaxRivers, river_parameters()))
    return fault;
  if (Fault fault = fault_of_tables(kLakesKey, scene.lakes, kMaxLakes, lake_parameters()))
    return fault;
  if (Fault fault = fault_of_tables(kTreesKey, scene.trees, kMaxTreeStands, tree_parameters()))
    return fault;
  return find_disagreement(scene);
}

std::optional<SceneFault> find_disagreement(const Scene& scene) {
  if (Fault fault = fault_of_camera(scene.camera)) return fault;
  if (Fault fault = fault_of_path(scene.camera.path)) return fault;
  if (Fault fault = fault_of_exposure(scene)) return fault;
  if (Fault fault = fault_of_names(scene)) return fault;
  if (Fault fault = fault_of_objects(scene.objects, !scene.rivers.empty())) return fault;
  if (Fault fault = fault_of_disturbances(scene.disturbances)) return fault;
  if (Fault fault = fault_of_rivers(scene)) return fault;
  if (Fault fault = fault_of_trees(scene)) return fault;
  if (Fault fault = fault_of_sky(scene.sky)) return fault;
  if (Fault fault = fault_of_clouds(scene.clouds)) return fault;
  if (Fault fault = fault_of_sea(scene)) return fault;
  if (Fault fault = fault_of_maps(scene.sea)) return fault;
  if (Fault fault = fault_of_ripples(scene.ripples)) return fault;
  if (!scene.terrain) return std::nullopt;
  if (Fault fault = fault_of_coast_line(*scene.terrain)) return fault;
  // Over an image, whose size is not known yet, build_coast() checks this.
  const std::optional<double> size_m = described_size_m(*scene.terrain);
  return size_m ? fault_of_coast_grid(scene.coast, *size_m) : std::nullopt;
}

std::optional<SceneFault> find_fault(const std::vector<ocean::Disturbance>& disturbances) {
  if (Fault fault = fault_of_disturbance_values(disturbances)) return fault;
  return fault_of_disturbances(disturbances);
}

std::string fault_text(const SceneFault& fault) {
  return fmt::format("{}, got {}, allowed {}", fault.key, shortened(fault.got, 300), fault.allowed);
}

std::string place_of_key(const Scene& scene, const std::string& key) {
  if (!scene.places) return name_for_messages(scene);
  return place_text(scene.places->file, place_of_key(scene.places->places, key));
}

void refuse(const Scene& scene, const SceneFault& fault) {
  throw SceneError(
      one_line(fmt::format("{}: {}", place_of_key(scene, fault.key), fault_text(fault))));
}

void refuse(const Scene& scene, const terrain::TerrainError& error) {
  if (error.key.empty()) throw SceneError(error.what());
  refuse(scene, SceneFault{error.key, error.got, error.allowed});
}

void check_scene(const Scene& scene) {
  if (const Fault fault = find_fault(scene))
    throw SceneError(one_line(fmt::format("{}: {}", name_for_messages(scene), fault_text(*fault))));
}

}  // namespace swell::scene
