#include "apps/sim/json_inputs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "apps/shared/json.h"
#include "scene/scene.h"
#include "scene/scene_error.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

constexpr std::size_t kLongestLine = 65536;
constexpr const char* kAllowed =
    "allowed {\"clock_ns\": N}, {\"disturbance\": {...}, \"stamp_ns\": N} or {\"body\": FRAME, "
    "\"stamp_ns\": N, \"position\": [x, y, z], \"orientation\": [x, y, z, w]}";

template <std::size_t kCount>
bool read_numbers(const Json& line, const char* key, std::array<double, kCount>& numbers) {
  const auto found = line.find(key);
  if (found == line.end() || !found->is_array() || found->size() != kCount) return false;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (!(*found)[i].is_number()) return false;
    numbers[i] = (*found)[i].get<double>();
  }
  return true;
}

// A whole number that fits; others are none.
bool read_time(const Json& line, const char* key, std::int64_t& t_ns) {
  const auto found = line.find(key);
  if (found == line.end() || !found->is_number_integer()) return false;
  if (found->is_number_unsigned() && found->get<std::uint64_t>() >> 63 != 0) return false;
  t_ns = found->get<std::int64_t>();
  return true;
}

void refuse_line(const InputOrigin& from, Inputs& inputs) {
  inputs.refuse(from, fmt::format("got another line, {}", kAllowed));
}

// Values of a disturbance have no depth.
bool is_flat(const Json& value) {
  return !value.is_object() &&
         !(value.is_array() &&
           std::ranges::any_of(value, [](const Json& element) { return element.is_structured(); }));
}

// By the keys of scenes, with their ranges.
void take_disturbance(const Json& given, std::int64_t stamp_ns, const InputOrigin& from,
                      Inputs& inputs) {
  constexpr std::string_view kFile = "line.json";
  if (const auto kind = given.find("kind"); kind != given.end() && *kind == "hull") {
    inputs.refuse(from, "disturbance.kind, got \"hull\", allowed drop, footstep or rotor");
    return;
  }
  if (given.contains("t_s") || !std::ranges::all_of(given, is_flat)) {
    refuse_line(from, inputs);
    return;
  }
  try {
    const std::string scene = Json{{"disturbance", Json::array({given})}}.dump();
    inputs.put_disturbance(from, {stamp_ns, scene::parse_scene(scene, kFile).disturbances.at(0)});
  } catch (const scene::SceneError& error) {
    std::string_view what = error.what();
    if (what.starts_with(kFile)) what.remove_prefix(kFile.size() + 2);
    inputs.refuse(from, std::string(what));
  }
}

}  // namespace

void take_json_line(std::string_view line, const InputOrigin& from, Inputs& inputs) {
  if (line.find_first_not_of(" \t\r") == std::string_view::npos) return;
  // What lies deeper than a line may have is left out: copies and destructors go as deep.
  constexpr int kDeepest = 4;
  const Json json = Json::parse(
      line, [](int depth, Json::parse_event_t, const Json&) { return depth <= kDeepest; }, false);
  std::int64_t t_ns = 0;
  if (json.is_object() && json.size() == 1 && read_time(json, "clock_ns", t_ns)) {
    inputs.put_clock(from, t_ns);
    return;
  }
  const auto disturbance = json.is_object() ? json.find("disturbance") : json.end();
  if (disturbance != json.end() && json.size() == 2 && read_time(json, "stamp_ns", t_ns) &&
      disturbance->is_object()) {
    take_disturbance(*disturbance, t_ns, from, inputs);
    return;
  }
  std::array<double, 3> p{};
  std::array<double, 4> q{};
  const auto body = json.is_object() ? json.find("body") : json.end();
  if (json.is_object() && json.size() == 4 && body != json.end() && body->is_string() &&
      read_time(json, "stamp_ns", t_ns) && read_numbers(json, "position", p) &&
      read_numbers(json, "orientation", q))
    inputs.put_pose(from, body->get_ref<const std::string&>(),
                    {t_ns, {p[0], p[1], p[2]}, {q[3], q[0], q[1], q[2]}});
  else
    refuse_line(from, inputs);
}

JsonInputs::JsonInputs(const std::string& path, Inputs& inputs)
    : name_(path == "-" ? "standard input" : path), inputs_(inputs) {
  file_ = path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) throw texture::FileError(fmt::format("{}: {}", name_, std::strerror(errno)));
  inputs_.begin();
  thread_ = std::thread([this] { read(); });
}

JsonInputs::~JsonInputs() {
  is_ending_ = true;
  inputs_.stop();
  thread_.join();
  ::close(file_);
}

void JsonInputs::read() {
  std::string line;
  std::int64_t number = 1;
  bool is_too_long = false;
  const auto take = [&] {
    const InputOrigin from = {name_, number};
    if (is_too_long)
      inputs_.refuse(from, fmt::format("got a line of over {} bytes", kLongestLine));
    else
      take_json_line(line, from, inputs_);
    line.clear();
    is_too_long = false;
    ++number;
  };
  std::array<char, 16384> bytes;
  while (!is_ending_) {
    pollfd waiting = {file_, POLLIN, 0};
    if (::poll(&waiting, 1, 50) == 0) continue;
    const ssize_t count = ::read(file_, bytes.data(), bytes.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0) inputs_.refuse({name_, number}, std::strerror(errno));
    if (count <= 0) break;
    for (const char c : std::string_view(bytes.data(), static_cast<std::size_t>(count))) {
      if (c == '\n')
        take();
      else if (line.size() < kLongestLine)
        line += c;
      else
        is_too_long = true;
    }
  }
  if (!line.empty()) take();
  inputs_.end();
}

}  // namespace swell::apps
