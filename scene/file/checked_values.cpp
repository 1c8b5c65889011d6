#include "scene/file/checked_values.h"

#include <fstream>
#include <sstream>

namespace swell::scene {

namespace fs = std::filesystem;

std::string got_text(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  if (const auto* text = node.as_string()) return fmt::format("\"{}\"", shortened(text->get()));
  if (const auto* array = node.as_array())
    return fmt::format("an array of {} values", array->size());
  if (node.is_table()) return "a table";
  return text_value(node).value_or("a date or time");
}

std::optional<std::string> text_value(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (!node.is_date() && !node.is_time() && !node.is_date_time()) return std::nullopt;
  std::ostringstream text;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_chronological<decltype(value)>) text << value.get();
  });
  return text.str();
}

void CheckedValues::fail_value(const toml::node& node, const std::string& path,
                               const std::string& got, const std::string& allowed) const {
  fail(file_, place_of(node.source()),
       fmt::format("{}, got {}, allowed {}", path, shortened(got, 300), allowed));
}

fs::path CheckedValues::beside_file(const std::string& text) const {
  std::error_code error;
  return fs::absolute(file_.parent_path() / text, error).lexically_normal();
}

std::string CheckedValues::checked_path(const toml::node& node, const std::string& key,
                                        const std::string& text, std::string_view path_of) const {
  if (text.empty()) return text;
  const std::string allowed = fmt::format("a readable {} file", path_of);
  if (text.find('\0') != std::string::npos || text.size() > 4000)
    fail_value(node, key, "a path with a zero byte or over 4000 bytes", allowed);
  std::error_code error;
  const fs::path path = beside_file(text);
  const fs::file_status status = fs::status(path, error);
  std::string fault;
  if (!fs::exists(status))
    fault = error ? error.message() : "no such file";
  else if (!fs::is_regular_file(status))
    fault = "not a file";
  else if (!std::ifstream(path, std::ios::binary))
    fault = "cannot be opened";
  if (fault.empty()) return path.string();
  fail_value(node, key, fmt::format("\"{}\" ({})", path.string(), fault), allowed);
}

}  // namespace swell::scene
