#include "scene/file/key_places.h"

#include <fmt/format.h>

namespace swell::scene {

std::string place_text(const std::filesystem::path& file, const Place& place) {
  if (!place.setting.empty()) return place.setting;
  if (place.line == 0) return file.string();
  return fmt::format("{}:{}: column {}", file.string(), place.line, place.column);
}

Place place_of_key(const Places& places, std::string key) {
  for (;;) {
    if (const auto found = places.find(key); found != places.end()) return found->second;
    const std::size_t end = key.find_last_of(".[");
    if (end == std::string::npos) return {};
    key.resize(end);
  }
}

}  // namespace swell::scene
