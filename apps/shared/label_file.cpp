#include "apps/shared/label_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "apps/shared/output_file.h"
#include "apps/shared/picture_file.h"
#include "texture/image.h"
#include "texture/image_io.h"
#include "texture/npy.h"

namespace swell::apps {
namespace {

namespace fs = std::filesystem;
using render::Label;

// A plane for each component of vectors.
template <class Vector>
void add_components(const render::LabelInfo& info, std::span<const Vector> vectors,
                    std::vector<LabelPlane>& planes) {
  for (std::size_t c = 0; c < info.plane_count(); ++c) {
    std::vector<float> samples(vectors.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples[i] = static_cast<float>(vectors[i][static_cast<glm::length_t>(c)]);
    planes.push_back({std::string(info.planes[c]), std::move(samples)});
  }
}

// What follows from the depth: distances, places.
template <class Value, class OfDepth>
std::vector<Value> from_depth(std::span<const float> depth_m, const View& view,
                              const OfDepth& of_depth) {
  std::vector<Value> values;
  values.reserve(depth_m.size());
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const int x_px = static_cast<int>(i) % view.width_px;
    const int y_px = static_cast<int>(i) / view.width_px;
    values.push_back(static_cast<Value>(of_depth(view, x_px, y_px, depth_m[i])));
  }
  return values;
}

void add_planes(const render::LabelInfo& info, const render::Labels& labels, const View& view,
                std::vector<LabelPlane>& planes) {
  const auto add = [&](auto samples) {
    planes.push_back({std::string(info.planes[0]), std::move(samples)});
  };
  switch (info.label) {
    case Label::kDepth:
      return add(labels.depth_m);
    case Label::kDistance:
      return add(from_depth<float>(labels.depth_m, view, render::distance_of));
    case Label::kPosition:
      return add_components<glm::dvec3>(
          info, from_depth<glm::dvec3>(labels.depth_m, view, render::position_of), planes);
    case Label::kNormal:
      return add_components<glm::vec3>(info, labels.normal, planes);
    case Label::kGeometricNormal:
      return add_components<glm::vec3>(info, labels.geometric_normal, planes);
    case Label::kId:
      return add(labels.id);
    case Label::kClass:
      return add(labels.klass);
    case Label::kMotion:
      return add_components<glm::vec2>(info, labels.motion_px, planes);
    case Label::kElevation:
      return add(labels.elevation_m);
    case Label::kFoam:
      return add(labels.foam);
    case Label::kFlags:
      return add(std::vector<std::uint32_t>(labels.flags.begin(), labels.flags.end()));
  }
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
