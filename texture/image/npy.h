// NumPy's file format, for arrays of labels that programs read: numpy.load("depth.npy").
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace swell::texture {

using NpySamples = std::variant<std::span<const float>, std::span<const std::uint32_t>,
                                std::span<const std::uint16_t>, std::span<const std::uint8_t>>;

// Encodes height * width samples, row by row, as an array of shape (height, width); or, with
// channels > 0, height * width * channels interleaved ones as one of shape (height, width,
// channels). All bits are kept. texture::write_file() writes what it returns.
// Source: NumPy, numpy.lib.format, "Format Version 1.0".
std::vector<std::uint8_t> encode_npy(NpySamples samples, int height, int width, int channels = 0);

}  // namespace swell::texture
