#include "apps/render/frame_record.h"

#include <fmt/core.h>

#include <cmath>

#include "apps/shared/json.h"
#include "apps/shared/parse_number.h"

namespace swell::apps {
namespace {

constexpr std::size_t kHashDigits = 16;

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::optional<FrameHash> make_frame_hash(std::optional<int> frame, std::string_view hash_digits) {
  const auto hash = parse_number<std::uint64_t>(hash_digits, 16);
  if (!frame || *frame < 0 || !hash || hash_digits.size() != kHashDigits) return std::nullopt;
  return FrameHash{*frame, *hash};
}

std::optional<FrameHash> parse_json_line(std::string_view line) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("frame") || !json.contains("xxh3")) return std::nullopt;
  const Json &frame = json["frame"], &hash = json["xxh3"];
  if (!frame.is_number_integer() || !hash.is_string()) return std::nullopt;
  return make_frame_hash(parse_number<int>(frame.dump()), hash.get_ref<const std::string&>());
}

std::optional<FrameHash> parse_hash_line(std::string_view line) {
  constexpr std::string_view kFrame = "frame ", kHash = " xxh3 ";
  const std::size_t middle = line.find(kHash);
  if (!line.starts_with(kFrame) || middle == std::string_view::npos || middle < kFrame.size())
    return std::nullopt;
  return make_frame_hash(parse_number<int>(line.substr(kFrame.size(), middle - kFrame.size())),
                         line.substr(middle + kHash.size()));
}

}  // namespace

std::string hash_line(const FrameRecord& record) {
  return fmt::format("frame {} xxh3 {}\n", record.frame, hash_text(record.hash));
}

std::string json_line(const FrameRecord& record) {
  Json json;
  json["frame"] = record.frame;
  json["t_s"] = record.t_s;
  json["size"] = {record.width_px, record.height_px};
  json["xxh3"] = hash_text(record.hash);
  json["scene"] = record.scene;
  json["out"] = record.out.empty() ? Json() : Json(record.out);
  json["file_ms"] = record.file_ms < 0.0 ? Json() : Json(std::round(record.file_ms * 1e3) / 1e3);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<FrameHash> parse_frame_line(std::string_view line) {
  return line.starts_with('{') ? parse_json_line(line) : parse_hash_line(line);
}

}  // namespace swell::apps
