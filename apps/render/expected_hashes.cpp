#include "apps/render/expected_hashes.h"

#include <fmt/core.h>

#include <fstream>
#include <string_view>

#include "apps/render/frame_record.h"
#include "texture/image/image_io.h"

namespace swell::apps {
namespace {

constexpr std::size_t kShownCharacters = 100;  // of a line, in a message

[[noreturn]] void refuse_line(const std::string& file, int line, std::string_view what,
                              std::string_view got, std::string_view allowed) {
  throw texture::FileError(fmt::format("{}:{}: {}, got '{}', allowed {}", file, line, what,
                                       got.substr(0, kShownCharacters), allowed));
}

std::ifstream open_text(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream file;
  if (std::filesystem::is_regular_file(path, ignored)) file.open(path, std::ios::binary);
  if (!file.is_open())
    throw texture::FileError(fmt::format(
        "{}: file of expected hashes, got none that can be read, allowed the output of --hash or "
        "--json",
        path.string()));
  return file;
}

}  // namespace

ExpectedHashes::ExpectedHashes(const std::filesystem::path& path) : file_(path.string()) {
  std::ifstream file = open_text(path);
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const auto frame_hash = parse_frame_line(line);
    if (!frame_hash)
      refuse_line(file_, number, "hash of a frame", line,
                  "'frame N xxh3 HASH' with 16 hex digits, or a line of --json");
    const auto [place, is_new] = hashes_.emplace(frame_hash->frame, frame_hash->hash);
    if (!is_new && place->second != frame_hash->hash)
      refuse_line(file_, number, fmt::format("second hash of frame {}", frame_hash->frame), line,
                  fmt::format("the first one, {:016x}", place->second));
  }
  if (file.bad()) throw texture::FileError(fmt::format("{}: read error", file_));
}

std::string ExpectedHashes::fault(int frame, std::uint64_t found) const {
  const auto place = hashes_.find(frame);
  if (place == hashes_.end())
    return fmt::format("frame {}: expected no hash, as {} has none for it, found xxh3 {:016x}",
                       frame, file_, found);
  if (place->second == found) return "";
  return fmt::format("frame {}: expected xxh3 {:016x} from {}, found xxh3 {:016x}", frame,
                     place->second, file_, found);
}

}  // namespace swell::apps
