// Pictures on meshes, decoded.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "mesh_import/asset_file.h"

namespace swell::mesh_import {

// PNG, JPEG, TIFF, HDR, EXR and PNM. A picture outside `folder` is refused, as are too many texels
// in all. Throws Refused.
std::vector<shapes::FlatTexture> decode_textures(std::span<const TextureSource> sources,
                                                 const std::filesystem::path& folder,
                                                 const InputCounter& count_inputs = ignore_inputs);

}  // namespace swell::mesh_import
