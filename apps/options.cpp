#include "apps/options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "math/simd_target.h"

namespace swell::apps {
namespace {

constexpr int kMaxSidePx = 8192;
constexpr int kMaxFrame = 9999999;

[[noreturn]] void refuse(std::string_view option, std::string_view got, std::string_view allowed) {
  throw OptionError(fmt::format("command line: {}: got '{}', allowed {}", option, got, allowed));
}

// The whole of `text` as a number, or nothing. Does not depend on the locale.
template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "AxB" with the given separator as two integers, each in [low, high].
std::optional<std::pair<int, int>> parse_pair(std::string_view text, char separator, int low,
                                              int high) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string_view::npos) return std::nullopt;
  const auto a = parse<int>(text.substr(0, middle)), b = parse<int>(text.substr(middle + 1));
  if (!a || !b || *a < low || *a > high || *b < low || *b > high) return std::nullopt;
  return std::pair(*a, *b);
}

}  // namespace

void add_standard_options(CLI::App& app) {
  app.set_version_flag("--version", fmt::format("{} {}", app.get_name(), version()));
}

void add_frame_setup(CLI::App& app, FrameSetup& setup) {
  app.add_option("--scene", setup.scene_path, "Scene file (TOML)")->required()->type_name("FILE");
  app.add_option_function<std::string>(
         "--size", [&setup](const std::string& text) { setup.size = parse_size(text); },
         "Picture size in pixels")
      ->type_name("WxH")
      ->default_str("1280x720");
  add_machine_options(app, setup.threads, setup.simd);
}

void add_machine_options(CLI::App& app, int& threads, std::string& simd) {
  add_integer(app, "--threads", threads, 1, 256, "Threads; changes no pixel");
  app.add_option("--simd", simd, "avx2 or avx512; changes no pixel")->type_name("TARGET");
}

void add_quality_options(CLI::App& app, render::FrameOptions& frame) {
  app.add_option_function<std::string>(
         "--tile",
         [&frame](const std::string& text) {
           const int size = parse<int>(text).value_or(0);
           if (size != 16 && size != 32 && size != 64) refuse("--tile", text, "16, 32 or 64");
           frame.tile_size_px = size;
         },
         "Tile size in pixels: 16, 32 or 64; changes no pixel")
      ->default_str("64");
  add_integer(app, "--triangles", frame.water_triangles, 2, 1000000,
              "Triangles of the water instead of the scene's");
  add_integer(app, "--terrain-triangles", frame.terrain_triangles, 2, 1000000,
              "Triangles of the terrain instead of the scene's");
  add_number(
      app, "--lookup-scale", frame.lookup_scale, 0.1, 1.0,
      "Size of reflection and refraction images against the picture, instead of the scene's");
  add_number(app, "--background-error", frame.background_error_px, 1e-3, 8.0,
             "Pixels by which far water may lie off for waves left out, instead of the scene's");
  add_number(app, "--picture-scale", frame.picture_scale, 0.1, 1.0,
             "Draw at this share of the size and enlarge: faster, less sharp");
  app.add_flag("--wireframe", frame.wireframe, "Draw triangle edges");
}

void add_integer(CLI::App& app, const std::string& name, int& value, int low, int high,
                 const std::string& help) {
  const auto store = [&value, name, low, high](const std::string& text) {
    const auto number = parse<int>(text);
    if (!number || *number < low || *number > high)
      refuse(name, text, fmt::format("whole numbers from {} to {}", low, high));
    value = *number;
  };
  auto* option = app.add_option_function<std::string>(name, store, help)->type_name("N");
  if (value >= low) option->default_str(fmt::format("{}", value));
}

void add_number(CLI::App& app, const std::string& name, double& value, double low, double high,
                const std::string& help) {
  const auto store = [&value, name, low, high](const std::string& text) {
    const auto number = parse<double>(text);
    if (!number || !std::isfinite(*number) || *number < low || *number > high)
      refuse(name, text, fmt::format("numbers from {} to {}", low, high));
    value = *number;
  };
  auto* option = app.add_option_function<std::string>(name, store, help)->type_name("X");
  if (value >= low) option->default_str(fmt::format("{}", value));
}

bool parse_command_line(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::Success& request) {  // --help, --version
    app.exit(request);
    return false;
  } catch (const CLI::ParseError& e) {
    throw OptionError(fmt::format("command line: {}", e.what()));
  }
}

void select_simd(std::string_view name) {
  if (name.empty()) return;
  for (const SimdTarget target : {SimdTarget::kAvx2, SimdTarget::kAvx512}) {
    if (name != simd_target_name(target)) continue;
    if (!simd_target_available(target)) refuse("--simd", name, "avx2 on this CPU");
    select_simd_target(target);
    return;
  }
  refuse("--simd", name, "avx2 or avx512");
}

PictureSize parse_size(std::string_view text) {
  const auto size = parse_pair(text, 'x', 1, kMaxSidePx);
  if (!size) refuse("--size", text, fmt::format("1x1 to {0}x{0}", kMaxSidePx));
  return {size->first, size->second};
}

FrameRange parse_frame_range(std::string_view text) {
  const auto range = parse_pair(text, '-', 0, kMaxFrame);
  if (!range || range->first > range->second)
    refuse("--frames", text, fmt::format("A-B with 0 <= A <= B <= {}", kMaxFrame));
  return {range->first, range->second};
}

}  // namespace swell::apps
