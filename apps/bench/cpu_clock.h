// The clock of the CPU that runs this thread, found out by running it.
#pragma once

namespace swell::apps {

// The clock just now [GHz], of a chain of 64-bit multiplications that each need the one before: 3
// cycles each on every x86-64 CPU with AVX2 and FMA from Intel (Haswell, 2013) and AMD (Zen, 2017)
// so far. What interrupts the chain makes the clock seem slower, never faster: of several
// measurements, the largest is right. Takes 25 us at 4 GHz.
double measure_clock_ghz();

// Keeps the calling thread on the CPU that it runs on. Throws std::system_error if it may not.
void stay_on_this_cpu();

}  // namespace swell::apps
