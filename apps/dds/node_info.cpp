#include "apps/dds/node_info.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace swell::apps {
namespace {

// Little endian, numbers aligned to four bytes from behind the first four.
struct Cdr {
  void add(std::uint32_t number) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    for (int shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  }
  void add(std::string_view text) {
    add(static_cast<std::uint32_t>(text.size() + 1));
    std::ranges::copy(text, std::back_inserter(bytes));
    bytes.push_back(0);
  }
  void add(const dds_guid_t& guid) {
    const std::size_t end = bytes.size() + gid_bytes;
    std::ranges::copy(guid.v, std::back_inserter(bytes));
    bytes.resize(end);
  }
  void add(const std::vector<dds_guid_t>& guids) {
    add(static_cast<std::uint32_t>(guids.size()));
    for (const dds_guid_t& guid : guids) add(guid);
  }

  std::size_t gid_bytes;
  std::vector<std::uint8_t> bytes{0, 1, 0, 0};
};

}  // namespace

std::vector<std::uint8_t> node_info_bytes(const NodeInfo& node, std::size_t gid_bytes) {
  Cdr cdr = {.gid_bytes = gid_bytes};
  cdr.add(node.participant);
  cdr.add(std::uint32_t{1});  // nodes
  cdr.add(std::string_view("/"));
  cdr.add(std::string_view(node.name));
  cdr.add(node.readers);
  cdr.add(node.writers);
  return cdr.bytes;
}

}  // namespace swell::apps
