// Labels as files: channels of EXR files, and depth and ids alone as PNG or NumPy arrays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "math/view.h"
#include "render/frame.h"
#include "texture/image/exr_channels.h"

namespace swell::apps {

// "depth,id" or "all"; nothing for a name that render::label_table() does not have, or none.
std::optional<render::LabelSet> parse_labels(std::string_view text);

// "depth, distance, ... or all", as allowed values.
std::string label_names();

// One channel of a file: values row by row.
struct LabelPlane {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::uint32_t>> samples;
};

// The planes of the labels that are to be written, in the table's order. All of these are in
// labels.set; the view is the frame's.
std::vector<LabelPlane> label_planes(const render::Labels& labels, render::LabelSet written,
                                     const View& view);

// Linear light as R, G and B.
std::vector<LabelPlane> colour_planes(const render::Target& target);

// Planes of the size as one EXR file. Throws texture::FileError.
std::vector<std::uint8_t> encode_planes(int width_px, int height_px,
                                        std::span<const LabelPlane> planes,
                                        const texture::ImageExtras& extras);

// Writes it. Throws texture::FileError, and leaves no half file.
void write_planes(const std::filesystem::path& path, int width_px, int height_px,
                  std::span<const LabelPlane> planes, const texture::ImageExtras& extras);

// check_output_place() for write_depth() and write_ids(): .png or .npy.
void check_plane_file(const std::filesystem::path& path);

// Depth as float32 metres, the sky infinite (.npy), or as PNG of 16 bits: metres are value / 256,
// rounded to the nearest and no less than 1 / 256, and 0 stands for the sky and for what is beyond
// 255.99 m (as in KITTI's depth maps). Throws texture::FileError, and leaves no half file.
void write_depth(const std::filesystem::path& path, int width_px, int height_px,
                 std::span<const float> depth_m);

// Ids as uint32 (.npy) or PNG of 16 bits. Throws as write_depth().
void write_ids(const std::filesystem::path& path, int width_px, int height_px,
               std::span<const std::uint32_t> ids);

// The 16-bit value of a depth, as write_depth() says.
std::uint16_t depth_word(float depth_m);

}  // namespace swell::apps
