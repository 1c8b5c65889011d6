// EXR files of many channels, for labelled pictures: colour beside depth, places, normals, motion
// and the numbers of objects.
//
//   const texture::ExrChannel channels[] = {{"Z", depth_m}, {"id", ids}};
//   texture::write_file("a.exr", texture::encode_exr(640, 480, channels));
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "texture/image/image_note.h"

namespace swell::texture {

// One channel: a name ("R", "Z", "N.X", "id"), and width * height samples row by row, the first row
// on top. They are stored with all their bits as FLOAT or UINT: infinities, and whole numbers to
// 2^32 - 1. (Readers that go through float have whole numbers exactly to 2^24, through half to
// 2^11.)
struct ExrChannel {
  std::string name;
  std::variant<std::span<const float>, std::span<const std::uint32_t>> samples;
};

// Encodes the channels, at least one, as one part of scan lines. Names are unique and not empty. In
// the file channels stand in the order of their names; readers may show them in another one: look
// them up by name. The same input gives the same bytes. Throws FileError.
std::vector<std::uint8_t> encode_exr(int width, int height, std::span<const ExrChannel> channels,
                                     const ImageExtras& extras = {});

}  // namespace swell::texture
