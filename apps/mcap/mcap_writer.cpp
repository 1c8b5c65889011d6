#include "apps/mcap/mcap_writer.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "apps/mcap/mcap_record.h"
#include "apps/mcap/partial_file.h"

namespace swell::apps {
namespace {

using Map = std::map<std::uint16_t, std::uint64_t>;  // by channel

// A chunk ends with the message that fills it. Both decide the file's bytes.
constexpr std::size_t kChunkBytes = 1 << 20;
constexpr int kZstdLevel = 1;  // a camera's picture of 640 x 360 in 3 ms

constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
constexpr std::string_view kCompression = "zstd";

std::uint16_t channel_id(std::size_t channel) { return static_cast<std::uint16_t>(channel); }
std::uint16_t schema_id(std::size_t schema) { return static_cast<std::uint16_t>(schema + 1); }

McapBytes map_bytes(const Map& map) {
  McapBytes bytes;
  for (const auto& [channel, number] : map)
    bytes.number<std::uint16_t>(channel).number<std::uint64_t>(number);
  return bytes;
}

void add_schemas(const McapContents& contents, McapBytes& to) {
  for (std::size_t s = 0; s < contents.schemas.size(); ++s) {
    const McapSchema& schema = contents.schemas[s];
    to.record(McapOpcode::kSchema, McapBytes()
                                       .number<std::uint16_t>(schema_id(s))
                                       .text(schema.name)
                                       .text(schema.encoding)
                                       .text(schema.text));
  }
}

void add_channels(const McapContents& contents, McapBytes& to) {
  for (std::size_t c = 0; c < contents.channels.size(); ++c) {
    const McapChannel& channel = contents.channels[c];
    McapBytes metadata;
    for (const auto& [key, value] : channel.metadata) metadata.text(key).text(value);
    to.record(McapOpcode::kChannel, McapBytes()
                                        .number<std::uint16_t>(channel_id(c))
                                        .number<std::uint16_t>(schema_id(channel.schema))
                                        .text(channel.topic)
                                        .text(channel.encoding)
                                        .list(metadata));
  }
}

}  // namespace

struct McapWriter::State {
  struct Compressor {
    Compressor() : context(ZSTD_createCCtx()) {
      if (!context) throw std::bad_alloc();
    }
    ~Compressor() { ZSTD_freeCCtx(context); }
    Compressor(const Compressor&) = delete;
    Compressor& operator=(const Compressor&) = delete;

    std::span<const std::uint8_t> compress(std::span<const std::uint8_t> bytes) {
      buffer.resize(ZSTD_compressBound(bytes.size()));
      const std::size_t size = ZSTD_compressCCtx(context, buffer.data(), buffer.size(),
                                                 bytes.data(), bytes.size(), kZstdLevel);
      if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
      return std::span(buffer).first(size);
    }

    ZSTD_CCtx* context;
    std::vector<std::uint8_t> buffer;
  };

  // From the first message to the last one.
  struct TimeSpan {
    std::uint64_t begin_ns = 0, end_ns = 0;
    bool is_empty = true;
    void add(std::uint64_t t_ns) {
      begin_ns = is_empty ? t_ns : std::min(begin_ns, t_ns);
      end_ns = is_empty ? t_ns : std::max(end_ns, t_ns);
      is_empty = false;
    }
  };

  // Messages that are not yet in the file.
  struct Chunk {
    McapBytes records;
    TimeSpan time;
    std::map<std::uint16_t, McapBytes> index;  // of a channel: time and place of each message
  };

  State(const std::filesystem::path& path, McapContents&& given)
      : contents(std::move(given)), file(path), counts(contents.channels.size()) {}

  void write_chunk();
  void write_summary();

  McapContents contents;
  PartialFile file;
  Compressor compressor;
  Chunk chunk;
  std::vector<std::uint64_t> counts;  // of messages, by channel
  TimeSpan time;
  std::uint32_t chunks = 0;
  McapBytes chunk_indexes;
};

// The chunk and the places of its messages behind it, by one write.
void McapWriter::State::write_chunk() {
  if (chunk.records.size() == 0) return;
  const std::span<const std::uint8_t> records = chunk.records.get();
  const auto crc = static_cast<std::uint32_t>(::crc32_z(0, records.data(), records.size()));
  const std::span<const std::uint8_t> compressed = compressor.compress(records);
  McapBytes head, bytes;
  head.number<std::uint64_t>(chunk.time.begin_ns)
      .number<std::uint64_t>(chunk.time.end_ns)
      .number<std::uint64_t>(records.size())
      .number<std::uint32_t>(crc)
      .text(kCompression)
      .number<std::uint64_t>(compressed.size());
  bytes.head(McapOpcode::kChunk, head.size() + compressed.size()).bytes(head.get());
  bytes.bytes(compressed);
  const std::size_t chunk_size = bytes.size();
  Map index_places;
  for (const auto& [channel, index] : chunk.index) {
    index_places[channel] = file.size() + bytes.size();
    bytes.record(McapOpcode::kMessageIndex, McapBytes().number<std::uint16_t>(channel).list(index));
  }
  const std::uint64_t place = file.size();
  file.write(bytes.get());
  chunk_indexes.record(McapOpcode::kChunkIndex,
                       McapBytes()
                           .number<std::uint64_t>(chunk.time.begin_ns)
                           .number<std::uint64_t>(chunk.time.end_ns)
                           .number<std::uint64_t>(place)
                           .number<std::uint64_t>(chunk_size)
                           .list(map_bytes(index_places))
                           .number<std::uint64_t>(bytes.size() - chunk_size)
                           .text(kCompression)
                           .number<std::uint64_t>(compressed.size())
                           .number<std::uint64_t>(records.size()));
  ++chunks;
  chunk = {};
}

// All that a reader needs to find messages, and where each kind of it begins.
void McapWriter::State::write_summary() {
  Map channel_counts;
  std::uint64_t messages = 0;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    channel_counts[channel_id(c)] = counts[c];
    messages += counts[c];
  }
  McapBytes statistics;
  statistics.number<std::uint64_t>(messages)
      .number<std::uint16_t>(static_cast<std::uint16_t>(contents.schemas.size()))
      .number<std::uint32_t>(static_cast<std::uint32_t>(contents.channels.size()))
      .number<std::uint32_t>(0)  // attachments
      .number<std::uint32_t>(0)  // metadata
      .number<std::uint32_t>(chunks)
      .number<std::uint64_t>(time.begin_ns)
      .number<std::uint64_t>(time.end_ns)
      .list(map_bytes(channel_counts));
  const std::uint64_t begin = file.size();
  McapBytes bytes, offsets;
  const auto add_group = [&](McapOpcode opcode, const auto& add) {
    const std::size_t before = bytes.size();
    add();
    if (bytes.size() == before) return;
    offsets.record(McapOpcode::kSummaryOffset,
                   McapBytes()
                       .number<std::uint8_t>(static_cast<std::uint8_t>(opcode))
                       .number<std::uint64_t>(begin + before)
                       .number<std::uint64_t>(bytes.size() - before));
  };
  add_group(McapOpcode::kSchema, [&] { add_schemas(contents, bytes); });
  add_group(McapOpcode::kChannel, [&] { add_channels(contents, bytes); });
  add_group(McapOpcode::kStatistics, [&] { bytes.record(McapOpcode::kStatistics, statistics); });
  add_group(McapOpcode::kChunkIndex, [&] { bytes.bytes(chunk_indexes.get()); });
  const std::uint64_t offsets_begin = begin + bytes.size();
  bytes.bytes(offsets.get());
  // The footer's CRC is that of the summary and of the footer up to it.
  constexpr std::uint64_t kFooterSize = 8 + 8 + 4;
  bytes.head(McapOpcode::kFooter, kFooterSize)
      .number<std::uint64_t>(begin)
      .number<std::uint64_t>(offsets_begin);
  const auto crc = static_cast<std::uint32_t>(::crc32_z(0, bytes.get().data(), bytes.size()));
  file.write(bytes.number<std::uint32_t>(crc).bytes(kMagic).get());
}

McapWriter::McapWriter(const std::filesystem::path& path, McapContents contents)
    : state_(std::make_unique<State>(path, std::move(contents))) {
  McapBytes bytes;
  bytes.bytes(kMagic);
  bytes.record(McapOpcode::kHeader,
               McapBytes().text(state_->contents.profile).text(state_->contents.library));
  // Here and not in chunks, so that each chunk can be read whichever others are lost.
  add_schemas(state_->contents, bytes);
  add_channels(state_->contents, bytes);
  state_->file.write(bytes.get());
}

McapWriter::~McapWriter() = default;

void McapWriter::add(std::size_t channel, std::int64_t t_ns, std::span<const std::uint8_t> bytes) {
  const auto t = static_cast<std::uint64_t>(t_ns);
  State::Chunk& chunk = state_->chunk;
  chunk.index[channel_id(channel)].number<std::uint64_t>(t).number<std::uint64_t>(
      chunk.records.size());
  McapBytes head;
  head.number<std::uint16_t>(channel_id(channel))
      .number<std::uint32_t>(static_cast<std::uint32_t>(state_->counts.at(channel)++))
      .number<std::uint64_t>(t)   // of logging
      .number<std::uint64_t>(t);  // of publishing
  chunk.records.head(McapOpcode::kMessage, head.size() + bytes.size())
      .bytes(head.get())
      .bytes(bytes);
  chunk.time.add(t);
  state_->time.add(t);
  if (chunk.records.size() >= kChunkBytes) state_->write_chunk();
}

void McapWriter::finish() {
  state_->write_chunk();
  const std::uint32_t crc = state_->file.crc();
  state_->file.write(
      McapBytes().record(McapOpcode::kDataEnd, McapBytes().number<std::uint32_t>(crc)).get());
  state_->write_summary();
  state_->file.finish();
}

}  // namespace swell::apps
