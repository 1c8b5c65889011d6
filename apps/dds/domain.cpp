#include "apps/dds/domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "apps/dds/cdr_type.h"
#include "apps/dds/interfaces.h"
#include "apps/dds/node_info.h"
#include "apps/shared/program.h"

namespace swell::apps {
namespace {

// A writer waits where so many bytes wait for readers: ten messages of a topic are fewer.
constexpr const char* kNeverWait =
    "<CycloneDDS><Domain><Internal><Watermarks><WhcHigh>1GB</WhcHigh><WhcHighInit>1GB</WhcHighInit>"
    "<WhcAdaptive>false</WhcAdaptive></Watermarks></Internal></Domain></CycloneDDS>,";
constexpr const char* kNoSharedMemory =
    ",<CycloneDDS><Domain><SharedMemory><Enable>false</Enable></SharedMemory></Domain>"
    "</CycloneDDS>";

// "sensor_msgs/msg/Image" is sensor_msgs::msg::dds_::Image_.
std::string dds_type(std::string_view type) {
  std::string name;
  for (std::size_t at = 0; at < type.size();) {
    const std::size_t end = std::min(type.find('/', at), type.size());
    const std::string_view part = type.substr(at, end - at);
    name += end < type.size() ? fmt::format("{}::", part) : fmt::format("dds_::{}_", part);
    at = end + 1;
  }
  return name;
}

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

// As nodes of ROS 2 have it, which look for their security enclave.
Qos participant_qos() {
  constexpr std::string_view kEnclave = "enclave=/;";
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_userdata(qos.get(), kEnclave.data(), kEnclave.size());
  return qos;
}

// Who comes later gets the last message.
Qos announcer_qos() {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  return qos;
}

std::vector<std::string> interfaces_of(const ddsi_sertype* type) {
  std::vector<std::string> interfaces;
  char text[200];
  for (int n = 0; dds_interface_text(type, n, text, sizeof text); ++n) interfaces.push_back(text);
  return interfaces;
}

}  // namespace

// What Cyclone says while this lives, in place of its lines on standard error, which are as many as
// damaged packets come in.
class DdsDomain::Log {
 public:
  Log() { dds_set_log_sink(hear, this); }
  ~Log() { dds_set_log_sink(nullptr, nullptr); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // What it said first. From now on the first line is told, as a warning.
  std::string begin() {
    const std::lock_guard lock(mutex_);
    is_begun_ = true;
    return first_.empty() ? "unknown fault" : first_;
  }

 private:
  static void hear(void* self, const dds_log_data_t* data) {
    Log& log = *static_cast<Log*>(self);
    const std::lock_guard lock(log.mutex_);
    if (!log.is_begun_ && log.first_.empty()) log.first_ = one_line(data->message);
    if (!log.is_begun_ || log.is_told_) return;
    log.is_told_ = true;
    const std::string line = one_line(data->message).substr(0, 100);
    std::fputs(fmt::format("warning: DDS: {}; more is not shown\n", line).c_str(), stderr);
  }

  std::mutex mutex_;
  std::string first_;
  bool is_begun_ = false, is_told_ = false;
};

DdsDomain::DdsDomain(const DdsEnvironment& environment, bool is_patient)
    : environment_(environment), is_patient_(is_patient), log_(std::make_unique<Log>()) {
  const std::string configuration =
      (is_patient ? "" : kNeverWait) + environment.configuration + kNoSharedMemory;
  domain_ = dds_create_domain(environment.domain, configuration.c_str());
  if (domain_ >= 0)
    participant_ = dds_create_participant(environment.domain, participant_qos().get(), nullptr);
  const std::string fault = fmt::format("DDS domain {}: {}", environment.domain, log_->begin());
  if (domain_ == DDS_RETCODE_ERROR || domain_ == DDS_RETCODE_BAD_PARAMETER)
    throw OptionError("CYCLONEDDS_URI: " + fault);
  if (domain_ >= 0 && participant_ >= 0) {
    node_.name = "swell_sim";
    dds_get_guid(participant_, &node_.participant);
    return;
  }
  if (domain_ >= 0) dds_delete(domain_);
  throw std::runtime_error(fault);
}

DdsDomain::~DdsDomain() { dds_delete(domain_); }

dds_entity_t DdsDomain::topic(const std::string& name, std::string_view type) {
  const CdrTopic made = create_cdr_topic(participant_, "rt" + name, dds_type(type));
  if (made.entity < 0)
    throw std::runtime_error(fmt::format("{}: DDS: {}", name, dds_strretcode(-made.entity)));
  if (interfaces_.empty()) interfaces_ = interfaces_of(made.type);
  return made.entity;
}

void DdsDomain::add_endpoint(dds_entity_t endpoint, std::vector<dds_guid_t>& to) {
  dds_get_guid(endpoint, &to.emplace_back());
}

void DdsDomain::announce() {
  const auto check = [](dds_return_t code) {
    if (code < 0)
      throw std::runtime_error(fmt::format("{}: DDS: {}", kNodeInfoTopic, dds_strretcode(-code)));
  };
  if (announcer_ == 0) {
    const CdrTopic topic = create_cdr_topic(participant_, kNodeInfoTopic, kNodeInfoType);
    check(topic.entity);
    announcer_ = dds_create_writer(participant_, topic.entity, announcer_qos().get(), nullptr);
    check(announcer_);
  }
  const std::vector<std::uint8_t> bytes = node_info_bytes(node_, environment_.gid_bytes);
  check(dds_write(announcer_, &bytes));
}

std::string DdsDomain::audience() const {
  std::string who = "by this machine and what is found through";
  if (environment_.range == DiscoveryRange::kOff) who = "by nobody (discovery is off), through";
  if (environment_.range == DiscoveryRange::kThisMachine) who = "by this machine alone, through";
  return fmt::format("ROS 2 over DDS, domain {}: heard {} {}", environment_.domain, who,
                     fmt::join(interfaces_, ", "));
}

}  // namespace swell::apps
