#include "math/archive.h"

#include <istream>
#include <ostream>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace swell {

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
  hash_.add(bytes, size);
  to_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
}

void WrittenBytes::finish() {
  const ValueHash hash = hash_.hash();
  to_.write(reinterpret_cast<const char*>(&hash), sizeof hash);
}

void ReadBytes::add(void* bytes, std::size_t size) {
  if (size > left_ || !from_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(size)))
    throw ArchiveError("too few bytes");
  left_ -= size;
  hash_.add(bytes, size);
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
