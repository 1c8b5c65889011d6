// Which fields of a frame's windows are there: all from the beginning, or each once it was asked
// for. Many threads may ask at once; one makes.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "ocean/spectrum/limits.h"

namespace swell::ocean {

// When the fields of windows are made. All at once by all threads, or those of one window by the
// first who asks at a point in it, alone: heights, and slopes with foam where these are asked. The
// bits are the same; where few points are asked the other windows cost nothing.
enum class MakeWakes : std::uint8_t { kNow, kWhenAsked };

// Each has what those before it have.
enum class WakeFields : std::uint8_t { kNone, kHeights, kAll };

class MadeFields {
 public:
  MadeFields() { begin(WakeFields::kAll); }
  // A copy has what the other has. Nobody asks the other meanwhile.
  MadeFields(const MadeFields& other) { *this = other; }
  MadeFields& operator=(const MadeFields& other) {
    for (std::size_t w = 0; w < made_.size(); ++w) made_[w] = other.made_[w].load();
    return *this;
  }

  // Of all windows. Nobody asks meanwhile.
  void begin(WakeFields made) {
    for (auto& window : made_) window = made;
  }

  WakeFields of(std::size_t window) const { return made_[window].load(std::memory_order_acquire); }

  // Calls make(what is there) if the window lacks something of what is wanted. Returns once all of
  // it is there.
  template <class Make>
  void need(std::size_t window, WakeFields wanted, const Make& make) const {
    if (of(window) >= wanted) return;
    const std::lock_guard lock(mutex_);
    const WakeFields made = of(window);
    if (made >= wanted) return;
    make(made);
    made_[window].store(wanted, std::memory_order_release);
  }

 private:
  mutable std::mutex mutex_;
  mutable std::array<std::atomic<WakeFields>, kMostWakeWindows> made_;
};

}  // namespace swell::ocean
