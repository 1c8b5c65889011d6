#include "apps/shared/options.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "apps/shared/label_file.h"
#include "apps/shared/parse_number.h"
#include "apps/shared/picture_file.h"
#include "math/simd_target.h"
#include "render/world/part_cache.h"
#include "scene/scene_error.h"

namespace swell::apps {
namespace {

constexpr int kMaxSidePx = 8192;
constexpr int kMaxFrame = 9999999;

[[noreturn]] void refuse_value(std::string_view option, std::string_view got,
                               std::string_view allowed) {
  throw OptionError(fmt::format("command line: {}: got '{}', allowed {}", option,
                                scene::shortened(got), allowed));
}

// As the help shows it; nothing for a value below `low`, which means "not given".
template <class Number>
std::string default_text(Number value, Number low) {
  return value >= low ? fmt::format("{}", value) : std::string();
}

// "avx2 or avx512".
std::string simd_names() {
  std::string names;
  for (const SimdTarget target : simd_targets()) {
    if (!names.empty()) names += " or ";
    names += simd_target_name(target);
  }
  return names;
}

// "AxB" with the given separator as two integers, each in [low, high].
std::optional<std::pair<int, int>> parse_pair(std::string_view text, char separator, int low,
                                              int high) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string_view::npos) return std::nullopt;
  const auto a = parse_number<int>(text.substr(0, middle)),
             b = parse_number<int>(text.substr(middle + 1));
  if (!a || !b || *a < low || *a > high || *b < low || *b > high) return std::nullopt;
  return std::pair(*a, *b);
}

}  // namespace

void add_scene_options(CommandLine& line, SceneChoice& scene) {
  line.add_text("--scene", "FILE", scene.path, "Scene file (TOML or JSON)");
  line.add_texts("--set", "KEY=VALUE", scene.settings,
                 "Give a key of the scene another value, as wind.speed_mps=12 or "
                 "object[0].heading_deg=90; any number of times");
}

void add_frame_setup(CommandLine& line, FrameSetup& setup) {
  add_scene_options(line, setup.scene);
  line.add_value({"--size", "WxH", "1280x720", "Picture size in pixels",
                  [&setup](const std::string& text) { setup.size = parse_size(text); }});
  add_machine_options(line, setup.threads, setup.simd);
}

void add_required_frame_setup(CommandLine& line, FrameSetup& setup) {
  add_frame_setup(line, setup);
  line.require("--scene");
}

void add_machine_options(CommandLine& line, int& threads, std::string& simd) {
  add_integer(line, "--threads", threads, 1, 256, "Threads; changes no pixel");
  line.add_text("--simd", "TARGET", simd, simd_names() + "; changes no pixel");
}

void add_cache_option(CommandLine& line, std::filesystem::path& folder) {
  const auto take = [&folder](const std::string& text) {
    folder = text == "off" ? std::filesystem::path() : std::filesystem::absolute(text);
  };
  if (const char* const text = std::getenv("SWELL_CACHE"); text != nullptr && text[0] != '\0')
    take(text);
  else
    folder = render::default_cache_folder();
  line.add_value(
      {"--cache", "FOLDER", "",
       "Where to keep what scenes are made into, for later runs (2 GB at most), or off; else "
       "SWELL_CACHE, or swell in the user's caches; changes no pixel",
       take});
}

void add_json_option(CommandLine& line, std::string& path) {
  line.add_text("--json", "FILE", path, "Write the numbers as JSON; - is standard output");
}

void add_quality_options(CommandLine& line, render::FrameOptions& frame) {
  const auto take_tile = [&frame](const std::string& text) {
    const int size = parse_number<int>(text).value_or(0);
    if (size != 16 && size != 32 && size != 64) refuse_value("--tile", text, "16, 32 or 64");
    frame.tile_size_px = size;
  };
  line.add_value(
      {"--tile", "", "64", "Tile size in pixels: 16, 32 or 64; changes no pixel", take_tile});
  add_integer(line, "--triangles", frame.water_triangles, 2, 1000000,
              "Triangles of the water instead of the scene's");
  add_integer(line, "--terrain-triangles", frame.terrain_triangles, 2, 1000000,
              "Triangles of the terrain instead of the scene's");
  add_number(
      line, "--lookup-scale", frame.lookup_scale, 0.1, 1.0,
      "Size of reflection and refraction images against the picture, instead of the scene's");
  add_number(line, "--background-error", frame.background_error_px, 0.0, 8.0,
             "Pixels by which far water may lie off for waves left out, instead of the scene's");
  add_number(line, "--picture-scale", frame.picture_scale, 0.1, 1.0,
             "Draw at this share of the size and enlarge: faster, less sharp; not for .exr");
  const auto take_samples = [&frame](const std::string& text) {
    const int samples = parse_number<int>(text).value_or(-1);
    if (samples != 0 && samples != 4 && samples != 8)
      refuse_value("--edge-samples", text, "0, 4 or 8");
    frame.edge_samples = samples;
  };
  line.add_value({"--edge-samples", "N", "",
                  "Samples a pixel where surfaces meet, 0, 4 or 8, instead of the scene's",
                  take_samples});
  const auto take_shading = [&frame](const std::string& text) {
    if (text != "adaptive" && text != "full") refuse_value("--shading", text, "adaptive or full");
    frame.shading = text == "full" ? scene::ShadingRate::kFull : scene::ShadingRate::kAdaptive;
  };
  line.add_value({"--shading", "RATE", "",
                  "Shade pixels where neighbours differ (adaptive) or all of them (full), instead "
                  "of the scene's",
                  take_shading});
  line.add_flag("--wireframe", frame.wireframe, "Draw triangle edges; not for .exr");
  add_without_option(line, frame.without);
}

void add_without_option(CommandLine& line, render::PartSet& without) {
  const std::string names = fmt::format("{}", fmt::join(render::kPartNames, ", "));
  const auto take_parts = [&without, names](const std::string& text) {
    const auto parts = render::parse_parts(text);
    if (!parts) refuse_value("--without", text, names + ", with commas");
    without = *parts;
  };
  line.add_value(
      {"--without", "LIST", "", "Leave these parts of the picture out, of " + names, take_parts});
}

void add_labels_option(CommandLine& line, render::LabelSet& labels, const std::string& help) {
  const auto take_labels = [&labels](const std::string& text) {
    const auto wanted = parse_labels(text);
    if (!wanted) refuse_value("--labels", text, label_names() + ", with commas");
    labels = *wanted;
  };
  line.add_value({"--labels", "LIST", "", help + "; LIST is of " + label_names(), take_labels});
}

void check_labels_scale(render::LabelSet labels, const render::FrameOptions& frame) {
  if (!labels.empty() && frame.picture_scale != 1.0)
    throw OptionError("command line: --picture-scale, got it with labels, allowed 1 with them");
}

void check_linear_light(const render::FrameOptions& frame, std::string_view option,
                        const std::string& file) {
  if (!stores_linear_light(file)) return;
  const auto refuse_with_file = [&](std::string_view name, std::string_view allowed) {
    throw OptionError(fmt::format("command line: {}, got it with {} '{}', allowed {} .exr files",
                                  name, option, file, allowed));
  };
  if (frame.picture_scale != 1.0) refuse_with_file("--picture-scale", "1 with");
  if (frame.wireframe) refuse_with_file("--wireframe", "without");
}

void add_integer(CommandLine& line, const std::string& name, int& value, int low, int high,
                 const std::string& help) {
  const auto store = [&value, name, low, high](const std::string& text) {
    const auto number = parse_number<int>(text);
    if (!number || *number < low || *number > high)
      refuse_value(name, text, fmt::format("whole numbers from {} to {}", low, high));
    value = *number;
  };
  line.add_value({name, "N", default_text(value, low), help, store});
}

void add_number(CommandLine& line, const std::string& name, double& value, double low, double high,
                const std::string& help) {
  const auto store = [&value, name, low, high](const std::string& text) {
    const auto number = parse_number<double>(text);
    if (!number || !std::isfinite(*number) || *number < low || *number > high)
      refuse_value(name, text, fmt::format("numbers from {} to {}", low, high));
    value = *number;
  };
  line.add_value({name, "X", default_text(value, low), help, store});
}

void select_simd(std::string_view name) {
  if (name.empty()) return;
  for (const SimdTarget target : simd_targets()) {
    if (name != simd_target_name(target)) continue;
    if (!simd_target_available(target))
      refuse_value("--simd", name,
                   fmt::format("{} on this CPU", simd_target_name(simd_targets().front())));
    select_simd_target(target);
    return;
  }
  refuse_value("--simd", name, simd_names());
}

PictureSize parse_size(std::string_view text) {
  const auto size = parse_pair(text, 'x', 1, kMaxSidePx);
  if (!size) refuse_value("--size", text, fmt::format("1x1 to {0}x{0}", kMaxSidePx));
  return {size->first, size->second};
}

FrameRange parse_frame_range(std::string_view text) {
  const auto range = parse_pair(text, '-', 0, kMaxFrame);
  if (!range || range->first > range->second)
    refuse_value("--frames", text, fmt::format("A-B with 0 <= A <= B <= {}", kMaxFrame));
  return {range->first, range->second};
}

}  // namespace swell::apps
