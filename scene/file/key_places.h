// Where the text of a scene has its keys, for what is said of their values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace swell::scene {

// Where something stands: in a file, by line and column, which are 0 where they are not known
// (JSON); or in a setting.
struct Place {
  std::uint32_t line = 1, column = 1;
  std::string setting{};  // "setting KEY=VALUE"; empty: in the file
};

// 'FILE:LINE: column COLUMN', 'FILE' or 'setting KEY=VALUE'
std::string place_text(const std::filesystem::path& file, const Place& place);

// By key, table and element of an array: "river[0].path_m[2]", "river[0]", "river".
using Places = std::map<std::string, Place>;

// That of the key, or else of the innermost table or array around it that has one; without any the
// file's first line.
Place place_of_key(const Places& places, std::string key);

// The places of one scene (Scene::places).
struct KeyPlaces {
  std::filesystem::path file;
  Places places;
};

}  // namespace swell::scene
