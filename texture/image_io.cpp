#include "texture/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "math/check.h"
#include "texture/file_bytes.h"
#include "texture/image_structure.h"

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

// The same from the file's first bytes.
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

// OpenImageIO on the calling thread only: files are small, and its pools would outlive the call.
void use_one_thread() {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
}

std::string_view checked_format(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  const std::string_view format = format_of_extension(extension);
  if (format.empty())
    fail(path, "extension '{}' is not readable, allowed: {}", extension, kReadable);
  return format;
}

void check_content(const std::filesystem::path& path, std::string_view format,
                   std::string_view bytes) {
  const std::string_view found = format_of_content(bytes);
  if (found.empty()) fail(path, "the content is no image of: {}", kReadable);
  if (found != format) fail(path, "the extension says {}, the content says {}", format, found);
  if (found == "png") check_png_structure(path, bytes);
  if (found == "pnm") check_pnm_structure(path, bytes);
}

void check_size(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                const ReadLimits& limits) {
  if (spec.width < 1 || spec.height < 1 || spec.width > limits.max_side_px ||
      spec.height > limits.max_side_px) {
    fail(path, "the size is {}x{}, allowed: 1x1 to {}x{}", spec.width, spec.height,
         limits.max_side_px, limits.max_side_px);
  }
  if (spec.deep || spec.depth != 1) fail(path, "deep and volume images are not readable");
  if (spec.nchannels < 1 || spec.nchannels > 4) {
    fail(path, "the image has {} channels, allowed: 1 to 4", spec.nchannels);
  }
  const std::uint64_t bytes = std::uint64_t{4} * spec.width * spec.height * spec.nchannels;
  if (bytes > limits.max_bytes) {
    fail(path, "the image needs {} bytes, allowed: {}", bytes, limits.max_bytes);
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

ImageF decode(const std::filesystem::path& path, const std::string& format, std::string_view bytes,
              const ReadLimits& limits) {
  use_one_thread();
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
  const auto input = OIIO::ImageInput::create(format);
  if (!input || !input->set_ioproxy(&memory)) fail(path, "this build cannot read {}", format);
  OIIO::ImageSpec spec, hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->open("image." + format, spec, hints)) {
    fail(path, "not a readable {} file: {}", format, input->geterror());
  }
  check_size(path, spec, limits);
  ImageF image{spec.width, spec.height, spec.nchannels, {}};
  image.pixels.resize(std::size_t{1} * spec.width * spec.height * spec.nchannels);
  // Not every reader says false for every pixel it could not read.
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, image.pixels.data()) ||
      input->has_error()) {
    fail(path, "cannot decode the pixels: {}", input->geterror());
  }
  check_finite(path, image);
  return image;
}

// --- Encoding

// PNG chunks that carry the time or the writing program: the same picture, the same bytes.
void drop_png_notes(std::vector<std::uint8_t>& png) {
  constexpr std::size_t kSignature = 8, kChunkFrame = 12;  // length, type, check sum
  std::size_t from = kSignature, to = kSignature;
  while (from + kChunkFrame <= png.size()) {
    const std::size_t size = kChunkFrame + (std::size_t{png[from]} << 24 | png[from + 1] << 16 |
                                            png[from + 2] << 8 | png[from + 3]);
    const std::string_view type(reinterpret_cast<const char*>(&png[from + 4]), 4);
    if (type != "tIME" && type != "tEXt" && type != "zTXt" && type != "iTXt") {
      std::copy_n(png.begin() + static_cast<std::ptrdiff_t>(from), size,
                  png.begin() + static_cast<std::ptrdiff_t>(to));
      to += size;
    }
    from += size;
  }
  png.resize(to);
}

std::vector<std::uint8_t> encode(const std::string& format, OIIO::ImageSpec spec,
                                 OIIO::TypeDesc type, const void* pixels) {
  use_one_thread();
  spec.attribute("oiio:UnassociatedAlpha", 1);  // channels as they are
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  std::vector<std::uint8_t> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  const bool done = output && output->set_ioproxy(&memory) &&
                    output->open("image." + format, spec) && output->write_image(type, pixels) &&
                    output->close();
  if (!done) {
    throw FileError("cannot encode " + format + ": " +
                    one_line(output ? output->geterror() : "the format is missing"));
  }
  if (format == "png") drop_png_notes(bytes);
  return bytes;
}

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

}  // namespace

ImageF read_image(const std::filesystem::path& path, const ReadLimits& limits) {
  const std::string format(checked_format(path));
  // A text PNM takes up to as many bytes a sample as a float; every other format fewer.
  const std::vector<char> bytes = read_bytes(path, limits.max_bytes + (1u << 20));
  check_content(path, format, {bytes.data(), bytes.size()});
  try {
    return decode(path, format, {bytes.data(), bytes.size()}, limits);
  } catch (const FileError&) {
    throw;
  } catch (const std::exception& error) {
    fail(path, "cannot decode: {}", error.what());
  }
}

std::vector<std::uint8_t> encode_image(const Image8& image, const std::string& extension) {
  check_pixels(image.width, image.height, image.channels, image.pixels.size());
  SWELL_CHECK(image.channels <= 4, "channels={}", image.channels);
  const std::string_view format = format_of_extension(lower_case(extension));
  if (format != "png" && format != "tiff") {
    refuse_extension(extension, "8-bit pixels", ".png, .tif, .tiff");
  }
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeUInt8);
  // Level 1 and libpng's filter "sub" (16): 2.5 times as fast as level 3 with its choice of filter
  // for a 1280 x 720 picture, and 6 % more bytes.
  spec.attribute("png:compressionLevel", 1);
  spec.attribute("png:filter", 16);
  return encode(std::string(format), spec, OIIO::TypeUInt8, image.pixels.data());
}

std::vector<std::uint8_t> encode_image(const ImageF& image, const std::string& extension,
                                       std::span<const std::string> channel_names) {
  check_pixels(image.width, image.height, image.channels, image.pixels.size());
  const std::string_view format = format_of_extension(lower_case(extension));
  if (format != "openexr" && format != "tiff") {
    refuse_extension(extension, "float pixels", ".exr, .tif, .tiff");
  }
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeFloat);
  SWELL_CHECK(!channel_names.empty() || image.channels <= 4, "channels={}", image.channels);
  spec.channelnames.assign(channel_names.begin(), channel_names.end());
  if (channel_names.empty()) spec.channelnames = default_channel_names(image.channels);
  SWELL_CHECK(std::ssize(spec.channelnames) == image.channels, "names={} channels={}",
              spec.channelnames.size(), image.channels);
  spec.attribute("compression", "zip");
  return encode(std::string(format), spec, OIIO::TypeFloat, image.pixels.data());
}

}  // namespace swell::texture
