// What a report says of the machine.
#pragma once

#include <iosfwd>
#include <string>

namespace swell::apps {

// The processor's name as the kernel has it, "AMD EPYC 9R14"; "unknown" if it has none. Arm's have
// numbers there: the names of common ones, "Arm part 0xd4b" of others.
std::string cpu_name();

// That of a text like /proc/cpuinfo.
std::string cpu_name(std::istream& processors);

}  // namespace swell::apps
