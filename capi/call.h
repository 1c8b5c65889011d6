// What every function of swell.h does around its work: exceptions become a status and a message,
// structures are read and written by their size, handles are held by one thread at a time.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <stdexcept>

#include "math/with_ieee.h"
#include "swell.h"

namespace swell::capi {

// The caller's mistake: 'WHAT, got GOT, allowed ALLOWED'.
class ArgumentError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class BusyError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class... Values>
[[noreturn]] void refuse(fmt::format_string<Values...> text, Values&&... values) {
  throw ArgumentError(fmt::format(text, std::forward<Values>(values)...));
}

template <class Pointer>
void check_not_null(const Pointer* pointer, const char* name) {
  if (!pointer) refuse("{}, got null, allowed a valid pointer", name);
}

// NaN is in no range.
void check_range(const char* name, double value, double low, double high);

// The status of the exception that is being handled; swell_last_error() is its message.
swell_status status_of_exception() noexcept;

template <class Work>
swell_status guarded(const Work& work) noexcept {
  try {
    with_ieee(work);
    return SWELL_OK;
  } catch (...) {
    return status_of_exception();
  }
}

inline constexpr std::size_t kMostStructBytes = 4096;

// The size that the caller gave. sizeof is a multiple of the alignment in every version: another
// size would cut a member.
template <class Struct>
std::size_t size_of(const Struct* given, const char* name) {
  check_not_null(given, name);
  if (given->size < sizeof(std::size_t) || given->size > kMostStructBytes ||
      given->size % alignof(Struct) != 0)
    refuse("{}.size, got {}, allowed sizeof, {}", name, given->size, sizeof(Struct));
  return given->size;
}

// A structure of any version: what it lacks is 0, what it has more has to be 0.
template <class Struct>
Struct taken(const Struct* given, const char* name) {
  const std::size_t size = size_of(given, name);
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  if (std::any_of(bytes + std::min(size, sizeof(Struct)), bytes + size,
                  [](unsigned char byte) { return byte != 0; }))
    refuse("{}.size, got {} with values that this version, {}, does not know, allowed {}", name,
           size, swell_version(), sizeof(Struct));
  Struct result{};
  std::memcpy(static_cast<void*>(&result), given, std::min(size, sizeof(Struct)));
  return result;
}

// Writes as much as the caller's version has.
template <class Struct>
void give(Struct value, Struct* to, const char* name) {
  value.size = size_of(to, name);
  std::memcpy(static_cast<void*>(to), &value, std::min(value.size, sizeof(Struct)));
}

// Holds a handle while it lives; throws BusyError if another thread does.
template <class Handle>
class Held {
 public:
  Held(Handle* handle, const char* name) : handle_(*checked(handle, name)) {
    if (handle_.busy.test_and_set(std::memory_order_acquire))
      throw BusyError(
          fmt::format("{}, got one that another thread uses, allowed one for each thread", name));
  }
  ~Held() { handle_.busy.clear(std::memory_order_release); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  Handle* operator->() const { return &handle_; }
  Handle& operator*() const { return handle_; }

 private:
  static Handle* checked(Handle* handle, const char* name) {
    check_not_null(handle, name);
    return handle;
  }
  Handle& handle_;
};

}  // namespace swell::capi
