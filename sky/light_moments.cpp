#include "sky/light_moments.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::sky {

// Source: W. H. Press et al., Numerical Recipes, third edition, 2007, section 6.7 (the recurrence).
Harmonics harmonics(double sine) {
  Harmonics all;
  const double cosine = std::sqrt(std::max(1.0 - sine * sine, 0.0));
  double first = std::sqrt(0.5);  // K_mm
  for (int m = 0; m < kModes; ++m) {
    if (m > 0) first *= std::sqrt((2.0 * m + 1.0) / (2.0 * m)) * cosine;
    double before = 0.0, here = first;
    for (int l = m; l < kDegrees; ++l) {
      all[static_cast<std::size_t>(moment_index(l, m))] = static_cast<float>(here);
      const double next = l + 1, l2 = double(l) * l, m2 = double(m) * m;
      const double scale = std::sqrt((4.0 * next * next - 1.0) / (next * next - m2));
      const double back = std::sqrt((l2 - m2) / (4.0 * l2 - 1.0));
      const double value = scale * (sine * here - (l > m ? back * before : 0.0));
      before = here;
      here = value;
    }
  }
  return all;
}

double mode_norm(int m) { return (m == 0 ? 0.5 : 1.0) / kPi; }

}  // namespace swell::sky
