// A command line's manual page and shell completion, from the same options as its help.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace swell::apps {

// In roff's man macros, of section 1.
std::string manual_page(const CLI::App& app, const std::string& version);

// For bash: options, modes, and files after options that take one.
std::string bash_completion(const CLI::App& app);

}  // namespace swell::apps
