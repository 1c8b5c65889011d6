// Scenes from programs: a scene file's values changed by settings "key=value", as --set has them,
// and scenes as JSON of the same schema.
//
//   const Scene scene = load_scene("harbour.toml", settings);
//   // settings: {"wind.speed_mps=12", "camera.eye_m=[0, -50, 4]", "object[2].heading_deg=30"}
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace swell::scene {

// The scene of a file in which each setting, in their order, has given a key another value. KEY is
// a dotted key of docs/look_up/scene.md; [n] after a name is the n-th table of [[name]], or the
// n-th element of an array, from 0 on; the number of those that are there adds one. VALUE is as
// TOML has it, where text may go without its quotes; an empty one leaves the key out. A file is
// JSON if its name ends with .json or its text begins with '{': objects are tables, and a dotted
// key stands for tables in each other. Throws as load_scene(path); of a setting's fault: 'setting
// KEY=VALUE: ...'.
Scene load_scene(const std::filesystem::path& path, std::span<const std::string> settings);

// Parses such a scene from text. Relative paths, those of settings too, are relative to the folder
// of `file_name`.
Scene parse_scene(std::string_view text, const std::filesystem::path& file_name,
                  std::span<const std::string> settings);

}  // namespace swell::scene
