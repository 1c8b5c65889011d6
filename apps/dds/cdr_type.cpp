#include "apps/dds/cdr_type.h"

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

namespace swell::apps {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A sample as Cyclone holds it. On the wire it is filled up to a multiple of four bytes.
struct CdrData : ddsi_serdata {
  CdrData(const ddsi_sertype* its_type, ddsi_serdata_kind its_kind) : ddsi_serdata() {
    ddsi_serdata_init(this, its_type, its_kind);
  }

  void resize(std::size_t count) {
    size = static_cast<std::uint32_t>(count);
    bytes.resize((count + 3) / 4 * 4);
  }

  Bytes bytes;
  std::uint32_t size = 0;
};

// What comes in is a clock or a pose: what says that it is larger is neither.
constexpr std::size_t kMostReceived = 1u << 20;

// A sample of so many bytes; none where there is no memory. Exceptions must not reach Cyclone.
CdrData* make_data(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size) noexcept {
  try {
    auto data = std::make_unique<CdrData>(type, kind);
    data->resize(size);
    return data.release();
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

const CdrData& cdr(const ddsi_serdata* data) { return *static_cast<const CdrData*>(data); }

// ---- Samples. There are no keys: all are of one instance.

bool equal_keys(const ddsi_serdata*, const ddsi_serdata*) { return true; }

std::uint32_t get_size(const ddsi_serdata* data) { return cdr(data).size; }

ddsi_serdata* from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind,
                             const nn_rdata* fragment, std::size_t size) {
  CdrData* data = size <= kMostReceived ? make_data(type, kind, size) : nullptr;
  if (!data) return nullptr;
  std::size_t filled = 0;
  for (; fragment; fragment = fragment->nextfrag) {
    if (fragment->maxp1 <= filled) continue;  // they may overlap
    const std::uint8_t* payload =
        NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    const std::size_t end = std::min<std::size_t>(fragment->maxp1, size);
    std::copy(payload + (filled - fragment->min), payload + (end - fragment->min),
              data->bytes.begin() + static_cast<std::ptrdiff_t>(filled));
    filled = end;
  }
  return data;
}

ddsi_serdata* from_parts(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                         const ddsrt_iovec_t* parts, std::size_t size) {
  CdrData* data = size <= kMostReceived ? make_data(type, kind, size) : nullptr;
  if (!data) return nullptr;
  std::size_t filled = 0;
  for (std::size_t n = 0; n < count && filled < size; ++n) {
    const std::size_t some = std::min<std::size_t>(parts[n].iov_len, size - filled);
    std::memcpy(data->bytes.data() + filled, parts[n].iov_base, some);
    filled += some;
  }
  return data;
}

ddsi_serdata* from_key(const ddsi_sertype* type, const ddsi_keyhash*) {
  return make_data(type, SDK_KEY, 0);
}

ddsi_serdata* from_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* sample) {
  if (kind != SDK_DATA) return make_data(type, kind, 0);
  const Bytes& bytes = *static_cast<const Bytes*>(sample);
  CdrData* data = make_data(type, kind, bytes.size());
  if (data) std::ranges::copy(bytes, data->bytes.begin());
  return data;
}

void to_bytes(const ddsi_serdata* data, std::size_t from, std::size_t count, void* bytes) {
  std::memcpy(bytes, cdr(data).bytes.data() + from, count);
}

ddsi_serdata* lend_bytes(const ddsi_serdata* data, std::size_t from, std::size_t count,
                         ddsrt_iovec_t* lent) {
  lent->iov_base = const_cast<std::uint8_t*>(cdr(data).bytes.data()) + from;
  lent->iov_len = count;
  return ddsi_serdata_ref(data);
}

void take_back(ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); }

bool to_sample(const ddsi_serdata* data, void* sample, void**, void*) {
  const CdrData& from = cdr(data);
  static_cast<Bytes*>(sample)->assign(from.bytes.begin(), from.bytes.begin() + from.size);
  return true;
}

ddsi_serdata* to_key(const ddsi_serdata* data) {
  CdrData* key = make_data(data->type, SDK_KEY, 0);
  if (key) key->type = nullptr;  // keys are of no type
  return key;
}

bool key_to_sample(const ddsi_sertype*, const ddsi_serdata*, void* sample, void**, void*) {
  static_cast<Bytes*>(sample)->clear();
  return true;
}

void free_data(ddsi_serdata* data) { delete static_cast<CdrData*>(data); }

std::size_t print(const ddsi_sertype*, const ddsi_serdata* data, char* text, std::size_t size) {
  return static_cast<std::size_t>(std::snprintf(text, size, "%u bytes", cdr(data).size));
}

void get_key_hash(const ddsi_serdata*, ddsi_keyhash* hash, bool) { *hash = {}; }

constexpr ddsi_serdata_ops sample_operations() {
  ddsi_serdata_ops ops{};
  ops.eqkey = equal_keys;
  ops.get_size = get_size;
  ops.from_ser = from_fragments;
  ops.from_ser_iov = from_parts;
  ops.from_keyhash = from_key;
  ops.from_sample = from_sample;
  ops.to_ser = to_bytes;
  ops.to_ser_ref = lend_bytes;
  ops.to_ser_unref = take_back;
  ops.to_sample = to_sample;
  ops.to_untyped = to_key;
  ops.untyped_to_sample = key_to_sample;
  ops.free = free_data;
  ops.print = print;
  ops.get_keyhash = get_key_hash;
  return ops;  // without shared memory, which Domain leaves off
}
constexpr ddsi_serdata_ops kSampleOperations = sample_operations();

// ---- The type

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}

void zero_samples(const ddsi_sertype*, void* samples, std::size_t count) {
  for (std::size_t n = 0; n < count; ++n) static_cast<Bytes*>(samples)[n].clear();
}

// Samples are the caller's: none is lent.
void realloc_samples(void**, const ddsi_sertype*, void*, std::size_t, std::size_t) {}
void free_samples(const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {}

bool equal_types(const ddsi_sertype*, const ddsi_sertype*) { return true; }  // of one name
std::uint32_t hash_type(const ddsi_sertype*) { return 0; }

constexpr ddsi_sertype_ops type_operations() {
  ddsi_sertype_ops ops{};
  ops.version = ddsi_sertype_v0;
  ops.free = free_type;
  ops.zero_samples = zero_samples;
  ops.realloc_samples = realloc_samples;
  ops.free_samples = free_samples;
  ops.equal = equal_types;
  ops.hash = hash_type;
  return ops;
}
constexpr ddsi_sertype_ops kTypeOperations = type_operations();

}  // namespace

CdrTopic create_cdr_topic(dds_entity_t participant, const std::string& topic,
                          const std::string& type) {
  auto* its = new ddsi_sertype{};
  ddsi_sertype_init(its, type.c_str(), &kTypeOperations, &kSampleOperations, true);
  ddsi_sertype* taken = its;
  const dds_entity_t made =
      dds_create_topic_sertype(participant, topic.c_str(), &taken, nullptr, nullptr, nullptr);
  if (made < 0) ddsi_sertype_unref(its);
  return {made, taken};
}

}  // namespace swell::apps
