#include "texture/image/program_folder.h"

#include <dlfcn.h>
#include <link.h>

#include "texture/image/image_codec.h"

namespace swell::texture {

std::filesystem::path folder_of_this_code() {
  static const char here = 0;
  Dl_info info{};
  link_map* object = nullptr;
  const int found = dladdr1(&here, &info, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP);
  if (found != 0 && object->l_name[0] != '\0')
    return std::filesystem::path(object->l_name).parent_path();
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

std::array<std::filesystem::path, 2> places_beside_program(std::string_view file) {
  const std::filesystem::path folder = folder_of_this_code();
  return {(folder / "../lib/swell" / file).lexically_normal(), folder / file};
}

std::filesystem::path folder_of_image_codec() {
  Dl_info info{};
  if (dladdr(&image_codec(), &info) == 0) return {};
  return std::filesystem::path(info.dli_fname).parent_path();
}

}  // namespace swell::texture
