// How a world is to be made, beside its scene: threads, who is told, when to stop, what memory it
// may take.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <new>
#include <span>
#include <string>

#include "math/parallel.h"
#include "math/stop.h"

namespace swell::render {

class World;

struct WorldMaking {
  int threads = available_cpus();  // [1, 256]
  // Worlds to share parts with that are made of the same.
  std::span<const World* const> like = {};
  // Where parts are kept for other processes (render/world/part_cache.h); empty: nowhere. The bits
  // are the same. A thread writes there beside those that draw; the world's destructor waits for
  // it.
  std::filesystem::path cache_folder = {};
  // Any thread sets it to end the making, with Stopped (math/stop.h), within 50 ms.
  const std::atomic<bool>* stop = nullptr;
  // Is told the part that is done, in [0, 1] and never less than before, by typical times.
  std::function<void(double done)> tell = {};
  // Takes a line for each part that is made or read: 'coast: 0.41 s'.
  std::function<void(const std::string& line)> log = {};
  // Of memory, while the world is made and afterwards (render/world/part_needs.h); 0: no bound.
  std::size_t most_bytes = 0;
};
// Both functions are called by the threads that make the world, one at a time.

// A world would need more memory than it may take; what() says how much.
class OverMemoryBound : public std::bad_alloc {
 public:
  explicit OverMemoryBound(std::string text) : text_(std::move(text)) {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

}  // namespace swell::render
