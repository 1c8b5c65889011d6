// Which name a word was meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace swell::scene {

// Levenshtein's distance: how many letters are put in, left out or replaced.
int edit_distance(std::string_view a, std::string_view b);

// Asks for a name: " (did you mean 'speed_mps'?)".
std::string did_you_mean(std::string_view name);
// Asks for the name nearest to the word; "" if none is near.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> names);

}  // namespace swell::scene
