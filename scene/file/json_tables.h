// JSON as the tables that TOML has. The one door to the JSON library in scene/.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string_view>

namespace swell::scene {

// The tables of an object in JSON; its numbers are integers where they have neither a point nor an
// exponent. Dotted keys become tables in each other. Throws SceneError for a syntax error, a null,
// and a key that stands for two things. `text` is not nested deeper than kMaxNesting.
toml::table parse_json_tables(std::string_view text, const std::filesystem::path& file);

}  // namespace swell::scene
