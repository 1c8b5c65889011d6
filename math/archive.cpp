#include "math/archive.h"

#include <algorithm>
#include <istream>
#include <ostream>

#include "math/stop.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace swell {
namespace {

// Calls piece(begin, count) for each megabyte.
template <class Piece>
void for_each_piece(std::size_t size, const Piece& piece) {
  constexpr std::size_t kMost = std::size_t{1} << 20;
  for (std::size_t at = 0; at < size; at += kMost) {
    check_stop();
    piece(at, std::min(kMost, size - at));
  }
}

}  // namespace

struct StreamHash::State {
  XXH3_state_t xxh3;
};

StreamHash::StreamHash() : state_(new State) { XXH3_128bits_reset(&state_->xxh3); }
StreamHash::~StreamHash() = default;

void StreamHash::add(const void* bytes, std::size_t size) {
  XXH3_128bits_update(&state_->xxh3, bytes, size);
}

ValueHash StreamHash::hash() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(&state_->xxh3);
  return {hash.high64, hash.low64};
}

void WrittenBytes::add(const void* bytes, std::size_t size) {
  const char* const begin = static_cast<const char*>(bytes);
  for_each_piece(size, [&](std::size_t at, std::size_t count) {
    hash_.add(begin + at, count);
    to_.write(begin + at, static_cast<std::streamsize>(count));
  });
}

void WrittenBytes::finish() {
  const ValueHash hash = hash_.hash();
  to_.write(reinterpret_cast<const char*>(&hash), sizeof hash);
}

void ReadBytes::add(void* bytes, std::size_t size) {
  if (size > left_) throw ArchiveError("too few bytes");
  left_ -= size;
  char* const begin = static_cast<char*>(bytes);
  for_each_piece(size, [&](std::size_t at, std::size_t count) {
    if (!from_.read(begin + at, static_cast<std::streamsize>(count)))
      throw ArchiveError("too few bytes");
    hash_.add(begin + at, count);
  });
}

void ReadBytes::add_count(std::uint64_t& count, std::size_t element_size) {
  add(&count, sizeof count);
  if (count > left_ / element_size) throw ArchiveError("too few bytes");
}

void ReadBytes::finish() {
  const ValueHash made = hash_.hash();
  ValueHash written;
  if (left_ != sizeof written || !from_.read(reinterpret_cast<char*>(&written), sizeof written) ||
      written != made)
    throw ArchiveError("changed bytes");
}

}  // namespace swell
