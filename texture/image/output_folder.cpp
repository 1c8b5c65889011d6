#include "texture/image/output_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "texture/image/file_bytes.h"

namespace swell::texture {
namespace {

namespace fs = std::filesystem;

// "images/000001.png" as folder and name.
std::pair<std::string, std::string> split(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  if (slash == std::string::npos) return {"", name};
  return {name.substr(0, slash), name.substr(slash + 1)};
}

std::string fault_of(int error) {
  // O_NOFOLLOW and O_DIRECTORY together.
  if (error == ELOOP || error == ENOTDIR) return "not a folder, or a link to one";
  return reason(error);
}

// All bytes of an open file; nothing on a read error.
std::optional<std::vector<std::uint8_t>> read_all(int file, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t got = ::read(file, bytes.data() + filled, size - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return std::nullopt;
    filled += static_cast<std::size_t>(got);
  }
  return bytes;
}

}  // namespace

OutputFolder::OutputFolder(fs::path path)
    : path_(std::move(path)), folder_(::open(path_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0)
    fail(path_, "folder, got '{}', allowed one that can be written to", reason(errno));
}

OutputFolder::~OutputFolder() { ::close(folder_); }

int OutputFolder::open_inner(const std::string& folder, int flags) const {
  // O_NOFOLLOW is about the last name alone.
  if (folder.find('/') != std::string::npos || folder == "..") {
    errno = EINVAL;
    return -1;
  }
  return ::openat(folder_, folder.empty() ? "." : folder.c_str(),
                  flags | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

void OutputFolder::make(const std::string& folder) const {
  const auto refuse = [&](const std::string& got) {
    fail(folder.empty() ? path_ : path_ / folder,
         "folder of files, got '{}', allowed one that can be written to", got);
  };
  if (!folder.empty() && ::mkdirat(folder_, folder.c_str(), 0777) != 0 && errno != EEXIST)
    refuse(reason(errno));
  const Descriptor inner(open_inner(folder, O_PATH));
  if (inner.get() < 0) refuse(fault_of(errno));
  if (::faccessat(inner.get(), ".", W_OK | X_OK, AT_EACCESS) != 0) refuse(reason(errno));
  remove_abandoned_files(fmt::format("/proc/self/fd/{}", inner.get()));
}

void OutputFolder::write(const std::string& name, std::span<const std::uint8_t> bytes) const {
  const auto [folder, file] = split(name);
  const Descriptor inner(open_inner(folder, O_PATH));
  if (inner.get() < 0) fail(path_ / name, "cannot write: its folder is {}", fault_of(errno));
  write_file_in(inner.get(), file, path_ / name, bytes);
}

std::optional<std::vector<std::uint8_t>> OutputFolder::read(const std::string& name) const {
  const auto [folder, file] = split(name);
  const Descriptor inner(open_inner(folder, O_PATH));
  if (inner.get() < 0) return std::nullopt;
  const Descriptor open(::openat(inner.get(), file.c_str(),
                                 O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat status;
  if (open.get() < 0 || ::fstat(open.get(), &status) != 0 || !S_ISREG(status.st_mode))
    return std::nullopt;
  return read_all(open.get(), static_cast<std::size_t>(status.st_size));
}

std::vector<std::string> OutputFolder::names(const std::string& folder) const {
  std::vector<std::string> names;
  const int inner = open_inner(folder, O_RDONLY);
  DIR* const entries = inner < 0 ? nullptr : ::fdopendir(inner);
  if (!entries && inner >= 0) ::close(inner);
  if (!entries) return names;
  while (const dirent* entry = ::readdir(entries)) names.emplace_back(entry->d_name);
  ::closedir(entries);
  std::erase_if(names, [](const std::string& name) { return name == "." || name == ".."; });
  std::ranges::sort(names);
  return names;
}

}  // namespace swell::texture
