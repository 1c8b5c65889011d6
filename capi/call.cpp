#include "capi/call.h"

#include <array>
#include <new>

#include "math/stop.h"
#include "render/world/world_making.h"
#include "scene/scene_error.h"
#include "texture/image/image_io.h"

namespace swell::capi {
namespace {

constexpr std::size_t kMostMessageBytes = 1000;
thread_local std::array<char, kMostMessageBytes> last_error{};

swell_status report(swell_status status, const char* message) noexcept {
  std::size_t n = 0;
  for (; message[n] != '\0' && n + 1 < last_error.size(); ++n) {
    const auto c = static_cast<unsigned char>(message[n]);
    last_error[n] = c < 0x20 || c == 0x7f ? ' ' : message[n];
  }
  if (message[n] != '\0')  // not in the middle of a character
    while (n > 0 && (static_cast<unsigned char>(message[n]) & 0xc0) == 0x80) --n;
  last_error[n] = '\0';
  return status;
}

}  // namespace

void check_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    refuse("{}, got {}, allowed {} to {}", name, value, low, high);
}

swell_status status_of_exception() noexcept {
  try {
    throw;
  } catch (const ArgumentError& e) {
    return report(SWELL_BAD_ARGUMENT, e.what());
  } catch (const BusyError& e) {
    return report(SWELL_BUSY, e.what());
  } catch (const scene::SceneError& e) {
    return report(SWELL_BAD_SCENE, e.what());
  } catch (const texture::FileError& e) {
    return report(SWELL_BAD_SCENE, e.what());
  } catch (const std::invalid_argument& e) {  // values of a scene that only the sea can judge
    return report(SWELL_BAD_SCENE, e.what());
  } catch (const Stopped&) {
    return report(SWELL_CANCELLED, "cancelled by progress()");
  } catch (const render::OverMemoryBound& e) {
    return report(SWELL_NO_MEMORY, e.what());
  } catch (const std::bad_alloc&) {
    return report(SWELL_NO_MEMORY, "out of memory");
  } catch (const std::length_error&) {
    return report(SWELL_NO_MEMORY, "out of memory");
  } catch (const std::exception& e) {
    return report(SWELL_FAILED, e.what());
  } catch (...) {
    return report(SWELL_FAILED, "unknown fault");
  }
}

}  // namespace swell::capi

const char* swell_last_error() { return swell::capi::last_error.data(); }

const char* swell_version() { return SWELL_VERSION; }
