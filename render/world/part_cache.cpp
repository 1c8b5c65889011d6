#include "render/world/part_cache.h"

#include <elf.h>
#include <fmt/core.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "math/stop.h"
#include "scene/terrain.h"

namespace swell::render {
namespace {

namespace fs = std::filesystem;

// The linker's hash of the program or library that this code is in; empty: it has none.
std::string build_id() {
  struct Found {
    ElfW(Addr) here;
    std::string id;
  } found = {reinterpret_cast<ElfW(Addr)>(&default_cache_folder), {}};
  const auto look = [](dl_phdr_info* object, std::size_t, void* data) {
    auto& [here, id] = *static_cast<Found*>(data);
    const std::span headers(object->dlpi_phdr, object->dlpi_phnum);
    const auto holds_this = [&](const ElfW(Phdr) & part) {
      const ElfW(Addr) begin = object->dlpi_addr + part.p_vaddr;
      return part.p_type == PT_LOAD && here >= begin && here - begin < part.p_memsz;
    };
    if (std::ranges::none_of(headers, holds_this)) return 0;
    for (const ElfW(Phdr) & part : headers) {
      if (part.p_type != PT_NOTE) continue;
      const char* at = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
      const char* const end = at + part.p_memsz;
      while (at + sizeof(ElfW(Nhdr)) <= end) {
        const auto& note = *reinterpret_cast<const ElfW(Nhdr)*>(at);
        const auto aligned = [](std::size_t size) { return (size + 3) / 4 * 4; };
        const char* const content = at + sizeof note + aligned(note.n_namesz);
        if (note.n_type == NT_GNU_BUILD_ID) id.assign(content, note.n_descsz);
        at = content + aligned(note.n_descsz);
      }
    }
    return 1;
  };
  dl_iterate_phdr(look, &found);
  return found.id;
}

// Nothing of a file that is not there.
void add_content(const fs::path& path, StreamHash& to) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> bytes(std::size_t{1} << 20);
  while (file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || file.gcount() > 0)
    to.add(bytes.data(), static_cast<std::size_t>(file.gcount()));
}

// Of the files that parts with fields() are made of.
ValueHash hash_of_files(const scene::Scene& scene) {
  StreamHash hash;
  const auto add = [&](const fs::path& path) {
    if (!path.empty()) add_content(path, hash);
  };
  if (scene.terrain) {
    add(scene.terrain->height_image);
    add(scene.terrain->boundary);
  }
  for (const terrain::TreeStand& stand : scene.trees) add(stand.density_map);
  return hash.hash();
}

// Makes the folder if need be.
bool belongs_to_user(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder.parent_path(), error);
  ::mkdir(folder.c_str(), S_IRWXU);
  struct stat info {};
  return ::stat(folder.c_str(), &info) == 0 && info.st_uid == ::geteuid() && S_ISDIR(info.st_mode);
}

}  // namespace

fs::path default_cache_folder() {
  const auto variable = [](const char* name) {
    const char* const text = std::getenv(name);
    return fs::path(text != nullptr && text[0] == '/' ? text : "");
  };
  if (const fs::path caches = variable("XDG_CACHE_HOME"); !caches.empty()) return caches / "swell";
  const fs::path home = variable("HOME");
  return home.empty() ? fs::path() : home / ".cache/swell";
}

PartCache::PartCache(fs::path folder, const scene::Scene& scene) {
  static const std::string program = build_id();
  if (folder.empty() || program.empty() || !belongs_to_user(folder)) return;
  folder_ = std::move(folder);
  files_and_program_ = ValueBytes().add(program).add(hash_of_files(scene)).hash();
}

PartCache::~PartCache() {
  stop_ = true;
  wait();
}

void PartCache::wait() {
  const std::scoped_lock lock(mutex_);
  if (last_.valid()) last_.wait();
}

void PartCache::in_background(std::function<void()> work) {
  const std::scoped_lock lock(mutex_);
  auto in_order = [this, before = std::move(last_), work = std::move(work)] {
    if (before.valid()) before.wait();
    const ScopedStop stoppable(&stop_);
    check_stop();
    work();
  };
  try {
    last_ = std::async(std::launch::async, std::move(in_order));
  } catch (const std::system_error&) {
    // No thread is to be had: nothing is kept.
  }
}

void PartCache::trim(std::uintmax_t most) {
  if (folder_.empty()) return;
  in_background([this, most] { trim_folder(folder_, most); });
}

void PartCache::trim_folder(const fs::path& folder, std::uintmax_t most) {
  struct Kept {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path path;
  };
  std::vector<Kept> all;
  std::uintmax_t bytes = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".part") continue;
    all.push_back({entry.last_write_time(error), file_size(entry.path()), entry.path()});
    bytes += all.back().bytes;
  }
  std::ranges::sort(all, {}, &Kept::used);
  for (const Kept& kept : all) {
    if (bytes <= most) break;
    fs::remove(kept.path, error);
    bytes -= kept.bytes;
  }
}

fs::path PartCache::path_of(const ValueHash& key) const {
  const ValueHash name = ValueBytes().add(files_and_program_).add(key).hash();
  return folder_ / fmt::format("{:016x}{:016x}.part", name.high, name.low);
}

std::uintmax_t PartCache::file_size(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  return error ? 0 : bytes;
}

void PartCache::note_use(const fs::path& path) {
  std::error_code error;
  fs::last_write_time(path, fs::file_time_type::clock::now(), error);
}

PartCache::NewFile::NewFile(fs::path path) : path_(std::move(path)) {
  static std::atomic<int> count = 0;
  unfinished_ = path_;
  unfinished_.replace_extension(fmt::format(".{}.{}.part", ::getpid(), count++));
  stream_.open(unfinished_, std::ios::binary);
}

PartCache::NewFile::~NewFile() {
  std::error_code error;
  if (!unfinished_.empty()) fs::remove(unfinished_, error);
}

void PartCache::NewFile::finish() {
  stream_.close();
  std::error_code error;
  if (stream_) fs::rename(unfinished_, path_, error);
  if (stream_ && !error) unfinished_.clear();
}

}  // namespace swell::render
