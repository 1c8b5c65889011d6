// How values of the table are said: in messages, in docs/look_up/scene.md and in dumped scenes.
#include <fmt/format.h>

#include <algorithm>

#include "scene/file/parameters.h"
#include "scene/file/rig.h"

namespace swell::scene {
namespace {

using Kind = ParameterKind;

std::string basic_string_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

// Shortest text that parses to the same double, with a point or an exponent.
std::string float_text(double number) {
  std::string text = fmt::format("{}", number);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string list_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) {
    if (!text.empty()) text += ", ";
    text += float_text(number);
  }
  return "[" + text + "]";
}

// A list, or the number that all of them are.
std::string numbers_text(const std::vector<double>& numbers, bool one_for_all) {
  const bool is_one = one_for_all && std::ranges::count(numbers, numbers[0]) == std::ssize(numbers);
  return is_one ? float_text(numbers[0]) : list_text(numbers);
}

// Points as pairs of numbers.
std::string points_text(const std::vector<double>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    text += (i ? ", " : "") + list_text({numbers[i], numbers[i + 1]});
  return "[" + text + "]";
}

// "a", "b" or "c".
std::string choices_text(std::span<const std::string_view> choices) {
  const auto last = choices.size() - 1;
  return fmt::format("\"{}\" or \"{}\"", fmt::join(choices.first(last), "\", \""), choices[last]);
}

}  // namespace

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  constexpr std::size_t kMaxBytes = 600;
  if (text.size() <= kMaxBytes) return text;
  std::size_t end = kMaxBytes;
  while ((static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

std::string shortened(std::string_view text, std::size_t most_bytes) {
  if (text.size() <= most_bytes) return std::string(text);
  const auto is_within = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
  };
  std::size_t head = 2 * most_bytes / 3, tail = text.size() - (most_bytes - head - 3);
  while (head > 0 && is_within(head)) --head;
  while (tail < text.size() && is_within(tail)) ++tail;
  return fmt::format("{}...{}", text.substr(0, head), text.substr(tail));
}

template <class Object>
std::string allowed_text(const Parameter<Object>& parameter) {
  const std::string range =
      fmt::format("{}{} to {}{}{}", parameter.zero_too ? "0 or " : "", parameter.low,
                  parameter.high, parameter.unit.empty() ? "" : " ", parameter.unit);
  switch (parameter.kind) {
    case Kind::kNumber:
      return range;
    case Kind::kNumbers:
      if (parameter.count_low == parameter.count_high)
        return fmt::format("{}{} numbers, each {}", parameter.one_for_all ? "one number or " : "",
                           parameter.count_low, range);
      return fmt::format("{} to {} numbers, each {}", parameter.count_low, parameter.count_high,
                         range);
    case Kind::kPoints:
      return fmt::format("{} to {} points [east, north], each number {}", parameter.count_low,
                         parameter.count_high, range);
    case Kind::kInteger:
      return "an integer, " + range;
    case Kind::kPowerOfTwo:
      return fmt::format("a power of two, {} to {}{}", parameter.low, parameter.high,
                         parameter.zero_too ? ", or 0" : "");
    case Kind::kBoolean:
      return "true or false";
    case Kind::kChoice:
      return choices_text(parameter.choices);
    case Kind::kText:
      return fmt::format("text of at most {} bytes", kMaxTextBytes);
    case Kind::kPath:
      if (parameter.is_of_frames)
        return fmt::format("the path of readable {} files, with one %04d", parameter.path_of);
      return fmt::format("the path of a readable {} file", parameter.path_of);
  }
  return {};
}

template std::string allowed_text(const Parameter<Scene>&);
template std::string allowed_text(const Parameter<ocean::Swell>&);
template std::string allowed_text(const Parameter<ocean::SineWave>&);
template std::string allowed_text(const Parameter<ocean::MapLayer>&);
template std::string allowed_text(const Parameter<FloatingObject>&);
template std::string allowed_text(const Parameter<ocean::Disturbance>&);
template std::string allowed_text(const Parameter<ocean::River>&);
template std::string allowed_text(const Parameter<ocean::Lake>&);
template std::string allowed_text(const Parameter<terrain::TreeStand>&);
template std::string allowed_text(const Parameter<Waypoint>&);
template std::string allowed_text(const Parameter<Cumulus>&);
template std::string allowed_text(const Parameter<Rig>&);
template std::string allowed_text(const Parameter<RigBody>&);
template std::string allowed_text(const Parameter<Sensor>&);

template <class Object>
std::string toml_text(const Parameter<Object>& parameter, const Object& object) {
  if (parameter.is_set && !parameter.is_set(object)) return {};
  const ParameterValue value = parameter.get(object);
  switch (parameter.kind) {
    case Kind::kNumber:
      return float_text(std::get<std::vector<double>>(value)[0]);
    case Kind::kNumbers:
      return numbers_text(std::get<std::vector<double>>(value), parameter.one_for_all);
    case Kind::kPoints:
      return points_text(std::get<std::vector<double>>(value));
    case Kind::kInteger:
    case Kind::kPowerOfTwo:
      return fmt::format("{}", std::get<std::int64_t>(value));
    case Kind::kBoolean:
      return std::get<bool>(value) ? "true" : "false";
    case Kind::kChoice:
    case Kind::kText:
    case Kind::kPath:
      return basic_string_text(std::get<std::string>(value));
  }
  return {};
}

template std::string toml_text(const Parameter<Scene>&, const Scene&);
template std::string toml_text(const Parameter<ocean::Swell>&, const ocean::Swell&);
template std::string toml_text(const Parameter<ocean::SineWave>&, const ocean::SineWave&);
template std::string toml_text(const Parameter<ocean::MapLayer>&, const ocean::MapLayer&);
template std::string toml_text(const Parameter<FloatingObject>&, const FloatingObject&);
template std::string toml_text(const Parameter<ocean::Disturbance>&, const ocean::Disturbance&);
template std::string toml_text(const Parameter<ocean::River>&, const ocean::River&);
template std::string toml_text(const Parameter<ocean::Lake>&, const ocean::Lake&);
template std::string toml_text(const Parameter<terrain::TreeStand>&, const terrain::TreeStand&);
template std::string toml_text(const Parameter<Waypoint>&, const Waypoint&);
template std::string toml_text(const Parameter<Cumulus>&, const Cumulus&);
template std::string toml_text(const Parameter<Rig>&, const Rig&);
template std::string toml_text(const Parameter<RigBody>&, const RigBody&);
template std::string toml_text(const Parameter<Sensor>&, const Sensor&);

}  // namespace swell::scene
