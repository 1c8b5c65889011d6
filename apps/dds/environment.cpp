#include "apps/dds/environment.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/shared/parse_number.h"
#include "apps/shared/program.h"

namespace swell::apps {
namespace {

[[noreturn]] void refuse_variable(const char* name, const std::string& value,
                                  std::string_view allowed) {
  throw OptionError(fmt::format("{}: got '{}', allowed {}", name, value.substr(0, 100), allowed));
}

std::uint32_t domain_of(const std::string& value) {
  if (value.empty()) return 0;
  const auto number = parse_number<std::uint32_t>(value);
  if (!number || *number > 232) refuse_variable("ROS_DOMAIN_ID", value, "0 to 232");
  return *number;
}

DiscoveryRange range_of(const std::string& value) {
  static constexpr std::array<std::pair<std::string_view, DiscoveryRange>, 5> kRanges = {{
      {"", DiscoveryRange::kSubnet},
      {"OFF", DiscoveryRange::kOff},
      {"LOCALHOST", DiscoveryRange::kThisMachine},
      {"SUBNET", DiscoveryRange::kSubnet},
      {"SYSTEM_DEFAULT", DiscoveryRange::kSystemDefault},
  }};
  for (const auto& [name, range] : kRanges)
    if (value == name) return range;
  refuse_variable("ROS_AUTOMATIC_DISCOVERY_RANGE", value,
                  "OFF, LOCALHOST, SUBNET or SYSTEM_DEFAULT");
}

bool is_address(std::string_view text) {
  const auto is_right = [](char c) {
    return (c >= '0' && c <= '9') || ((c | 0x20) >= 'a' && (c | 0x20) <= 'z') || c == '.' ||
           c == '-' || c == ':' || c == '[' || c == ']' || c == '%' || c == '_';
  };
  return text.size() <= 255 && std::ranges::all_of(text, is_right);
}

std::vector<std::string> peers_of(const std::string& value) {
  std::vector<std::string> peers;
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t end = std::min(value.find(';', at), value.size());
    const std::string peer = value.substr(at, end - at);
    if (!is_address(peer))
      refuse_variable("ROS_STATIC_PEERS", value, "names or addresses of hosts with ; between them");
    if (!peer.empty()) peers.push_back(peer);
    at = end + 1;
  }
  return peers;
}

std::size_t gid_bytes_of(const std::string& distribution) {
  static constexpr std::array<std::string_view, 5> kFirst = {"", "eloquent", "foxy", "galactic",
                                                             "humble"};
  return std::ranges::count(kFirst, distribution) > 0 ? 24 : 16;
}

std::string element(std::string_view name, std::string_view content) {
  return fmt::format("<{0}>{1}</{0}>", name, content);
}

// How others are found; the numbers are those of ROS 2's nodes, which find each other by them.
std::string discovery(DiscoveryRange range, std::vector<std::string> peers) {
  if (range == DiscoveryRange::kOff)
    return element("ParticipantIndex", "none") +
           element("Tag", fmt::format("ros_discovery_off_{}", ::getpid()));
  std::string text = element("ParticipantIndex", "auto") + element("MaxAutoParticipantIndex", "32");
  if (range == DiscoveryRange::kThisMachine) peers.insert(peers.begin(), "localhost");
  std::string list;
  for (const std::string& peer : peers) list += fmt::format("<Peer address=\"{}\"/>", peer);
  return list.empty() ? text : text + element("Peers", list);
}

// Without multicast.
bool is_quiet(const DdsEnvironment& environment) {
  return !environment.is_loopback_alone && (environment.range == DiscoveryRange::kOff ||
                                            environment.range == DiscoveryRange::kThisMachine);
}

}  // namespace

DdsEnvironment read_dds_environment(const std::function<std::string(const char*)>& variable,
                                    bool is_ordered) {
  DdsEnvironment environment;
  environment.domain = domain_of(variable("ROS_DOMAIN_ID"));
  environment.range = range_of(variable("ROS_AUTOMATIC_DISCOVERY_RANGE"));
  environment.gid_bytes = gid_bytes_of(variable("ROS_DISTRO"));
  const std::string localhost = variable("ROS_LOCALHOST_ONLY");
  if (localhost != "" && localhost != "0" && localhost != "1")
    refuse_variable("ROS_LOCALHOST_ONLY", localhost, "0 or 1");
  environment.is_loopback_alone = localhost == "1";
  std::vector<std::string> peers = peers_of(variable("ROS_STATIC_PEERS"));
  if (environment.is_loopback_alone) {
    environment.range = DiscoveryRange::kThisMachine;
    peers.clear();
  }

  // A loopback interface that can multicast does: Humble's nodes find each other there by it.
  std::string general, found;
  if (environment.is_loopback_alone)
    general = element("Interfaces", "<NetworkInterface address=\"127.0.0.1\"/>");
  if (is_quiet(environment))
    general += element("AllowMulticast", "false");
  else if (is_ordered)
    general += element("AllowMulticast", "spdp");
  if (environment.range != DiscoveryRange::kSystemDefault)
    found = element("Discovery", discovery(environment.range, peers));
  if (!general.empty() || !found.empty())
    environment.configuration =
        element("CycloneDDS", element("Domain", element("General", general) + found));
  const std::string own = variable("CYCLONEDDS_URI");
  if (!own.empty()) {
    if (!environment.configuration.empty()) environment.configuration += ",";
    environment.configuration += own;
  }
  return environment;
}

}  // namespace swell::apps
