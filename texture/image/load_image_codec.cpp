#include <dlfcn.h>
#include <sys/mman.h>

#include <array>

#include "math/parallel.h"
#include "texture/image/file_bytes.h"
#include "texture/image/image_codec.h"
#include "texture/image/program_folder.h"

namespace swell::texture {
namespace {

// Initialisers among the libraries abort the program where they get no memory or no thread.
void check_room() {
  constexpr std::size_t kAddressSpace = 600u << 20;  // of what a load takes
  constexpr int kThreads = 5;                        // that the libraries start
  void* const room =
      mmap(nullptr, kAddressSpace, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED)
    throw std::runtime_error(
        fmt::format("out of memory: reading and writing image files takes {} MB of address space",
                    kAddressSpace >> 20));
  munmap(room, kAddressSpace);
  check_threads(kThreads);
}

const ImageCodec& load() {
  check_room();
  const std::filesystem::path folder = folder_of_this_code();
  const std::array<std::filesystem::path, 3> places = {folder / "../lib/swell" / kImageCodecFile,
                                                       folder / kImageCodecFile, kImageCodecFile};
  for (const std::filesystem::path& place : places) {
    // Not RTLD_NOW, which takes twice as long.
    if (void* const module = dlopen(place.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
      const auto* codec = static_cast<const ImageCodec*>(dlsym(module, kImageCodecSymbol));
      if (codec && codec->version == kImageCodecVersion) return *codec;
      fail(place, "not the image module of this version of Swell");
    }
    const std::string fault = dlerror();
    if (!fault.starts_with(place.string() + ": cannot open"))  // it is there
      throw std::runtime_error("cannot load the module for image files: " + one_line(fault));
  }
  fail(kImageCodecFile,
       "the module for image files is not beside the program nor in {}; the Debian package "
       "swell-images has it",
       (folder / "../lib/swell").lexically_normal().string());
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec& codec = load();
  return codec;
}

}  // namespace swell::texture
