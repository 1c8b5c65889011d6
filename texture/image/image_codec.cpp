// The module behind image_codec.h: OpenImageIO, and nothing else of Swell.
#include "texture/image/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <dlfcn.h>
#include <fmt/core.h>

#include <cstdarg>
#include <exception>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

namespace swell::texture {
namespace {

// What libtiff says OpenImageIO tells in its errors; from libtiff 4.5 on it goes to stderr too.
// Another handler than libtiff's own is somebody else's.
void silence_libtiff() {
  using Handler = void (*)(const char*, const char*, std::va_list);
  const auto library_of = [](auto* function) -> const void* {
    Dl_info info = {};
    return dladdr(reinterpret_cast<const void*>(function), &info) != 0 ? info.dli_fbase : nullptr;
  };
  for (const char* const name : {"TIFFSetErrorHandler", "TIFFSetWarningHandler"}) {
    const auto set = reinterpret_cast<Handler (*)(Handler)>(dlsym(RTLD_DEFAULT, name));
    if (!set) continue;
    const Handler before = set(nullptr);
    if (before && library_of(before) != library_of(set)) set(before);
  }
}

// OpenImageIO on the calling thread only: files are small, and its pools would outlive the call.
// Once: from 2.5 on it aborts where two threads set how many threads it has.
void set_up() {
  static const bool is_done = [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    silence_libtiff();
    return true;
  }();
  static_cast<void>(is_done);
}

// Runs `work`, which returns false after it has set the error.
template <class Work>
CodecResult guarded(std::string& error, Work&& work) noexcept {
  try {
    set_up();
    return work() ? CodecResult::kDone : CodecResult::kFault;
  } catch (const std::bad_alloc&) {
    return CodecResult::kNoRoom;
  } catch (const std::system_error&) {  // of a thread that could not be started
    return CodecResult::kNoRoom;
  } catch (const std::exception& e) {
    error = e.what();
  } catch (...) {
    error = "unknown fault";
  }
  return CodecResult::kFault;
}

// --- Decoding

struct OpenImage {
  OIIO::Filesystem::IOMemReader memory;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
};

SampleKind kind_of(OIIO::TypeDesc type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
      return SampleKind::kUnsigned8;
    case OIIO::TypeDesc::UINT16:
      return SampleKind::kUnsigned16;
    case OIIO::TypeDesc::UINT32:
      return SampleKind::kUnsigned32;
    case OIIO::TypeDesc::UINT64:
      return SampleKind::kUnsigned64;
    case OIIO::TypeDesc::INT8:
      return SampleKind::kSigned8;
    case OIIO::TypeDesc::INT16:
      return SampleKind::kSigned16;
    case OIIO::TypeDesc::INT32:
      return SampleKind::kSigned32;
    case OIIO::TypeDesc::INT64:
      return SampleKind::kSigned64;
    case OIIO::TypeDesc::HALF:
      return SampleKind::kHalf;
    case OIIO::TypeDesc::FLOAT:
      return SampleKind::kFloat;
    case OIIO::TypeDesc::DOUBLE:
      return SampleKind::kDouble;
    default:
      return SampleKind::kUnknown;
  }
}

CodecResult open_image(std::string_view format, std::span<const char> bytes, void*& image,
                       ImageInfo& info, std::string& error) {
  return guarded(error, [&] {
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
    std::unique_ptr<OpenImage> open(
        new OpenImage{std::move(memory), OIIO::ImageInput::create(format), OIIO::ImageSpec()});
    if (!open->input || !open->input->set_ioproxy(&open->memory)) {
      error = "this build has no such format";
      return false;
    }
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    if (!open->input->open("image." + std::string(format), open->spec, hints)) {
      error = open->input->geterror();
      return false;
    }
    const OIIO::ImageSpec& spec = open->spec;
    info = {spec.width, spec.height, spec.depth, spec.nchannels, spec.deep, {}};
    for (int c = 0; c < spec.nchannels; ++c) info.kinds.push_back(kind_of(spec.channelformat(c)));
    image = open.release();
    return true;
  });
}

// One channel of 32-bit whole numbers; other types would come divided by the largest.
bool read_whole_numbers(OpenImage& open, int channel, std::span<float> pixels, std::string& error) {
  const OIIO::ImageSpec& spec = open.spec;
  std::vector<std::uint32_t> plane(std::size_t{1} * spec.width * spec.height);
  if (!open.input->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::UINT32, plane.data()))
    return false;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const float value = static_cast<float>(plane[i]);
    if (static_cast<double>(value) != static_cast<double>(plane[i])) {
      error = fmt::format(
          "pixel ({}, {}) channel {} is {}, allowed: whole numbers that a 32-bit float holds",
          i % spec.width, i / spec.width, channel, plane[i]);
      return false;
    }
    pixels[i * spec.nchannels + channel] = value;
  }
  return true;
}

bool read_channels(OpenImage& open, int first, int end, std::span<float> pixels) {
  const OIIO::stride_t stride = open.spec.nchannels * static_cast<OIIO::stride_t>(sizeof(float));
  return open.input->read_image(0, 0, first, end, OIIO::TypeFloat, pixels.data() + first, stride);
}

CodecResult read_image(void* image, std::span<float> pixels, std::string& error) {
  return guarded(error, [&] {
    OpenImage& open = *static_cast<OpenImage*>(image);
    bool done = true;
    for (int c = 0, end; done && c < open.spec.nchannels; c = end) {
      const auto is_whole = [&](int channel) {
        return open.spec.channelformat(channel).basetype == OIIO::TypeDesc::UINT32;
      };
      for (end = c + 1; end < open.spec.nchannels && is_whole(end) == is_whole(c);) ++end;
      if (is_whole(c)) end = c + 1;
      done = is_whole(c) ? read_whole_numbers(open, c, pixels, error)
                         : read_channels(open, c, end, pixels);
    }
    // Not every reader says false for every pixel it could not read.
    if (done && !open.input->has_error()) return true;
    if (error.empty()) error = open.input->geterror();
    return false;
  });
}

void close_image(void* image) { delete static_cast<OpenImage*>(image); }

// --- Encoding

struct Samples {
  const void* first;
  OIIO::TypeDesc type;  // TypeUnknown: of each channel its own
};
Samples samples_of(const EncodeRequest& request) {
  if (request.bytes) return {request.bytes, OIIO::TypeUInt8};
  if (request.words) return {request.words, OIIO::TypeUInt16};
  if (request.floats) return {request.floats, OIIO::TypeFloat};
  return {request.bits, OIIO::TypeUnknown};
}

OIIO::ImageSpec spec_of(const EncodeRequest& request, OIIO::TypeDesc type) {
  const bool is_mixed = type == OIIO::TypeUnknown;
  OIIO::ImageSpec spec(request.width, request.height, request.channels,
                       is_mixed ? OIIO::TypeFloat : type);
  if (!request.names.empty()) spec.channelnames = request.names;
  for (const SampleKind kind : request.kinds)
    spec.channelformats.push_back(kind == SampleKind::kFloat ? OIIO::TypeFloat : OIIO::TypeUInt32);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // channels as they are
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  if (is_mixed || type == OIIO::TypeFloat)
    spec.attribute("compression", std::string(request.exr_compression));
  for (const ImageNote& note : request.notes) spec.attribute(note.name, note.text);
  return spec;
}

CodecResult encode_image(const EncodeRequest& request, std::vector<std::uint8_t>& bytes,
                         std::string& error) {
  return guarded(error, [&] {
    const auto [pixels, type] = samples_of(request);
    const OIIO::ImageSpec spec = spec_of(request, type);
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::string format(request.format);
    const auto output = OIIO::ImageOutput::create(format);
    const bool done = output && output->set_ioproxy(&memory) &&
                      output->open("image." + format, spec) && output->write_image(type, pixels) &&
                      output->close();
    if (!done) error = output ? output->geterror() : "the format is missing";
    return done;
  });
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const ImageCodec swell_image_codec = {
    kImageCodecVersion, open_image, read_image, close_image, encode_image};

}  // namespace swell::texture
