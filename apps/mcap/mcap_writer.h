// MCAP files: messages of many topics in chunks of their time, with an index and a summary.
//
//   McapWriter writer("run.mcap", {"ros2", "swell", schemas, channels});
//   writer.add(channel, t_ns, bytes);
//   writer.finish();
//
// Source: mcap.dev, MCAP format specification, version 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace swell::apps {

struct McapSchema {
  std::string name, encoding, text;
};

struct McapChannel {
  std::size_t schema = 0;  // its index
  std::string topic, encoding;
  std::vector<std::pair<std::string, std::string>> metadata = {};
};

struct McapContents {
  std::string profile, library;
  std::vector<McapSchema> schemas;    // at most 65535
  std::vector<McapChannel> channels;  // at most 65535
};

// The file is PATH.partial until finish() gives it its name. What ends before that leaves
// PATH.partial with all chunks that were written, which readers recover. The bytes depend on what
// is added alone, with one version of zstd. Used by one thread at a time.
class McapWriter {
 public:
  // Begins the file; one that is there is replaced at the end. Throws texture::FileError, as do the
  // others: where the disk is full the chunks that have been written stay.
  McapWriter(const std::filesystem::path& path, McapContents contents);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  // A message, at most 2 GiB, of a channel (its index) at a time of at least 0.
  void add(std::size_t channel, std::int64_t t_ns, std::span<const std::uint8_t> bytes);

  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swell::apps
