// The text of a scene as tables, whichever language it is in: the one form that scene_file.cpp
// reads. For scene/ alone.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/file/key_places.h"

namespace swell::scene {

inline constexpr std::size_t kMaxFileBytes = 1 << 20;

Place place_of(const toml::source_region& region);

// Throws SceneError 'PLACE: TEXT'.
[[noreturn]] void fail(const std::filesystem::path& file, const Place& place,
                       const std::string& text);

// A key of a table.
struct TableEntry {
  std::string_view key;
  const toml::node* node;
  Place key_place;
};

// The keys in the order of the file, so that its first fault is the one reported.
std::vector<TableEntry> in_file_order(const toml::table& table);

// The text of a file, `what` ("scene file") for messages; one that is too large is cut off behind
// kMaxFileBytes. Throws SceneError where it cannot be read.
std::string read_tables_text(const std::filesystem::path& path, std::string_view what);

// The tables of a text (TOML, or JSON as settings.h says), changed by the settings. Throws
// SceneError for what is not of the language, too large or too deeply nested, and for a setting
// that cannot be made.
toml::table parse_tables(std::string_view text, const std::filesystem::path& file,
                         std::span<const std::string> settings);

}  // namespace swell::scene
