#include "tools/maps/make_boundary.h"

#include <fmt/core.h>

#include "apps/shared/options.h"
#include "apps/shared/output_file.h"
#include "scene/check_scene.h"
#include "scene/coast.h"
#include "scene/terrain.h"
#include "terrain/boundary.h"
#include "texture/image/image_io.h"

namespace swell::apps {

void add_boundary_options(CommandLine& line, BoundaryOptions& options) {
  line.add_text("--make-boundary", "FILE.exr", options.file,
                "Write the water boundary of the scene's terrain for terrain.boundary, and time "
                "nothing");
  line.add_text("--bank-normals", "FILE.png", options.bank_normals,
                "Write the normals of that boundary's banks and floor, too: east, north and up as "
                "red, green and blue");
  add_scene_options(line, options.scene);
}

void make_boundary(const BoundaryOptions& options, int threads) {
  if (!options.file.ends_with(".exr"))
    throw OptionError(
        fmt::format("command line: --make-boundary, got '{}', allowed .exr files", options.file));
  if (options.scene.path.empty())
    throw OptionError("command line: --scene, got none, allowed a scene file with a terrain");
  if (!options.bank_normals.empty() && !options.bank_normals.ends_with(".png"))
    throw OptionError(fmt::format("command line: --bank-normals, got '{}', allowed .png files",
                                  options.bank_normals));
  check_output_place(options.file);
  if (!options.bank_normals.empty()) check_output_place(options.bank_normals);
  const scene::Scene scene = load_scene(options.scene);
  const auto land = scene::build_terrain(scene);
  if (!land)
    throw OptionError(
        fmt::format("command line: --scene, got {}, which has no terrain, allowed "
                    "one with it",
                    options.scene.path));
  const terrain::ShoreMap shore = *scene::build_shore(scene, &*land, threads);
  write_output(options.file, texture::encode_image(terrain::boundary_image(shore), ".exr"));
  if (!options.bank_normals.empty())
    write_output(options.bank_normals, texture::encode_image(terrain::bank_normals(shore), ".png"));
  const terrain::Grid& grid = shore.grid();
  fmt::print("{}: {} x {} points {:.4g} m apart, {:.4g} m a side from east {:g}, north {:g}\n",
             options.file, grid.samples_x, grid.samples_y, grid.spacing_m, grid.size_m(),
             grid.min_world.x, grid.min_world.y);
}

}  // namespace swell::apps
