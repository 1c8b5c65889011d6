// Numbers as scene files have them: with as few digits as say the value that is stored.
#pragma once

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <string>

namespace swell::scene {

// The number with the fewest digits that `convert` turns into `stored`, near `guess`. Not every
// double is some number of degrees; then the nearest one.
template <class Stored, class Convert>
double shortest_preimage(Stored stored, double guess, Convert convert) {
  for (int digits = 1; digits <= 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}", guess, digits);
    double number = guess;
    std::from_chars(text.data(), text.data() + text.size(), number);
    if (convert(number) == stored) return number;
  }
  for (double up = guess, down = guess; std::abs(up - guess) < 8e-16 * std::abs(guess);) {
    up = std::nextafter(up, INFINITY);
    down = std::nextafter(down, -INFINITY);
    if (convert(up) == stored) return up;
    if (convert(down) == stored) return down;
  }
  return guess;
}

inline double to_file(double value) { return value; }
inline double to_file(float value) {
  return shortest_preimage(value, value, [](double x) { return static_cast<float>(x); });
}

}  // namespace swell::scene
