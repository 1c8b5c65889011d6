// What ROS 2's environment variables make of DDS.
#include "apps/dds/environment.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "apps/dds/node_info.h"
#include "apps/shared/program.h"

namespace swell::apps {
namespace {

DdsEnvironment read(const std::map<std::string, std::string>& variables, bool is_ordered = false) {
  return read_dds_environment(
      [&](const char* name) {
        const auto found = variables.find(name);
        return found == variables.end() ? std::string() : found->second;
      },
      is_ordered);
}

bool says(const DdsEnvironment& environment, const char* text) {
  return environment.configuration.find(text) != std::string::npos;
}

TEST(DdsEnvironment, IsTheSubnetOfDomain0UnlessItSaysOtherwise) {
  const DdsEnvironment plain = read({});
  EXPECT_EQ(plain.domain, 0u);
  EXPECT_EQ(plain.range, DiscoveryRange::kSubnet);
  EXPECT_FALSE(plain.is_loopback_alone);
  EXPECT_FALSE(says(plain, "AllowMulticast"));
  EXPECT_FALSE(says(plain, "Peer "));
  EXPECT_TRUE(says(plain, "<MaxAutoParticipantIndex>32<"));
  EXPECT_EQ(read({{"ROS_DOMAIN_ID", "232"}, {"ROS_LOCALHOST_ONLY", "0"}}).domain, 232u);
}

TEST(DdsEnvironment, HasShorterIdentifiersAfterHumble) {
  EXPECT_EQ(read({}).gid_bytes, 24u);
  EXPECT_EQ(read({{"ROS_DISTRO", "humble"}}).gid_bytes, 24u);
  EXPECT_EQ(read({{"ROS_DISTRO", "jazzy"}}).gid_bytes, 16u);
}

TEST(NodeInfo, HasTheBytesThatAreWrittenByHand) {
  NodeInfo node = {.name = "abc"};
  node.participant.v[0] = 7;
  node.writers.resize(1);
  node.writers[0].v[15] = 9;
  std::vector<std::uint8_t> expected = {0, 1, 0, 0, 7};
  expected.resize(4 + 16);
  const std::vector<std::uint8_t> middle = {1, 0, 0, 0,                     // nodes
                                            2, 0, 0, 0, '/', 0,   0,   0,   // up to four bytes
                                            4, 0, 0, 0, 'a', 'b', 'c', 0,   //
                                            0, 0, 0, 0, 1,   0,   0,   0};  // readers, writers
  expected.insert(expected.end(), middle.begin(), middle.end());
  expected.resize(expected.size() + 15);
  expected.push_back(9);
  EXPECT_EQ(node_info_bytes(node, 16), expected);
  EXPECT_EQ(node_info_bytes(node, 24).size(), expected.size() + 2 * 8);
}

TEST(DdsEnvironment, OfThisMachineAloneFindsNobodyElse) {
  const DdsEnvironment near = read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"}});
  EXPECT_TRUE(says(near, "<AllowMulticast>false<"));
  EXPECT_TRUE(says(near, "<Peer address=\"localhost\"/>"));
  EXPECT_FALSE(near.is_loopback_alone);
  // The older variable is stronger.
  const DdsEnvironment alone = read({{"ROS_LOCALHOST_ONLY", "1"},
                                     {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"},
                                     {"ROS_STATIC_PEERS", "10.0.0.1"}});
  EXPECT_TRUE(alone.is_loopback_alone);
  EXPECT_EQ(alone.range, DiscoveryRange::kThisMachine);
  EXPECT_TRUE(says(alone, "<NetworkInterface address=\"127.0.0.1\"/>"));
  EXPECT_FALSE(says(alone, "10.0.0.1"));
}

TEST(DdsEnvironment, MayBeOffOrTheSystemsOwn) {
  const DdsEnvironment off =
      read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}, {"ROS_STATIC_PEERS", "10.0.0.1"}});
  EXPECT_TRUE(says(off, "<Tag>ros_discovery_off_"));
  EXPECT_FALSE(says(off, "10.0.0.1"));
  EXPECT_EQ(read({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SYSTEM_DEFAULT"}}).configuration, "");
}

TEST(DdsEnvironment, TakesNothingButDiscoveryByMulticastWhereOrderCounts) {
  constexpr bool kIsOrdered = true;
  constexpr const char* kRange = "ROS_AUTOMATIC_DISCOVERY_RANGE";
  for (const std::map<std::string, std::string>& variables : {std::map<std::string, std::string>(),
                                                              {{"ROS_LOCALHOST_ONLY", "1"}},
                                                              {{kRange, "SYSTEM_DEFAULT"}}}) {
    EXPECT_TRUE(says(read(variables, kIsOrdered), "<AllowMulticast>spdp<"));
    EXPECT_FALSE(says(read(variables), "AllowMulticast"));
  }
  // Where there is no multicast at all, it is not opened.
  for (const char* range : {"OFF", "LOCALHOST"}) {
    EXPECT_TRUE(says(read({{kRange, range}}, kIsOrdered), "<AllowMulticast>false<"));
    EXPECT_FALSE(says(read({{kRange, range}}, kIsOrdered), "spdp"));
  }
}

TEST(DdsEnvironment, NamesPeersAndEndsWithCyclonesOwnConfiguration) {
  const DdsEnvironment environment =
      read({{"ROS_STATIC_PEERS", "boat-7.local;10.0.0.1;"}, {"CYCLONEDDS_URI", "file:///a.xml"}});
  EXPECT_TRUE(says(environment, "<Peer address=\"boat-7.local\"/><Peer address=\"10.0.0.1\"/>"));
  EXPECT_TRUE(environment.configuration.ends_with(",file:///a.xml"));
}

TEST(DdsEnvironment, RefusesWhatItDoesNotKnowByALine) {
  const std::map<std::string, std::string> faults[] = {
      {{"ROS_DOMAIN_ID", "233"}},
      {{"ROS_DOMAIN_ID", "-1"}},
      {{"ROS_DOMAIN_ID", "7x"}},
      {{"ROS_LOCALHOST_ONLY", "true"}},
      {{"ROS_AUTOMATIC_DISCOVERY_RANGE", "localhost"}},
      {{"ROS_STATIC_PEERS", "a\"/><Peer"}},
  };
  for (const auto& fault : faults) try {
      read(fault);
      ADD_FAILURE() << fault.begin()->first << " " << fault.begin()->second;
    } catch (const OptionError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(fault.begin()->first + ": got '"));
    }
}

}  // namespace
}  // namespace swell::apps
