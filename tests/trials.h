// How often a test tries its random cases.
#pragma once

namespace swell {

// All of them, or a tenth under the sanitizers, which take ten times as long and look for something
// else: what every case does.
constexpr int trials(int all) {
#ifdef SWELL_SANITIZED
  return all / 10;
#else
  return all;
#endif
}

}  // namespace swell
