// Files that the programs write: whole, or not there, also when a signal ends the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "texture/image/output_folder.h"

namespace swell::apps {

// Throws texture::FileError with the path and what is wrong with it.
[[noreturn]] void refuse_output(const std::filesystem::path& path, std::string_view what);

// Throws texture::FileError if no file can be written to `path`: directory missing or
// not writable, path is a directory or too long. Removes what killed runs left in the directory.
void check_output_place(const std::filesystem::path& path);

// texture::write_file(). A signal that ends the program meanwhile (Ctrl-C, SIGTERM, SIGHUP, ...;
// not one that the program ignores or handles) still ends it, with no temporary file left. One
// call at a time.
void write_output(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

// Writes a file likewise, in a folder below which no link is followed.
void write_output(const texture::OutputFolder& folder, const std::string& name,
                  std::span<const std::uint8_t> bytes);

}  // namespace swell::apps
