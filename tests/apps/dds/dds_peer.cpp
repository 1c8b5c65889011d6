// Another process on ROS 2's topics, with types that idlc made of the public definitions:
//   dds_peer read TOPIC=TYPE ...          prints 'TOPIC TYPE STAMP BYTES CRC' of each message until
//                                         standard input ends
//   dds_peer drive BODY_TOPIC REPLY_TOPIC STEPS PERIOD_MS
//                                         steers a body and the clock in lock-step: each step waits
//                                         for the reply (a PoseStamped) of its stamp
//   dds_peer nodes NAME                   waits for a node of this name; then 'publishes TOPIC' and
//                                         'hears TOPIC' of each of its endpoints
//   dds_peer churn COUNT TOPIC=TYPE ...   subscribes and leaves so often
#include <dds/dds.h>
#include <poll.h>
#include <unistd.h>
#include <zlib.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "message_values.h"

namespace swell::dds_test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "dds_peer: %s\n", what.c_str());
  std::exit(1);
}

dds_entity_t made(dds_entity_t entity, const std::string& what) {
  if (entity < 0) fail(what + ": " + dds_strretcode(-entity));
  return entity;
}

// What this program knows of a type.
struct Type {
  const dds_topic_descriptor_t* descriptor;
  std::string (*line)(const void* sample);
};

template <class Message>
std::string line_of(const void* sample) {
  const Message& message = *static_cast<const Message*>(sample);
  Values values;
  values.add(message);
  const auto size = values.bytes().size();
  const auto crc = crc32(0, values.bytes().data(), static_cast<uInt>(size));
  return std::to_string(stamp_ns(message)) + " " + std::to_string(size) + " " + std::to_string(crc);
}

#define SWELL_TYPE(PACKAGE, NAME)                                               \
  {                                                                             \
#PACKAGE "/msg/" #NAME, {                                                   \
      &PACKAGE##_msg_dds__##NAME##__desc, line_of<PACKAGE##_msg_dds__##NAME##_> \
    }                                                                           \
  }
const std::map<std::string, Type> kTypes = {
    SWELL_TYPE(sensor_msgs, Image),         SWELL_TYPE(sensor_msgs, CompressedImage),
    SWELL_TYPE(sensor_msgs, CameraInfo),    SWELL_TYPE(sensor_msgs, PointCloud2),
    SWELL_TYPE(sensor_msgs, Imu),           SWELL_TYPE(sensor_msgs, NavSatFix),
    SWELL_TYPE(sensor_msgs, Range),         SWELL_TYPE(geometry_msgs, PointStamped),
    SWELL_TYPE(geometry_msgs, PoseStamped), SWELL_TYPE(nav_msgs, Odometry),
    SWELL_TYPE(tf2_msgs, TFMessage),        SWELL_TYPE(rosgraph_msgs, Clock),
};
#undef SWELL_TYPE

class Reader {
 public:
  // TOPIC=TYPE: reliable, all messages; of /tf_static those from before, too.
  Reader(dds_entity_t participant, const std::string& choice) {
    const std::size_t at = choice.find('=');
    topic_ = choice.substr(0, at);
    type_name_ = choice.substr(at + 1);
    const auto type = kTypes.find(type_name_);
    if (at == std::string::npos || type == kTypes.end()) fail("no TOPIC=TYPE: " + choice);
    type_ = type->second;
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    if (topic_ == "/tf_static") dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    const dds_entity_t topic = made(
        dds_create_topic(participant, type_.descriptor, ("rt" + topic_).c_str(), nullptr, nullptr),
        topic_);
    entity_ = made(dds_create_reader(participant, topic, qos, nullptr), topic_);
    dds_delete_qos(qos);
    dds_delete(topic);
  }

  // Whether there was one.
  bool take(const std::function<void(const void* sample)>& look) const {
    void* samples[64] = {};
    dds_sample_info_t infos[64];
    const dds_return_t count = dds_take(entity_, samples, infos, 64, 64);
    for (int n = 0; n < count; ++n)
      if (infos[n].valid_data) look(samples[n]);
    if (count > 0) dds_return_loan(entity_, samples, count);
    return count > 0;
  }

  bool print() const {
    return take([&](const void* sample) {
      std::printf("%s %s %s\n", topic_.c_str(), type_name_.c_str(), type_.line(sample).c_str());
    });
  }

  dds_entity_t entity() const { return entity_; }

 private:
  std::string topic_, type_name_;
  Type type_{};
  dds_entity_t entity_ = 0;
};

dds_entity_t join() {
  const char* domain = std::getenv("ROS_DOMAIN_ID");
  const auto number = static_cast<dds_domainid_t>(domain ? std::atoi(domain) : 0);
  return made(dds_create_participant(number, nullptr, nullptr), "participant");
}

bool input_has_ended() {
  pollfd waiting = {STDIN_FILENO, POLLIN, 0};
  char byte;
  return ::poll(&waiting, 1, 0) > 0 && ::read(STDIN_FILENO, &byte, 1) == 0;
}

int read_topics(const std::vector<std::string>& choices) {
  const dds_entity_t participant = join();
  std::vector<Reader> readers;
  for (const std::string& choice : choices) readers.emplace_back(participant, choice);
  std::printf("ready\n");
  std::fflush(stdout);
  for (bool has_ended = false; !has_ended;) {
    has_ended = input_has_ended();
    bool had_one = false;
    for (const Reader& reader : readers) had_one = reader.print() || had_one;
    std::fflush(stdout);
    if (!had_one) std::this_thread::sleep_for(milliseconds(1));
  }
  dds_delete(participant);
  return 0;
}

builtin_interfaces_msg_dds__Time_ time_of(std::int64_t t_ns) {
  return {static_cast<std::int32_t>(t_ns / 1'000'000'000),
          static_cast<std::uint32_t>(t_ns % 1'000'000'000)};
}

template <class Message>
dds_entity_t writer_of(dds_entity_t participant, const std::string& topic,
                       const dds_topic_descriptor_t& descriptor) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  const dds_entity_t its_topic = made(
      dds_create_topic(participant, &descriptor, ("rt" + topic).c_str(), nullptr, nullptr), topic);
  const dds_entity_t writer = made(dds_create_writer(participant, its_topic, qos, nullptr), topic);
  dds_delete_qos(qos);
  return writer;
}

// A boat on a circle, which it goes along once in 20 s.
int drive(const std::string& body_topic, const std::string& reply_topic, int steps, int period_ms) {
  const dds_entity_t participant = join();
  const dds_entity_t clocks = writer_of<rosgraph_msgs_msg_dds__Clock_>(
      participant, "/clock", rosgraph_msgs_msg_dds__Clock__desc);
  const dds_entity_t poses = writer_of<geometry_msgs_msg_dds__PoseStamped_>(
      participant, body_topic, geometry_msgs_msg_dds__PoseStamped__desc);
  const Reader replies(participant, reply_topic + "=geometry_msgs/msg/PoseStamped");
  // Both have found each other half a second after this side has found the other.
  const auto found_by = Clock::now() + std::chrono::seconds(60);
  while (dds_get_matched_subscriptions(poses, nullptr, 0) < 1 ||
         dds_get_matched_subscriptions(clocks, nullptr, 0) < 1 ||
         dds_get_matched_publications(replies.entity(), nullptr, 0) < 1) {
    if (Clock::now() > found_by) fail("nobody to drive");
    std::this_thread::sleep_for(milliseconds(5));
  }
  std::this_thread::sleep_for(milliseconds(500));
  char frame[] = "map";
  for (int step = 0; step < steps; ++step) {
    const std::int64_t t_ns = std::int64_t{step} * period_ms * 1'000'000;
    geometry_msgs_msg_dds__PoseStamped_ pose{};
    pose.header = {time_of(t_ns), frame};
    pose.pose.position = {1e-3 * period_ms * step, 2.0 - 1e-3 * step, 1.0};
    pose.pose.orientation = {0.0, 0.0, 0.6, 0.8};
    const rosgraph_msgs_msg_dds__Clock_ clock = {time_of(t_ns)};
    bool is_answered = false;
    const auto look = [&](const void* sample) {
      is_answered |=
          stamp_ns(*static_cast<const geometry_msgs_msg_dds__PoseStamped_*>(sample)) == t_ns;
    };
    // What is lost is written again.
    const auto end = Clock::now() + std::chrono::seconds(60);
    for (auto sent = Clock::time_point(); !is_answered;) {
      const auto now = Clock::now();
      if (now > end) fail("no answer to step " + std::to_string(step));
      if (now - sent > milliseconds(500)) {
        dds_write(poses, &pose);
        dds_write(clocks, &clock);
        sent = now;
      }
      if (!replies.take(look)) std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
  dds_delete(participant);
  return 0;
}

std::string hex(const unsigned char* bytes) {
  std::string text;
  for (int n = 0; n < 16; ++n) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", bytes[n]);
    text += digits;
  }
  return text;
}

// The topics of all endpoints that DDS itself has found, by their identifiers.
std::map<std::string, std::string> endpoints(dds_entity_t participant, dds_entity_t builtin_topic) {
  std::map<std::string, std::string> topics;
  const dds_entity_t reader =
      made(dds_create_reader(participant, builtin_topic, nullptr, nullptr), "endpoints");
  void* samples[200] = {};
  dds_sample_info_t infos[200];
  const dds_return_t count = dds_take(reader, samples, infos, 200, 200);
  for (int n = 0; n < count; ++n) {
    const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[n]);
    if (infos[n].valid_data) topics[hex(endpoint.key.v)] = endpoint.topic_name;
  }
  if (count > 0) dds_return_loan(reader, samples, count);
  dds_delete(reader);
  return topics;
}

int tell_of_node(const std::string& name) {
  const dds_entity_t participant = join();
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  const dds_entity_t topic =
      made(dds_create_topic(participant, &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc,
                            "ros_discovery_info", nullptr, nullptr),
           "topic");
  const dds_entity_t reader = made(dds_create_reader(participant, topic, qos, nullptr), "reader");
  dds_delete_qos(qos);
  std::this_thread::sleep_for(std::chrono::seconds(3));  // until all has been found
  void* sample = nullptr;
  dds_sample_info_t info;
  const auto end = Clock::now() + std::chrono::seconds(60);
  while (dds_read(reader, &sample, &info, 1, 1) < 1) {
    if (Clock::now() > end) fail("no node");
    std::this_thread::sleep_for(milliseconds(20));
  }
  const auto& told = *static_cast<const rmw_dds_common_msg_dds__ParticipantEntitiesInfo_*>(sample);
  if (told.node_entities_info_seq._length != 1) fail("not one node");
  const auto& node = told.node_entities_info_seq._buffer[0];
  if (node.node_namespace + std::string(node.node_name) != name) fail("another node");
  const auto print = [&](const char* what, const auto& gids, dds_entity_t builtin_topic) {
    const auto topics = endpoints(participant, builtin_topic);
    for (std::uint32_t n = 0; n < gids._length; ++n) {
      const unsigned char* gid = gids._buffer[n].data;
      // An endpoint's identifier begins as its participant's.
      if (hex(gid).substr(0, 24) != hex(told.gid.data).substr(0, 24)) fail("another participant");
      std::printf("%s %s\n", what, topics.at(hex(gid)).c_str());
    }
  };
  print("publishes", node.writer_gid_seq, DDS_BUILTIN_TOPIC_DCPSPUBLICATION);
  print("hears", node.reader_gid_seq, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION);
  dds_return_loan(reader, &sample, 1);
  dds_delete(participant);
  return 0;
}

int churn(int count, const std::vector<std::string>& choices) {
  constexpr int kOfOneParticipant = 50;
  for (int done = 0; done < count;) {
    const dds_entity_t participant = join();
    for (int n = 0; n < kOfOneParticipant && done < count; ++n, ++done) {
      const Reader reader(participant, choices[static_cast<std::size_t>(done) % choices.size()]);
      reader.take([](const void*) {});
      if (n % 2 == 0) dds_delete(reader.entity());  // the others leave with their participant
    }
    dds_delete(participant);
  }
  return 0;
}

int run(const std::vector<std::string>& words) {
  if (words.size() > 1 && words[0] == "read") return read_topics({words.begin() + 1, words.end()});
  if (words.size() == 5 && words[0] == "drive")
    return drive(words[1], words[2], std::stoi(words[3]), std::stoi(words[4]));
  if (words.size() == 2 && words[0] == "nodes") return tell_of_node(words[1]);
  if (words.size() > 2 && words[0] == "churn")
    return churn(std::stoi(words[1]), {words.begin() + 2, words.end()});
  fail("got other words, allowed read, drive, nodes and churn with theirs");
}

}  // namespace
}  // namespace swell::dds_test

int main(int argc, char** argv) { return swell::dds_test::run({argv + 1, argv + argc}); }
