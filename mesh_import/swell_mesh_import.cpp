// swell_mesh_import FILE auto|y|z [PARENT]: reads a mesh file and writes it as flat arrays
// (shapes/flat_mesh.h) to its output. It is run by the library (shapes/run_importer.h), whose
// process PARENT it does not outlive. Exits with 1 and a line on its error output for a file that
// is refused.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "mesh_import/asset_file.h"
#include "mesh_import/asset_textures.h"
#include "mesh_import/flatten_mesh.h"
#include "mesh_import/process_limits.h"
#include "texture/image/image_codec.h"

namespace swell::mesh_import {
namespace {

shapes::FlatMesh import_mesh(const std::filesystem::path& file, scene::UpAxis up) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) throw Refused(error.message());
  if (bytes > shapes::kMostMeshFileBytes) throw Refused("a file of over 512 MiB, allowed 512 MiB");
  LooseMesh loose = read_asset(file, up, allow_memory_for);
  add_normals(loose);
  shapes::FlatMesh flat;
  join_vertices(loose, flat);
  loose.corners = {};
  if (!loose.textures.empty()) load_uncounted([] { texture::image_codec(); });
  flat.textures = decode_textures(loose.textures, std::filesystem::absolute(file).parent_path(),
                                  allow_memory_for);
  add_levels(flat);
  return flat;
}

void write_all(const void* bytes, std::size_t size) {
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = write(STDOUT_FILENO, from, size);
    if (written <= 0) _exit(1);  // nobody reads it any more
    from += written, size -= static_cast<std::size_t>(written);
  }
}

scene::UpAxis axis_of(std::string_view name) {
  if (name == "y") return scene::UpAxis::kY;
  return name == "z" ? scene::UpAxis::kZ : scene::UpAxis::kByFormat;
}

int run(int argc, char** argv) {
  if (argc == 4 && !end_with_parent(std::atoi(argv[3]))) return 1;  // nobody waits for it
  limit_process();
  std::string fault;
  try {
    if (argc != 3 && argc != 4) throw Refused("usage: swell_mesh_import FILE auto|y|z [PARENT]");
    shapes::write_flat_mesh(import_mesh(argv[1], axis_of(argv[2])), write_all);
    return 0;
  } catch (const std::bad_alloc&) {
    fault = fmt::format(
        "a file that takes too much memory to read, allowed {} MB and {} times its "
        "size, at most {} MB",
        kLeastMemory >> 20, kMemoryPerInput, kMostMemory >> 20);
  } catch (const std::exception& error) {
    fault = error.what();
  } catch (...) {
    fault = "a file that cannot be read";
  }
  std::fprintf(stderr, "%s\n", fault.c_str());
  return 1;
}

}  // namespace
}  // namespace swell::mesh_import

#ifdef SWELL_SANITIZED
// OpenImageIO's threads have ended by then, but nobody joins them.
extern "C" const char* __tsan_default_options() { return "report_thread_leaks=0"; }
#endif

// Without the library's last words: what is left in memory goes with the process.
int main(int argc, char** argv) { _exit(swell::mesh_import::run(argc, argv)); }
