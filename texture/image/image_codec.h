// What image_io.cpp asks of OpenImageIO. The library behind these calls is a module of its own
// (image_codec.cpp), loaded when the first image is read, or written in another format than PNG
// (png_file.h): OpenImageIO brings 260 shared libraries with it, which take 0.2 s and 250 MB of
// address space to load.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "texture/image/image_note.h"

namespace swell::texture {

enum class CodecResult : std::uint8_t { kDone, kFault, kNoRoom };  // no memory, or no thread

// What one sample of a channel is in the file.
enum class SampleKind : std::uint8_t {
  kUnsigned8,  // or fewer bits, stretched to 8
  kUnsigned16,
  kUnsigned32,
  kUnsigned64,
  kSigned8,
  kSigned16,
  kSigned32,
  kSigned64,
  kHalf,
  kFloat,
  kDouble,
  kUnknown
};

struct ImageInfo {
  int width = 0, height = 0, depth = 0, channels = 0;
  bool is_deep = false;
  std::vector<SampleKind> kinds;  // of each channel
};

struct EncodeRequest {
  std::string_view format;
  int width = 0, height = 0, channels = 0;
  // width * height * channels samples of one of these kinds, the others null.
  const std::uint8_t* bytes = nullptr;
  const std::uint16_t* words = nullptr;
  const float* floats = nullptr;
  // 32 bits each, as the channels' kinds say; interleaved as all samples are.
  const std::uint32_t* bits = nullptr;
  std::vector<SampleKind> kinds = {};   // of `bits`: kUnsigned32 or kFloat for each channel
  std::vector<std::string> names = {};  // of the channels; empty: the format's own
  std::span<const ImageNote> notes = {};
  std::string_view exr_compression = "zip";  // of floats and bits
};

// Formats go by OpenImageIO's names: "png", "openexr", "hdr", "tiff", "pnm". Where the result is
// kFault, `error` says why, in any number of lines. No call throws. One image at a time a thread.
struct ImageCodec {
  std::uint32_t version;
  // Opens the image in `bytes`, which outlive it; `image` is for the two calls below.
  CodecResult (*open)(std::string_view format, std::span<const char> bytes, void*& image,
                      ImageInfo& info, std::string& error);
  // Fills width * height * channels samples: of 8 and 16 bits as [0, 1], kUnsigned32 as the whole
  // numbers that they are (a fault if a float does not hold them), others as stored.
  CodecResult (*read)(void* image, std::span<float> pixels, std::string& error);
  void (*close)(void* image);
  CodecResult (*encode)(const EncodeRequest& request, std::vector<std::uint8_t>& bytes,
                        std::string& error);
};

inline constexpr std::uint32_t kImageCodecVersion = 3;  // another after each change above
inline constexpr char kImageCodecFile[] = "libswell_image_codec.so";
inline constexpr char kImageCodecSymbol[] = "swell_image_codec";  // an ImageCodec

// Loads the module with the first call and keeps it: beside the program, in ../lib/swell from
// there, or where the system looks. Throws FileError if it is not there or is another version's,
// std::runtime_error if there is not enough memory or no thread to be had for loading it, where its
// libraries would abort the program. May be called by several threads at once.
const ImageCodec& image_codec();

// What the codec, or for PNG libpng, makes of the request. Throws FileError.
std::vector<std::uint8_t> encode(const EncodeRequest& request);

}  // namespace swell::texture
