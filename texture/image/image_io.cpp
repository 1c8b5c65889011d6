#include "texture/image/image_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <string_view>

#include "math/check.h"
#include "math/enum_table.h"
#include "texture/image/file_bytes.h"
#include "texture/image/image_codec.h"
#include "texture/image/image_structure.h"
#include "texture/image/png_file.h"

namespace swell::texture {
namespace {

constexpr std::string_view kReadable = "png, exr, hdr, tif, tiff, ppm, pgm, pbm, pnm";

// The format's name in OpenImageIO for a lower-case extension with its dot; empty if not readable.
std::string_view format_of_extension(std::string_view extension) {
  constexpr std::array<std::array<std::string_view, 2>, 9> kFormats = {{
      {".png", "png"},
      {".exr", "openexr"},
      {".hdr", "hdr"},
      {".tif", "tiff"},
      {".tiff", "tiff"},
      {".ppm", "pnm"},
      {".pgm", "pnm"},
      {".pbm", "pnm"},
      {".pnm", "pnm"},
  }};
  for (const auto& [name, format] : kFormats) {
    if (name == extension) return format;
  }
  return {};
}

// Finds the format's name by the file's first bytes; empty if they are those of no such format.
std::string_view format_of_content(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return "png";
  if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return "openexr";
  if (bytes.starts_with("#?RADIANCE"sv) || bytes.starts_with("#?RGBE"sv)) return "hdr";
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return "tiff";
  const bool pnm = bytes.size() >= 3 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
                   "\n\r\t #"sv.find(bytes[2]) != std::string_view::npos;
  return pnm ? "pnm" : std::string_view{};
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

bool holds_floats(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  return extension == ".exr" || extension == ".hdr";
}

namespace {

std::string_view checked_format(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  const std::string_view format = format_of_extension(extension);
  if (format.empty())
    fail(path, "extension '{}' is not readable, allowed: {}", extension, kReadable);
  return format;
}

void check_content(const std::filesystem::path& path, std::string_view format,
                   std::string_view bytes, const ReadLimits& limits) {
  const std::string_view found = format_of_content(bytes);
  if (found.empty()) fail(path, "the content is no image of: {}", kReadable);
  if (found != format) fail(path, "the extension says {}, the content says {}", format, found);
  if (found == "png") check_png_structure(path, bytes, limits);
  if (found == "pnm") check_pnm_structure(path, bytes);
}

void check_room(CodecResult result) {
  if (result == CodecResult::kNoRoom)
    throw std::runtime_error("no memory or no thread left for reading and writing image files");
}

// Throws unless the codec is done.
void check_result(const std::filesystem::path& path, const char* what, CodecResult result,
                  const std::string& error) {
  check_room(result);
  if (result == CodecResult::kFault) fail(path, "{}: {}", what, error);
}

void check_size(const std::filesystem::path& path, const ImageInfo& info,
                const ReadLimits& limits) {
  if (info.width < 1 || info.height < 1 || info.width > limits.max_side_px ||
      info.height > limits.max_side_px) {
    fail(path, "the size is {}x{}, allowed: 1x1 to {}x{}", info.width, info.height,
         limits.max_side_px, limits.max_side_px);
  }
  if (info.is_deep || info.depth != 1) fail(path, "deep and volume images are not readable");
  if (info.channels < 1 || info.channels > 4) {
    fail(path, "the image has {} channels, allowed: 1 to 4", info.channels);
  }
  const std::uint64_t bytes = std::uint64_t{4} * info.width * info.height * info.channels;
  if (bytes > limits.max_bytes) {
    fail(path, "the image needs {} bytes, allowed: {}", bytes, limits.max_bytes);
  }
}

std::string_view kind_name(SampleKind kind) {
  using enum SampleKind;
  constexpr auto kNames = enum_words<SampleKind>({
      {kUnsigned8, "8-bit unsigned whole numbers"},
      {kUnsigned16, "16-bit unsigned whole numbers"},
      {kUnsigned32, "32-bit unsigned whole numbers"},
      {kUnsigned64, "64-bit unsigned whole numbers"},
      {kSigned8, "8-bit signed whole numbers"},
      {kSigned16, "16-bit signed whole numbers"},
      {kSigned32, "32-bit signed whole numbers"},
      {kSigned64, "64-bit signed whole numbers"},
      {kHalf, "16-bit floats"},
      {kFloat, "32-bit floats"},
      {kDouble, "64-bit floats"},
      {kUnknown, "samples of an unknown kind"},
  });
  return kNames[kind];
}

// Only EXR says what its whole numbers mean: themselves. Those of 8 and 16 bits are shares of the
// largest elsewhere, but of 32 bits, or with a sign, some mean that and some metres. Of TIFFs with
// 64-bit floats OpenImageIO 2.4 reads zeros.
void check_kinds(const std::filesystem::path& path, std::string_view format,
                 const ImageInfo& info) {
  using enum SampleKind;
  for (std::size_t c = 0; c < info.kinds.size(); ++c) {
    const SampleKind kind = info.kinds[c];
    if (kind == kUnsigned8 || kind == kUnsigned16 || kind == kHalf || kind == kFloat) continue;
    if (kind == kUnsigned32 && format == "openexr") continue;
    fail(path,
         "channel {} holds {}, allowed: unsigned whole numbers of 8 or 16 bits, 16 or 32-bit "
         "floats{}",
         c, kind_name(kind), format == "openexr" ? ", unsigned whole numbers of 32 bits" : "");
  }
}

void check_finite(const std::filesystem::path& path, const ImageF& image) {
  const auto bad = std::find_if(image.pixels.begin(), image.pixels.end(),
                                [](float value) { return !std::isfinite(value); });
  if (bad == image.pixels.end()) return;
  const std::ptrdiff_t index = bad - image.pixels.begin();
  const std::ptrdiff_t pixel = index / image.channels;
  fail(path, "pixel ({}, {}) channel {} is {}, allowed: finite numbers", pixel % image.width,
       pixel / image.width, index % image.channels, *bad);
}

ImageF decode(const std::filesystem::path& path, std::string_view format,
              std::span<const char> bytes, const ReadLimits& limits) {
  const ImageCodec& codec = image_codec();
  void* opened = nullptr;
  ImageInfo info;
  std::string error;
  check_result(path, "not a readable file", codec.open(format, bytes, opened, info, error), error);
  const std::unique_ptr<void, void (*)(void*)> closes_it(opened, codec.close);
  check_size(path, info, limits);
  check_kinds(path, format, info);
  ImageF image{info.width, info.height, info.channels, {}};
  image.pixels.resize(std::size_t{1} * info.width * info.height * info.channels);
  const CodecResult result = codec.read(opened, image.pixels, error);
  if (error.empty()) error = "they are not as the file's header says";
  check_result(path, "cannot decode the pixels", result, error);
  check_finite(path, image);
  return image;
}

// --- Encoding

[[noreturn]] void refuse_extension(const std::string& extension, const char* what,
                                   const char* allowed) {
  throw FileError("extension '" + one_line(extension) + "' cannot hold " + what +
                  ", allowed: " + allowed);
}

void check_pixels(int width, int height, int channels, std::size_t count) {
  SWELL_CHECK(width >= 1 && height >= 1 && channels >= 1, "size={}x{}x{}", width, height, channels);
  SWELL_CHECK(count == std::size_t{1} * width * height * channels, "count={} size={}x{}x{}", count,
              width, height, channels);
}

std::vector<std::string> default_channel_names(int channels) {
  if (channels == 1) return {"Y"};
  if (channels == 2) return {"Y", "A"};
  return channels == 3 ? std::vector<std::string>{"R", "G", "B"}
                       : std::vector<std::string>{"R", "G", "B", "A"};
}

// Makes the request for an image of whole numbers, without its samples.
template <class Image>
EncodeRequest whole_number_request(const Image& image, const std::string& extension,
                                   const char* what) {
  check_pixels(image.width, image.height, image.channels, image.pixels.size());
  SWELL_CHECK(image.channels <= 4, "channels={}", image.channels);
  const std::string_view format = format_of_extension(lower_case(extension));
  if (format != "png" && format != "tiff") refuse_extension(extension, what, ".png, .tif, .tiff");
  return {
      .format = format, .width = image.width, .height = image.height, .channels = image.channels};
}

}  // namespace

std::vector<std::uint8_t> encode(const EncodeRequest& request) {
  if (request.format == "png") return encode_png(request);
  std::vector<std::uint8_t> bytes;
  std::string error;
  const CodecResult result = image_codec().encode(request, bytes, error);
  check_room(result);
  if (result == CodecResult::kFault)
    throw FileError(fmt::format("cannot encode {}: {}", request.format, one_line(error)));
  return bytes;
}

ImageF read_image(const std::filesystem::path& path, const ReadLimits& limits) {
  const std::string_view format = checked_format(path);
  try {
    // A text PNM takes up to as many bytes a sample as a float; every other format fewer.
    const std::vector<char> bytes = read_bytes(path, limits.max_bytes + (1u << 20));
    check_content(path, format, {bytes.data(), bytes.size()}, limits);
    return decode(path, format, bytes, limits);
  } catch (const FileError& error) {
    const std::string what = error.what();
    if (what.find(", allowed") != std::string::npos) throw;
    throw FileError(what + ", allowed a whole picture in the format of its extension");
  }
}

int side_at_most_px(const std::filesystem::path& path, int limit) {
  constexpr std::string_view kBegin = "\x89PNG\r\n\x1a\n";
  std::array<char, 24> head{};  // the last 8 bytes are width and height, big-endian
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return limit;
  std::ifstream file(path, std::ios::binary);
  if (!file.read(head.data(), head.size()) || !std::string_view(head.data()).starts_with(kBegin))
    return limit;
  const auto number = [&](std::size_t at) {
    std::uint32_t n = 0;
    for (std::size_t i = at; i < at + 4; ++i) n = n << 8 | static_cast<unsigned char>(head[i]);
    return n;
  };
  return static_cast<int>(
      std::min(std::max(number(16), number(20)), static_cast<std::uint32_t>(limit)));
}

std::vector<std::uint8_t> encode_image(const Image8& image, const std::string& extension,
                                       const ImageExtras& extras) {
  EncodeRequest request = whole_number_request(image, extension, "8-bit pixels");
  request.notes = extras.notes;
  request.bytes = image.pixels.data();
  return encode(request);
}

std::vector<std::uint8_t> encode_image(const Image16& image, const std::string& extension) {
  EncodeRequest request = whole_number_request(image, extension, "16-bit pixels");
  request.words = image.pixels.data();
  return encode(request);
}

std::vector<std::uint8_t> encode_image(const ImageF& image, const std::string& extension,
                                       std::span<const std::string> channel_names,
                                       const ImageExtras& extras) {
  check_pixels(image.width, image.height, image.channels, image.pixels.size());
  const std::string_view format = format_of_extension(lower_case(extension));
  if (format != "openexr" && format != "tiff") {
    refuse_extension(extension, "float pixels", ".exr, .tif, .tiff");
  }
  SWELL_CHECK(!channel_names.empty() || image.channels <= 4, "channels={}", image.channels);
  EncodeRequest request{.format = format,
                        .width = image.width,
                        .height = image.height,
                        .channels = image.channels,
                        .floats = image.pixels.data()};
  request.notes = extras.notes;
  // OpenImageIO's TIFF knows other names.
  if (format == "openexr") request.exr_compression = extras.exr_compression;
  request.names.assign(channel_names.begin(), channel_names.end());
  if (channel_names.empty()) request.names = default_channel_names(image.channels);
  SWELL_CHECK(std::ssize(request.names) == image.channels, "names={} channels={}",
              request.names.size(), image.channels);
  return encode(request);
}

}  // namespace swell::texture
