// What this process may take, and how long it lives.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>

namespace swell::mesh_import {

// These bound the process's own memory (RLIMIT_DATA) [bytes]: libraries' code and files that are
// mapped do not count. kMostMemory bounds all its addresses (RLIMIT_AS), too.
inline constexpr std::uint64_t kLeastMemory = 256ull << 20;
inline constexpr std::uint64_t kMostMemory = 6ull << 30;
inline constexpr std::uint64_t kMemoryPerInput = 64;  // of what is read (asset_file.h)

// Ends this process when the thread that started it ends. False if `parent`, the process of that
// thread, has ended before.
bool end_with_parent(pid_t parent);

// Bounds its time, and its memory by kLeastMemory; keeps it from writing files. Call it before
// anything is read.
void limit_process();

// Allows kMemoryPerInput bytes more for each of `inputs`, up to kMostMemory in all.
void allow_memory_for(std::uint64_t inputs);

// Calls `load`, up to kMostMemory, and allows what it took besides: libraries start threads as they
// like, of 8 MB each.
void load_uncounted(const std::function<void()>& load);

}  // namespace swell::mesh_import
