// Command-line options that the programs share. Every fault is an OptionError that names the
// option, what was given and what is allowed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "apps/shared/command_line.h"
#include "apps/shared/notices.h"
#include "apps/shared/program.h"
#include "render/frame.h"

namespace swell::apps {

struct PictureSize {
  int width_px = 1280, height_px = 720;  // each in [1, 8192]
};

// What decides a frame and how it is computed.
struct FrameSetup {
  SceneChoice scene;
  PictureSize size;
  int threads = available_cpus();
  std::string simd;                         // "avx2", "avx512" or empty: the best there is
  std::filesystem::path cache_folder = {};  // add_cache_option()
  render::FrameOptions frame;
};

// --scene and --set.
void add_scene_options(CommandLine& line, SceneChoice& scene);

// --scene, --set, --size, --threads, --simd
void add_frame_setup(CommandLine& line, FrameSetup& setup);

// Adds the options of add_frame_setup(); --scene must be given.
void add_required_frame_setup(CommandLine& line, FrameSetup& setup);

// --tile, --triangles, --terrain-triangles, --lookup-scale, --background-error,
// --picture-scale, --edge-samples, --wireframe, --without
void add_quality_options(CommandLine& line, render::FrameOptions& frame);

// --without LIST
void add_without_option(CommandLine& line, render::PartSet& without);

// --labels LIST; `help` says what becomes of them.
void add_labels_option(CommandLine& line, render::LabelSet& labels, const std::string& help);

// Refuses labels of a picture that is drawn small.
void check_labels_scale(render::LabelSet labels, const render::FrameOptions& frame);

// Throws OptionError for what a file of linear light (.exr) does not show: --picture-scale,
// --wireframe. `option` is the one that names the file.
void check_linear_light(const render::FrameOptions& frame, std::string_view option,
                        const std::string& file);

// --threads and --simd alone.
void add_machine_options(CommandLine& line, int& threads, std::string& simd);

// --cache FOLDER: where parts of worlds are kept for later runs; empty: nowhere. The default is
// what SWELL_CACHE says, or the user's own.
void add_cache_option(CommandLine& line, std::filesystem::path& folder);

// --json: where the numbers go; "-" is standard output, empty nowhere.
void add_json_option(CommandLine& line, std::string& path);

// An option that is a whole number (a finite number) in [low, high]; `value` holds the
// default, which may lie outside to mean "not given".
void add_integer(CommandLine& line, const std::string& name, int& value, int low, int high,
                 const std::string& help);
void add_number(CommandLine& line, const std::string& name, double& value, double low, double high,
                const std::string& help);

// Makes the kernels run on the target named "avx2" or "avx512"; keeps the best one for "".
// Throws OptionError if this CPU does not have it.
void select_simd(std::string_view name);

// "1280x720" -> {1280, 720}.
PictureSize parse_size(std::string_view text);

// "0-99" -> {0, 99}; 0 <= first <= last <= 9999999.
struct FrameRange {
  int first = 0, last = 0;
};
FrameRange parse_frame_range(std::string_view text);

}  // namespace swell::apps
