#include "scene/file/scene_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>

#include "scene/file/json_tables.h"
#include "scene/file/parameters.h"
#include "scene/file/toml_limits.h"
#include "scene/scene_error.h"

namespace swell::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSetting = "setting ";

bool is_json(std::string_view text, const fs::path& file) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return file.extension() == ".json" || (first != std::string_view::npos && text[first] == '{');
}

toml::table parse_text(std::string_view text, const fs::path& file) {
  if (text.size() > kMaxFileBytes)
    fail(file, {}, fmt::format("scene file, got more than {0} bytes, allowed {0}", kMaxFileBytes));
  if (const std::uint32_t line = find_deep_nesting(text))
    fail(file, {line, 1},
         fmt::format("syntax error, got nesting too deep to be a scene, allowed {} levels",
                     kMaxNesting));
  if (is_json(text, file)) return parse_json_tables(text, file);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    fail(file, place_of(error.source()),
         fmt::format("syntax error, got '{}', allowed TOML 1.0", shortened(error.description())));
  }
}

// ---- Settings

// One part of a dotted key: a name, and the numbers in brackets after it.
struct KeyPart {
  std::string name;
  std::vector<std::size_t> indices;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// A setting that is being made.
class Setting {
 public:
  explicit Setting(const std::string& text)
      : source_(one_line(std::string(kSetting) + shortened(text))) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || text.size() > kMaxFileBytes || find_deep_nesting(text) != 0)
      refuse("a setting, got none, allowed KEY=VALUE");
    value_ = trimmed(std::string_view(text).substr(equals + 1));
    std::string_view key = trimmed(std::string_view(text).substr(0, equals));
    for (std::size_t end = 0; end != std::string_view::npos;) {
      end = key.find('.');
      parts_.push_back(key_part(key.substr(0, end)));
      if (end != std::string_view::npos) key.remove_prefix(end + 1);
    }
  }

  void apply(toml::table& root) const {
    toml::table* table = &root;
    for (std::size_t i = 0; i + 1 < parts_.size(); ++i) {
      const KeyPart& part = parts_[i];
      toml::node* node = child(*table, part.name, part.indices.empty());
      for (std::size_t n = 0; n < part.indices.size(); ++n)
        node = element(*node, part, part.indices[n], n + 1 == part.indices.size());
      table = node->as_table();
      if (!table)
        refuse(fmt::format("'{}', got a key in it, allowed none: it is no table",
                           shortened(part.name)));
    }
    set_last(*table);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw SceneError(one_line(fmt::format("{}: {}", source_, what)));
  }

  KeyPart key_part(std::string_view text) const {
    const auto fault = [&] {
      refuse(
          fmt::format("a key, got '{}', allowed dotted names, as wind.speed_mps or "
                      "object[0].name",
                      shortened(text)));
    };
    const std::size_t bracket = std::min(text.find('['), text.size());
    KeyPart part{std::string(text.substr(0, bracket)), {}};
    if (part.name.empty()) fault();
    for (std::string_view rest = text.substr(bracket); !rest.empty();) {
      const std::size_t close = rest.find(']');
      if (rest[0] != '[' || close == std::string_view::npos || close < 2 || close > 7) fault();
      std::size_t index = 0;
      for (const char digit : rest.substr(1, close - 1)) {
        if (digit < '0' || digit > '9') fault();
        index = 10 * index + static_cast<std::size_t>(digit - '0');
      }
      part.indices.push_back(index);
      rest.remove_prefix(close + 1);
    }
    return part;
  }

  // The table or array of a name, which is made if it is not there.
  toml::node* child(toml::table& table, const std::string& name, bool is_table) const {
    if (toml::node* node = table.get(name)) return node;
    if (is_table) return insert(table, name, parsed("{}"));
    return insert(table, name, parsed("[]"));
  }

  toml::node* insert(toml::table& table, const std::string& name, toml::table holder) const {
    table.erase(name);  // with its key, which says where it stood
    const toml::key key(name, holder.source());
    return &table.insert_or_assign(key, std::move(*holder.get("v"))).first->second;
  }

  // An element of an array; one more than there are is made, a table if it is to hold more.
  toml::node* element(toml::node& node, const KeyPart& part, std::size_t index,
                      bool is_table) const {
    toml::array& array = array_of(node, part, index);
    if (index == array.size()) array.push_back(std::move(*parsed(is_table ? "{}" : "[]").get("v")));
    return array.get(index);
  }

  toml::array& array_of(toml::node& node, const KeyPart& part, std::size_t index) const {
    toml::array* const array = node.as_array();
    if (!array)
      refuse(fmt::format("'{}', got [{}] after it, allowed none: it is no array",
                         shortened(part.name), index));
    if (index > array->size())
      refuse(fmt::format("'{}', got [{}] after it, allowed [0] to [{}]", shortened(part.name),
                         index, array->size()));
    return *array;
  }

  void set_last(toml::table& table) const {
    const KeyPart& part = parts_.back();
    if (part.indices.empty()) {
      if (value_.empty())
        table.erase(part.name);
      else
        insert(table, part.name, value());
      return;
    }
    toml::node* node = child(table, part.name, false);
    for (std::size_t n = 0; n + 1 < part.indices.size(); ++n)
      node = element(*node, part, part.indices[n], false);
    const std::size_t index = part.indices.back();
    toml::array& array = array_of(*node, part, index);
    const auto place = array.cbegin() + static_cast<std::ptrdiff_t>(index);
    if (index < array.size()) array.erase(place);
    if (!value_.empty())
      array.insert(array.cbegin() + static_cast<std::ptrdiff_t>(index),
                   std::move(*value().get("v")));
  }

  // The value as the key "v" of a table: as TOML, or as text.
  toml::table value() const {
    try {
      toml::table holder = parsed(value_);
      if (holder.size() == 1) return holder;
    } catch (const toml::parse_error&) {
    }
    std::string quoted = "\"";
    for (const char c : value_) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\' || byte < 0x20 || byte == 0x7f)
        quoted += fmt::format("\\u{:04X}", byte);
      else
        quoted += c;
    }
    try {
      return parsed(quoted + '"');
    } catch (const toml::parse_error& error) {
      refuse(fmt::format("a value, got '{}', allowed TOML 1.0 or text",
                         shortened(error.description())));
    }
  }

  toml::table parsed(std::string_view toml) const {
    return toml::parse(fmt::format("v = {}", toml), source_);
  }

  std::string source_;  // as places have it
  std::string value_;
  std::vector<KeyPart> parts_;
};

}  // namespace

Place place_of(const toml::source_region& region) {
  Place place{region.begin.line, region.begin.column};
  if (region.path && region.path->starts_with(kSetting)) place.setting = *region.path;
  return place;
}

void fail(const fs::path& file, const Place& place, const std::string& text) {
  throw SceneError(one_line(fmt::format("{}: {}", place_text(file, place), text)));
}

std::vector<TableEntry> in_file_order(const toml::table& table) {
  std::vector<TableEntry> entries;
  for (const auto& [key, node] : table)
    entries.push_back({key.str(), &node, place_of(key.source())});
  std::ranges::stable_sort(entries, {}, [](const TableEntry& entry) {
    return std::pair(entry.key_place.line, entry.key_place.column);
  });
  return entries;
}

std::string read_tables_text(const fs::path& path, std::string_view what) {
  const auto refuse = [&](std::string_view got) {
    throw SceneError(one_line(
        fmt::format("{}: {}, got {}, allowed a readable TOML file", path.string(), what, got)));
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) refuse(fmt::format("'{}'", error.message()));
  if (!fs::is_regular_file(status))
    refuse(fs::is_directory(status) ? "a directory" : "a special file");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("one that cannot be opened");
  std::string text(kMaxFileBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) refuse("a read error");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

toml::table parse_tables(std::string_view text, const fs::path& file,
                         std::span<const std::string> settings) {
  toml::table root = parse_text(text, file);
  for (const std::string& setting : settings) Setting(setting).apply(root);
  return root;
}

}  // namespace swell::scene
