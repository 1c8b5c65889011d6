// What the panel's sections are made of.
#pragma once

#include <string>
#include <string_view>

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

}  // namespace swell::view
