#include "tools/maps/make_map.h"

#include <fmt/core.h>

#include "apps/shared/options.h"
#include "apps/shared/output_file.h"
#include "math/elementary.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

// A picture's first channel, its upper rows north.
void start_from_picture(const std::string& path, ocean::MapRecipe& recipe) {
  const texture::ImageF image = texture::read_image(path, {.max_side_px = ocean::kMaxMapSize});
  if (image.width != image.height)
    throw OptionError(
        fmt::format("command line: --start, got a picture of {} x {}, allowed square "
                    "ones",
                    image.width, image.height));
  recipe.first = ocean::FirstDisturbance::kHeights;
  recipe.size = image.width;
  for (int j = image.height - 1; j >= 0; --j)
    for (int i = 0; i < image.width; ++i) recipe.heights.push_back(image.at(i, j, 0));
}

ocean::MapRecipe recipe_of(const MapOptions& options) {
  ocean::MapRecipe recipe = options.recipe;
  recipe.to_rad = (options.wind_from_deg + 180.0) * kPi / 180.0;
  recipe.seed = static_cast<std::uint64_t>(options.seed);
  if (options.start == "drops")
    recipe.first = ocean::FirstDisturbance::kDrops;
  else if (options.start != "gusts")
    start_from_picture(options.start, recipe);
  return recipe;
}

}  // namespace

void add_map_options(CommandLine& line, MapOptions& options) {
  ocean::MapRecipe& recipe = options.recipe;
  line.add_text("--make-map", "FILE", options.file,
                "Write a periodic map for [[sea.maps]]; needs no scene");
  line.add_text("--start", "WHAT", options.start,
                "What disturbs the map first: gusts, drops, or a square picture of heights");
  add_integer(line, "--map-size", recipe.size, ocean::kMinMapSize, ocean::kMaxMapSize,
              "Its samples a side, a power of two; a picture's are its own");
  add_integer(line, "--map-frames", recipe.frames, ocean::kMinMapFrames, ocean::kMaxMapFrames,
              "Frames of its loop");
  add_integer(line, "--map-bits", recipe.bits, 8, 16, "Of a sample, 8 or 16");
  add_number(line, "--courant", recipe.courant, 0.0, 10.0,
             "Cells that its waves run in a step, two steps a frame; at most 0.866");
  add_number(line, "--wind-from", options.wind_from_deg, -360.0, 360.0,
             "Where the wind of gusts comes from, degrees clockwise from north");
  add_number(line, "--peak-waves", recipe.peak_waves, 1.0, ocean::kMaxMapSize / 8,
             "Waves of gusts a side, where they are highest");
  add_integer(line, "--seed", options.seed, 0, 1'000'000'000, "Another number, another map");
}

void make_map(const MapOptions& options) {
  check_output_place(options.file);
  const ocean::PeriodicMap map = ocean::make_periodic_map(recipe_of(options));
  const std::vector<std::uint8_t> bytes = ocean::encode_map(map);
  write_output(options.file, bytes);
  fmt::print("{}: {} frames of {} x {}, {} bits, {:.1f} MB; its waves run {:.3g} sides a loop\n",
             options.file, map.frames, map.size, map.size, map.bits,
             1e-6 * static_cast<double>(bytes.size()), map.travel);
}

}  // namespace swell::apps
