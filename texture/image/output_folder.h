// A folder that files are written to and read from, below which no symbolic link is followed.
//
//   const OutputFolder set("out/harbour");           // links on the way to it are fine
//   set.make("images");                               // a link of that name is refused
//   set.write("images/000001.png", bytes);            // a link of that name is replaced
//   set.read("images/000001.png");                    // nothing, were it a link
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "texture/image/image_io.h"

namespace swell::texture {

class OutputFolder {
 public:
  // Opens the folder, which is the same from here on whatever its path comes to name. Throws
  // FileError if there is none.
  explicit OutputFolder(std::filesystem::path path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Makes a folder in it where there is none, and checks that files can be written there. Removes
  // what killed runs left in it. "" checks this folder itself. Throws FileError.
  void make(const std::string& folder) const;

  // write_file() to "a.json" or "images/000001.png": of a name, or of one in a folder of it.
  void write(const std::string& name, std::span<const std::uint8_t> bytes) const;

  // The bytes of a regular file of such a name; nothing if there is none, or a link on the way.
  std::optional<std::vector<std::uint8_t>> read(const std::string& name) const;

  // The names in a folder of it, sorted; none if there is no such folder.
  std::vector<std::string> names(const std::string& folder) const;

 private:
  // A descriptor of a folder in it, or -1 and errno.
  int open_inner(const std::string& folder, int flags) const;

  std::filesystem::path path_;
  int folder_ = -1;
};

// write_file() to a name in an open folder; `path` is for messages.
void write_file_in(int folder, const std::string& name, const std::filesystem::path& path,
                   std::span<const std::uint8_t> bytes);

}  // namespace swell::texture
