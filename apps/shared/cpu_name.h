// What a report says of the machine.
#pragma once

#include <string>

namespace swell::apps {

// The processor's name as the kernel has it, "AMD EPYC 9R14"; "unknown" if it has none.
std::string cpu_name();

}  // namespace swell::apps
