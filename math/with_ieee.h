// Work with IEEE arithmetic inside a function whose arguments or result are numbers.
//
//   double half(double x) {
//     return with_ieee([&] { return 0.5 * x; });
//   }
#pragma once

#include "math/parallel.h"

namespace swell {

// Not inlined, see below.
template <class Work>
[[gnu::noinline]] auto run_apart(const Work& work) {
  return work();
}

// Returns work(), which runs inside a ScopedFloatEnvironment. Beside one in the same function the
// compiler may move arithmetic on numbers that it has at hand out of its scope: it takes them for
// independent of the control words.
template <class Work>
auto with_ieee(const Work& work) {
  const ScopedFloatEnvironment ieee;
  return run_apart(work);
}

}  // namespace swell
