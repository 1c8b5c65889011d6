#include "apps/shared/label_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <variant>

#include "math/elementary.h"

namespace swell::apps {
namespace {

constexpr double kFarthest_m = 1e4, kStripes_m = 100.0, kHighest_m = 4.0;
constexpr double kLongest_px = 64.0, kShortest_px = 0.01;  // of motion

// Components in [0, 1].
std::uint32_t pack(glm::dvec3 rgb) {
  const glm::dvec3 bytes = glm::clamp(rgb, 0.0, 1.0) * 255.0 + 0.5;
  return static_cast<std::uint32_t>(bytes.r) | static_cast<std::uint32_t>(bytes.g) << 8 |
         static_cast<std::uint32_t>(bytes.b) << 16 | 0xff000000u;
}

std::uint32_t grey(double share) { return pack(glm::dvec3(share)); }

// Returns a colour of full value. saturation: in [0, 1]. hue: in turns from red, green at a third,
// blue at two thirds.
glm::dvec3 hue_rgb(double hue, double saturation) {
  const auto channel = [&](double at) {
    const double turns = hue - at, away = std::abs(turns - std::floor(turns + 0.5));
    return 1.0 - saturation * std::clamp(6.0 * away - 1.0, 0.0, 1.0);
  };
  return {channel(0.0), channel(1.0 / 3.0), channel(2.0 / 3.0)};
}

double height_share(double height_m) { return 0.5 + 0.5 * height_m / kHighest_m; }

double stripe(double metres) {
  const double periods = metres / kStripes_m;
  return 2.0 * std::abs(periods - std::floor(periods + 0.5));
}

}  // namespace

std::uint32_t depth_colour(float depth_m) {
  const double depth = std::clamp(static_cast<double>(depth_m), 1.0, kFarthest_m);
  return grey(1.0 - log(depth) / log(kFarthest_m));
}

std::uint32_t position_colour(glm::dvec3 p_world) {
  if (!std::isfinite(p_world.x + p_world.y + p_world.z)) return grey(0.0);
  return pack({stripe(p_world.x), stripe(p_world.y), height_share(p_world.z)});
}

std::uint32_t normal_colour(glm::vec3 normal) {
  return normal == glm::vec3(0.0f) ? grey(0.0) : pack(0.5 + 0.5 * glm::dvec3(normal));
}

std::uint32_t number_colour(std::uint32_t number) {
  constexpr std::array<glm::dvec3, 5> kFirst = {
      glm::dvec3(0.0), {0.1, 0.35, 0.8}, {0.4, 0.6, 0.2}, {0.9, 0.2, 0.15}, {0.95, 0.95, 0.95}};
  if (number < kFirst.size()) return pack(kFirst[number]);
  constexpr double kGoldenTurn = 0.61803398874989485;  // neighbours are far apart, none come back
  const double hue = number * kGoldenTurn;
  const double value = 1.0 - 0.2 * (number / 2 % 3);
  return pack(value * hue_rgb(hue - std::floor(hue), number % 2 == 0 ? 0.9 : 0.5));
}

std::uint32_t motion_colour(glm::vec2 motion_px) {
  const double x = motion_px.x, y = motion_px.y;
  const double length_px = std::hypot(x, y);
  if (!(length_px > 0.0)) return grey(0.0);
  const double share = log(1.0 + std::min(length_px, kLongest_px) / kShortest_px) /
                       log(1.0 + kLongest_px / kShortest_px);
  return pack(share * hue_rgb(atan2(-y, x) / (2.0 * kPi), 1.0));
}

std::uint32_t elevation_colour(float elevation_m) {
  return grey(height_share(static_cast<double>(elevation_m)));
}

std::uint32_t share_colour(float share) { return grey(static_cast<double>(share)); }

std::uint32_t flags_colour(std::uint8_t flags) {
  return pack({0.0, (flags & render::kShowsRefracted) != 0 ? 1.0 : 0.0,
               (flags & render::kShowsMirrored) != 0 ? 1.0 : 0.0});
}

namespace {

std::uint32_t colour_of(render::LabelLook look, float value) {
  switch (look) {
    case render::LabelLook::kHeight:
      return elevation_colour(value);
    case render::LabelLook::kShare:
      return share_colour(value);
    default:
      return depth_colour(value);
  }
}

std::uint32_t colour_of(render::LabelLook, double value) {
  return depth_colour(static_cast<float>(value));
}
std::uint32_t colour_of(render::LabelLook, std::uint32_t value) { return number_colour(value); }
std::uint32_t colour_of(render::LabelLook, std::uint8_t value) { return flags_colour(value); }
std::uint32_t colour_of(render::LabelLook, glm::vec2 value) { return motion_colour(value); }
std::uint32_t colour_of(render::LabelLook, glm::vec3 value) { return normal_colour(value); }
std::uint32_t colour_of(render::LabelLook, glm::dvec3 value) { return position_colour(value); }

}  // namespace

void paint_label(render::Label label, const render::Labels& labels, const View& view,
                 std::vector<std::uint32_t>& rgba) {
  const render::LabelInfo& info = render::label_table()[static_cast<std::size_t>(label)];
  const auto paint = [&](const auto& values) {
    rgba.clear();
    for (const auto& value : values) rgba.push_back(colour_of(info.look, value));
  };
  std::visit(
      [&](const auto values) {
        if constexpr (std::is_member_pointer_v<decltype(values)>)
          paint(labels.*values);
        else
          paint(render::from_depth(view, labels.depth_m, values));
      },
      info.values);
}

}  // namespace swell::apps
