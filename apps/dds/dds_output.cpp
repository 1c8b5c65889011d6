#include "apps/dds/dds_output.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "apps/messages/cdr.h"

namespace swell::apps {
namespace {

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

constexpr std::int32_t kMessages = 10;
// A patient writer waits longer than it takes to find out that a reader is gone (10 s).
constexpr dds_duration_t kPatience = DDS_SECS(15), kFarewell = DDS_SECS(1);

Qos writer_qos(const Topic& topic, bool is_patient) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, kPatience);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  if (topic.is_kept) {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  } else if (is_patient) {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
  } else {
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kMessages);
  }
  return qos;
}

}  // namespace

DdsOutput::DdsOutput(DdsDomain& domain, std::span<const Topic> topics) {
  for (const Topic& topic : topics) {
    const Qos qos = writer_qos(topic, domain.is_patient());
    const dds_entity_t writer = dds_create_writer(
        domain.participant(), domain.topic(topic.name, topic.type), qos.get(), nullptr);
    if (writer < 0)
      throw std::runtime_error(fmt::format("{}: DDS: {}", topic.name, dds_strretcode(-writer)));
    writers_.push_back({topic.name, writer});
    domain.add_writer(writer);
  }
  domain.announce();
}

void DdsOutput::write(std::size_t topic, std::int64_t, const msg::Message& message) {
  Writer& writer = writers_[topic];
  const std::vector<std::uint8_t> bytes = cdr_bytes(message);
  const dds_return_t code = dds_write(writer.entity, &bytes);
  if (code == DDS_RETCODE_OK || writer.is_fault_told) return;
  writer.is_fault_told = true;
  std::fputs(fmt::format("warning: {}: DDS took no message, {}; left out, as are more like it\n",
                         writer.name, dds_strretcode(-code))
                 .c_str(),
             stderr);
}

void DdsOutput::finish() {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::nanoseconds(kFarewell);
  for (const Writer& writer : writers_) {
    const std::chrono::nanoseconds left = end - Clock::now();
    if (left.count() <= 0 || dds_wait_for_acks(writer.entity, left.count()) != DDS_RETCODE_OK)
      return;
  }
}

}  // namespace swell::apps
