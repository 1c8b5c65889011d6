// Values of TOML as the table of parameters allows them, for scene_file.cpp.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/file/parameters.h"
#include "scene/file/scene_tables.h"
#include "texture/square_frames.h"

namespace swell::scene {

// What a TOML value is, for messages: its text if it is a number or boolean, else its type.
std::string got_text(const toml::node& node);

// The text of a value: a string's, or that of a date or time, which needs no quotes. Null of
// others.
std::optional<std::string> text_value(const toml::node& node);

// Checks the values of one file, and notes the places of points in `given`.
class CheckedValues {
 public:
  CheckedValues(const std::filesystem::path& file, Places& given) : file_(file), given_(given) {}

  // `path` is the value's key, for messages. Throws SceneError.
  template <class Object>
  ParameterValue value(const toml::node& node, const std::string& path,
                       const Parameter<Object>& parameter) {
    const std::string allowed = allowed_text(parameter);
    switch (parameter.kind) {
      case ParameterKind::kNumber:
        return std::vector<double>{checked_number(node, path, parameter, allowed)};
      case ParameterKind::kNumbers:
        return checked_numbers(node, path, parameter, allowed);
      case ParameterKind::kPoints:
        return checked_points(node, path, parameter, allowed);
      case ParameterKind::kInteger:
      case ParameterKind::kPowerOfTwo:
        return checked_integer(node, path, parameter, allowed);
      case ParameterKind::kBoolean:
        if (const auto* boolean = node.as_boolean()) return boolean->get();
        break;
      case ParameterKind::kChoice:
      case ParameterKind::kText:
      case ParameterKind::kPath:
        return checked_text(node, path, parameter, allowed);
    }
    fail_value(node, path, got_text(node), allowed);
  }

  [[noreturn]] void fail_value(const toml::node& node, const std::string& path,
                               const std::string& got, const std::string& allowed) const;

 private:
  template <class Object>
  double checked_number(const toml::node& node, const std::string& path,
                        const Parameter<Object>& parameter, const std::string& allowed) const {
    const std::optional<double> number =
        node.is_number() ? node.value<double>() : std::optional<double>();
    if (number && allows(parameter, *number)) return *number;
    fail_value(node, path, got_text(node), allowed);
  }

  // An array of as many elements as the parameter takes.
  template <class Object>
  const toml::array& checked_array(const toml::node& node, const std::string& path,
                                   const Parameter<Object>& parameter,
                                   const std::string& allowed) const {
    const toml::array* array = node.as_array();
    if (!array || !allows_count(parameter, array->size()))
      fail_value(node, path, got_text(node), allowed);
    return *array;
  }

  template <class Object>
  std::vector<double> checked_numbers(const toml::node& node, const std::string& path,
                                      const Parameter<Object>& parameter,
                                      const std::string& allowed) const {
    if (parameter.one_for_all && node.is_number())
      return std::vector<double>(static_cast<std::size_t>(parameter.count_high),
                                 checked_number(node, path, parameter, allowed));
    std::vector<double> numbers;
    for (const toml::node& element : checked_array(node, path, parameter, allowed))
      numbers.push_back(
          checked_number(element, fmt::format("{}[{}]", path, numbers.size()), parameter, allowed));
    return numbers;
  }

  // x and y of each point in turn.
  template <class Object>
  std::vector<double> checked_points(const toml::node& node, const std::string& path,
                                     const Parameter<Object>& parameter,
                                     const std::string& allowed) {
    std::vector<double> numbers;
    for (const toml::node& element : checked_array(node, path, parameter, allowed)) {
      const std::string its_path = fmt::format("{}[{}]", path, numbers.size() / 2);
      given_.emplace(its_path, place_of(element.source()));
      const toml::array* pair = element.as_array();
      if (!pair || pair->size() != 2) fail_value(element, its_path, got_text(element), allowed);
      for (const toml::node& number : *pair)
        numbers.push_back(checked_number(number, its_path, parameter, allowed));
    }
    return numbers;
  }

  template <class Object>
  std::int64_t checked_integer(const toml::node& node, const std::string& path,
                               const Parameter<Object>& parameter,
                               const std::string& allowed) const {
    if (const auto* integer = node.as_integer()) {
      if (allows(parameter, integer->get())) return integer->get();
    }
    fail_value(node, path, got_text(node), allowed);
  }

  template <class Object>
  std::string checked_text(const toml::node& node, const std::string& path,
                           const Parameter<Object>& parameter, const std::string& allowed) const {
    const std::optional<std::string> text = text_value(node);
    if (!text) fail_value(node, path, got_text(node), allowed);
    if (parameter.is_of_frames) return checked_frame_paths(node, path, *text, parameter);
    if (parameter.kind == ParameterKind::kPath)
      return checked_path(node, path, *text, parameter.path_of);
    if (!allows(parameter, *text)) fail_value(node, path, got_text(node), allowed);
    return *text;
  }

  // Returns the absolute path of a file that can be opened.
  std::string checked_path(const toml::node& node, const std::string& key, const std::string& text,
                           std::string_view path_of) const;

  // Returns the absolute path of files that a number tells apart, of which number 0 can be opened.
  template <class Object>
  std::string checked_frame_paths(const toml::node& node, const std::string& key,
                                  const std::string& text,
                                  const Parameter<Object>& parameter) const {
    if (text.empty()) return text;
    const bool has_number = text.find(texture::kFrameNumber) != std::string::npos;
    if (!has_number || std::ranges::count(text, '%') != 1)
      fail_value(node, key, got_text(node), allowed_text(parameter));
    checked_path(node, key, texture::path_of_frame(text, 0), parameter.path_of);
    return beside_file(text).string();
  }

  // The absolute path of what `text` names, relative to the file.
  std::filesystem::path beside_file(const std::string& text) const;

  const std::filesystem::path& file_;
  Places& given_;
};

}  // namespace swell::scene
