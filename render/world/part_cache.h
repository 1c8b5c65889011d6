// Parts of worlds in files of a folder, for other processes of this program: a world that was made
// before is there again in a fraction of the time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <type_traits>

#include "math/archive.h"
#include "math/value_hash.h"
#include "scene/scene.h"

namespace swell::render {

// Where programs keep parts: in $XDG_CACHE_HOME/swell, or ~/.cache/swell. Empty: nowhere.
std::filesystem::path default_cache_folder();

// A file holds one part. Its name is a hash of what the part is made of, contents of files
// included, and of this very program, so that another build finds nothing. It is there whole or not
// at all, and ends with a hash of its bytes. Any number of processes may use a folder at once. It
// belongs to one user: nothing is kept in the folder of another. A cache never fails: what cannot
// be read is made, what cannot be written is not kept.
class PartCache {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{2} << 30;

  // For parts of this scene. folder: made when something is kept; empty: keeps nothing.
  PartCache(std::filesystem::path folder, const scene::Scene& scene);
  // Takes what was used least from the folder, until it holds at most `most` bytes.
  void trim(std::uintmax_t most = kMostBytes) const;

  // key: of what the part is made of, files by their names.
  template <class Part>
  std::optional<Part> find(const ValueHash& key) const {
    if (folder_.empty()) return std::nullopt;
    const std::filesystem::path path = path_of(key);
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    std::optional<Part> part(std::in_place);
    try {
      ArchiveReader reader(file, file_size(path));
      reader.add(*part);
      reader.bytes().finish();
    } catch (const ArchiveError&) {
      return std::nullopt;
    }
    note_use(path);
    return part;
  }

  template <class Part>
  void keep(const ValueHash& key, Part& part) const {
    if (folder_.empty()) return;
    NewFile file(path_of(key));
    ArchiveWriter writer(file.stream());
    writer.add(part);
    writer.bytes().finish();
    file.finish();
  }

 private:
  // A file that has its name once it is whole.
  class NewFile {
   public:
    explicit NewFile(std::filesystem::path path);
    ~NewFile();
    std::ostream& stream() { return stream_; }
    void finish();

   private:
    std::filesystem::path path_, unfinished_;
    std::ofstream stream_;
  };

  std::filesystem::path path_of(const ValueHash& key) const;
  static std::uintmax_t file_size(const std::filesystem::path& path);  // 0: none
  static void note_use(const std::filesystem::path& path);

  std::filesystem::path folder_;
  ValueHash files_and_program_;
};

}  // namespace swell::render
