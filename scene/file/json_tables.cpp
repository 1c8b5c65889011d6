#include "scene/file/json_tables.h"

#include <fmt/core.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "scene/file/scene_tables.h"
#include "scene/file/toml_limits.h"
#include "scene/scene_error.h"

namespace swell::scene {
namespace {

using Json = nlohmann::ordered_json;

class Converter {
 public:
  explicit Converter(const std::filesystem::path& file) : file_(file) {}

  toml::table table(const Json& object, const std::string& prefix) const {
    toml::table result;
    for (const auto& [key, value] : object.items()) insert(result, key, value, prefix);
    return result;
  }

 private:
  static inline const Place kNowhere{0, 0, {}};

  void insert(toml::table& table, std::string_view key, const Json& value,
              const std::string& prefix) const {
    toml::table* holder = &table;
    int dots = 0;
    for (std::size_t dot; (dot = key.find('.')) != std::string_view::npos;
         key.remove_prefix(dot + 1)) {
      if (++dots > kMaxNesting)
        refuse(prefix, "a key with too many dots", "keys of docs/look_up/scene.md");
      holder->insert(key.substr(0, dot), toml::table());
      holder = holder->get(key.substr(0, dot))->as_table();
      if (!holder) refuse(prefix + std::string(key), "a table and a value", "one of them");
    }
    const std::string path = prefix + std::string(key);
    if (const toml::node* before = holder->get(key)) {
      // "wind": {...} beside "wind.speed_mps".
      if (!before->is_table() || !value.is_object()) refuse(path, "it twice", "it once");
      for (const auto& [inner, its] : value.items())
        insert(*holder->get(key)->as_table(), inner, its, path + ".");
      return;
    }
    with_node(value, path, [&](auto&& node) { holder->insert(key, std::move(node)); });
  }

  toml::array array(const Json& values, const std::string& path) const {
    toml::array result;
    for (const Json& value : values)
      with_node(value, fmt::format("{}[{}]", path, result.size()),
                [&](auto&& node) { result.push_back(std::move(node)); });
    return result;
  }

  template <class Take>
  void with_node(const Json& value, const std::string& path, const Take& take) const {
    constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (value.is_object()) return take(table(value, path + "."));
    if (value.is_array()) return take(array(value, path));
    if (value.is_boolean()) return take(value.get<bool>());
    if (value.is_string()) return take(value.get<std::string>());
    if (value.is_number_float() ||
        (value.is_number_unsigned() && value.get<std::uint64_t>() > kMost))
      return take(value.get<double>());
    if (value.is_number_integer()) return take(value.get<std::int64_t>());
    refuse(path, "null", "a value");
  }

  [[noreturn]] void refuse(const std::string& path, std::string_view got,
                           std::string_view allowed) const {
    fail(file_, kNowhere, fmt::format("{}, got {}, allowed {}", shortened(path), got, allowed));
  }

  const std::filesystem::path& file_;
};

}  // namespace

toml::table parse_json_tables(std::string_view text, const std::filesystem::path& file) {
  const auto refuse = [&](std::string_view got) {
    fail(file, {0, 0, {}},
         fmt::format("syntax error, got '{}', allowed an object in JSON", shortened(got)));
  };
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    const std::string_view what = error.what();
    refuse(
        what.substr(std::min(what.find("] ") + 2, what.size())));  // without the library's number
  }
  if (!json.is_object()) refuse(json.type_name());
  return Converter(file).table(json, "");
}

}  // namespace swell::scene
