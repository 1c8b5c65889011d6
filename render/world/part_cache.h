// Parts of worlds in files of a folder, for other processes of this program: a world that was made
// before is there again in a fraction of the time.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

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
// be read is made, what cannot be written is not kept. Files are written by a thread beside those
// that make and draw: a part must not change while it is.
class PartCache {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{2} << 30;

  // For parts of this scene. folder: made when something is kept; empty: keeps nothing.
  PartCache(std::filesystem::path folder, const scene::Scene& scene);
  ~PartCache();  // gives up what is not yet written

  // Waits until the folder is as keep() and trim() leave it.
  void wait();

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

  // Begins to write a part. Several threads may at once.
  template <class Part>
  void keep(const ValueHash& key, std::shared_ptr<Part> part) {
    if (folder_.empty()) return;
    in_background([path = path_of(key), part = std::move(part)] {
      NewFile file(path);
      ArchiveWriter writer(file.stream());
      writer.add(*part);
      writer.bytes().finish();
      file.finish();
    });
  }

  // Then takes what was used least from the folder, until it holds at most `most` bytes.
  void trim(std::uintmax_t most = kMostBytes);

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

  void in_background(std::function<void()> work);
  static void trim_folder(const std::filesystem::path& folder, std::uintmax_t most);
  std::filesystem::path path_of(const ValueHash& key) const;
  static std::uintmax_t file_size(const std::filesystem::path& path);  // 0: none
  static void note_use(const std::filesystem::path& path);

  std::filesystem::path folder_;
  ValueHash files_and_program_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::future<void> last_;  // each waits for the one before it
};

}  // namespace swell::render
