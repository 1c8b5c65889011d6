#include "apps/shared/label_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "apps/shared/output_file.h"
#include "apps/shared/picture_file.h"
#include "texture/image/image.h"
#include "texture/image/image_io.h"
#include "texture/image/npy.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;

// One plane of the label's numbers ...
template <class Number>
void add_values(const render::LabelInfo& info, const std::vector<Number>& values,
                std::vector<LabelPlane>& planes) {
  using Written = std::conditional_t<std::is_integral_v<Number>, std::uint32_t, float>;
  std::vector<Written> samples;
  samples.reserve(values.size());
  for (const Number value : values) samples.push_back(static_cast<Written>(value));
  planes.push_back({std::string(info.planes[0]), std::move(samples)});
}

// ... or one for each component of its vectors.
template <glm::length_t kSize, class Number>
void add_values(const render::LabelInfo& info, const std::vector<glm::vec<kSize, Number>>& vectors,
                std::vector<LabelPlane>& planes) {
  for (std::size_t c = 0; c < info.plane_count(); ++c) {
    std::vector<float> samples(vectors.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples[i] = static_cast<float>(vectors[i][static_cast<glm::length_t>(c)]);
    planes.push_back({std::string(info.planes[c]), std::move(samples)});
  }
}

void add_planes(const render::LabelInfo& info, const render::Labels& labels, const View& view,
                std::vector<LabelPlane>& planes) {
  const auto add = [&](const auto values) {
    if constexpr (std::is_member_pointer_v<decltype(values)>)
      add_values(info, labels.*values, planes);
    else
      add_values(info, render::from_depth(view, labels.depth_m, values), planes);
  };
  std::visit(add, info.values);
}

void write_words(const fs::path& path, int width_px, int height_px,
                 std::vector<std::uint16_t> words) {
  const texture::Image16 image{width_px, height_px, 1, std::move(words)};
  write_output(path, texture::encode_image(image, ".png"));
}

}  // namespace

std::optional<render::LabelSet> parse_labels(std::string_view text) {
  if (text == "all") return render::LabelSet::all();
  render::LabelSet set;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const render::LabelInfo* info = render::find_label(text.substr(begin, end - begin));
    if (!info) return std::nullopt;
    set.add(info->label);
    begin = end + 1;
  }
  return set;
}

std::string label_names() {
  std::string names;
  for (const render::LabelInfo& info : render::label_table())
    names += fmt::format("{}, ", info.name);
  return names.substr(0, names.size() - 2) + " or all";
}

std::vector<LabelPlane> label_planes(const render::Labels& labels, render::LabelSet written,
                                     const View& view) {
  std::vector<LabelPlane> planes;
  for (const render::LabelInfo& info : render::label_table())
    if (written.has(info.label)) add_planes(info, labels, view, planes);
  return planes;
}

std::vector<LabelPlane> colour_planes(const render::Target& target) {
  std::vector<LabelPlane> planes;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float> samples(target.linear.size() / 3);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = target.linear[3 * i + c];
    planes.push_back({std::string(1, "RGB"[c]), std::move(samples)});
  }
  return planes;
}

std::vector<std::uint8_t> encode_planes(int width_px, int height_px,
                                        std::span<const LabelPlane> planes,
                                        const texture::ImageExtras& extras) {
  std::vector<texture::ExrChannel> channels;
  for (const LabelPlane& plane : planes)
    std::visit(
        [&](const auto& samples) {
          channels.push_back({plane.name, samples});
        },
        plane.samples);
  return texture::encode_exr(width_px, height_px, channels, extras);
}

void write_planes(const fs::path& path, int width_px, int height_px,
                  std::span<const LabelPlane> planes, const texture::ImageExtras& extras) {
  write_output(path, encode_planes(width_px, height_px, planes, extras));
}

void check_plane_file(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".png" && extension != ".npy")
    throw texture::FileError(fmt::format("{}: format of a label, got '{}', allowed .png .npy",
                                         path.string(), extension));
  check_output_place(path);
}

void write_depth(const fs::path& path, int width_px, int height_px,
                 std::span<const float> depth_m) {
  if (lower_extension(path) == ".npy")
    return write_output(path, texture::encode_npy(depth_m, height_px, width_px));
  std::vector<std::uint16_t> words;
  for (const float depth : depth_m) words.push_back(depth_word(depth));
  write_words(path, width_px, height_px, std::move(words));
}

void write_ids(const fs::path& path, int width_px, int height_px,
               std::span<const std::uint32_t> ids) {
  if (lower_extension(path) == ".npy")
    return write_output(path, texture::encode_npy(ids, height_px, width_px));
  write_words(path, width_px, height_px, {ids.begin(), ids.end()});
}

std::uint16_t depth_word(float depth_m) {
  constexpr float kWordsPerMetre = 256.0f, kMost = 65535.0f;
  const float word = std::round(depth_m * kWordsPerMetre);
  if (!(word <= kMost)) return 0;
  return static_cast<std::uint16_t>(std::max(word, 1.0f));
}

}  // namespace swell::apps
