// Topics of ROS 2 over Cyclone DDS: a node's participant, writers and readers of the messages of
// messages.idl. ROS 2 names the topic /clock "rt/clock" in DDS.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "messages.h"

inline dds_entity_t made(dds_entity_t entity, const std::string& what) {
  if (entity < 0) throw std::runtime_error(what + ": " + dds_strretcode(-entity));
  return entity;
}

// Of the domain ROS_DOMAIN_ID, 0 if it is not set, as ROS 2's nodes are.
class Participant {
 public:
  Participant() {
    const char* domain = std::getenv("ROS_DOMAIN_ID");
    const int number = domain ? std::atoi(domain) : 0;
    entity_ = made(dds_create_participant(static_cast<dds_domainid_t>(number), nullptr, nullptr),
                   "DDS participant");
  }
  ~Participant() { dds_delete(entity_); }  // with all that was made of it
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  dds_entity_t topic(const std::string& name, const dds_topic_descriptor_t& type) const {
    return made(dds_create_topic(entity_, &type, ("rt" + name).c_str(), nullptr, nullptr), name);
  }
  dds_entity_t entity() const { return entity_; }

 private:
  dds_entity_t entity_;
};

// Reliable and without a past, as ROS 2's nodes have it where nothing else is said; nothing is
// dropped.
inline dds_qos_t* reliable_qos() {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
  dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  return qos;
}

template <class Message>
class Writer {
 public:
  Writer(const Participant& from, const std::string& name, const dds_topic_descriptor_t& type) {
    dds_qos_t* qos = reliable_qos();
    entity_ = made(dds_create_writer(from.entity(), from.topic(name, type), qos, nullptr), name);
    dds_delete_qos(qos);
  }
  void write(const Message& message) const { made(dds_write(entity_, &message), "DDS write"); }
  bool has_reader() const { return dds_get_matched_subscriptions(entity_, nullptr, 0) > 0; }

 private:
  dds_entity_t entity_;
};

template <class Message>
class Reader {
 public:
  Reader(const Participant& from, const std::string& name, const dds_topic_descriptor_t& type) {
    dds_qos_t* qos = reliable_qos();
    entity_ = made(dds_create_reader(from.entity(), from.topic(name, type), qos, nullptr), name);
    dds_delete_qos(qos);
  }
  bool has_writer() const { return dds_get_matched_publications(entity_, nullptr, 0) > 0; }

  // Calls look(const Message&) for what has come. Whether anything has.
  template <class Look>
  bool take(const Look& look) const {
    void* samples[16] = {};
    dds_sample_info_t infos[16];
    const dds_return_t count = made(dds_take(entity_, samples, infos, 16, 16), "DDS take");
    for (dds_return_t n = 0; n < count; ++n)
      if (infos[n].valid_data) look(*static_cast<const Message*>(samples[n]));
    if (count > 0) dds_return_loan(entity_, samples, count);
    return count > 0;
  }

 private:
  dds_entity_t entity_;
};

using Time = builtin_interfaces_msg_dds__Time_;
using Clock = rosgraph_msgs_msg_dds__Clock_;
using PointStamped = geometry_msgs_msg_dds__PointStamped_;
using PoseStamped = geometry_msgs_msg_dds__PoseStamped_;
using Image = sensor_msgs_msg_dds__Image_;
using PointCloud2 = sensor_msgs_msg_dds__PointCloud2_;

inline std::int64_t ns_of(const Time& time) {
  return std::int64_t{time.sec} * 1'000'000'000 + time.nanosec;
}
inline Time time_of(std::int64_t t_ns) {
  return {static_cast<std::int32_t>(t_ns / 1'000'000'000),
          static_cast<std::uint32_t>(t_ns % 1'000'000'000)};
}
