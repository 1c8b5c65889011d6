// What the panel's sections are made of.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "math/enum_table.h"

namespace swell::view {

void text(const std::string& line);

// A row of two columns: a name, a number to the right of it.
void row(std::string_view name, const std::string& value);

// A slider over a value kept in double. True if it was moved.
bool slide(const char* label, double& value, double low, double high, const char* format);
bool slide_by_decades(const char* label, double& value, double low, double high,
                      const char* format);
// Over an angle in degrees, kept in radians.
bool slide_angle(const char* label, double& radians, double low_deg, double high_deg);

bool choose_number(const char* label, int& chosen, std::span<const char* const> names);

// A list of which one is chosen, of the first `count`. True if it is another one now.
template <class Enum>
bool choose(const char* label, Enum& chosen, const EnumTable<Enum, const char*>& names,
            std::size_t count = kEnumerators<Enum>) {
  int at = static_cast<int>(chosen);
  const bool changed = choose_number(label, at, std::span<const char* const>(names).first(count));
  chosen = static_cast<Enum>(at);
  return changed;
}

}  // namespace swell::view
