#include "apps/dds/dds_inputs.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <stdexcept>

#include "apps/messages/messages.h"
#include "apps/sim/ros_inputs.h"

namespace swell::apps {
namespace {

constexpr std::int32_t kDepth = 1000;
constexpr dds_duration_t kLookUp = DDS_MSECS(50);

}  // namespace

DdsInputs::DdsInputs(DdsDomain& domain, bool takes_clock, Inputs& inputs) : inputs_(inputs) {
  waitset_ = dds_create_waitset(domain.participant());
  if (takes_clock) add_reader(domain, "/clock", "", msg::Clock::kType);
  for (const std::string& frame : inputs.frames())
    add_reader(domain, pose_topic(frame), frame, msg::PoseStamped::kType);
  domain.announce();
  inputs_.begin();
  thread_ = std::thread([this] { listen(); });
}

DdsInputs::~DdsInputs() {
  is_ending_ = true;
  inputs_.stop();
  thread_.join();
  for (const Reader& reader : readers_) dds_delete(reader.entity);
  dds_delete(waitset_);
}

void DdsInputs::add_reader(DdsDomain& domain, const std::string& topic, const std::string& frame,
                           std::string_view type) {
  const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(),
                                                                  &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kDepth);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  const dds_entity_t reader =
      dds_create_reader(domain.participant(), domain.topic(topic, type), qos.get(), nullptr);
  if (reader < 0)
    throw std::runtime_error(fmt::format("{}: DDS: {}", topic, dds_strretcode(-reader)));
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waitset_, reader, 0);
  readers_.push_back({topic, frame, reader});
  domain.add_reader(reader);
}

void DdsInputs::listen() {
  std::vector<Sample> clocks, poses;
  while (!is_ending_) {
    dds_waitset_wait(waitset_, nullptr, 0, kLookUp);
    // Clocks are taken first and put in last: a pose that came before one of them is there then.
    for (const Reader& reader : readers_) take(reader, reader.frame.empty() ? clocks : poses);
    for (const Sample& pose : poses)
      take_pose_message(pose.bytes, pose.reader->frame, {pose.reader->topic}, inputs_);
    for (const Sample& clock : clocks)
      take_clock_message(clock.bytes, {clock.reader->topic}, inputs_);
    clocks.clear();
    poses.clear();
  }
  inputs_.end();
}

void DdsInputs::take(const Reader& reader, std::vector<Sample>& samples) const {
  constexpr std::size_t kAtOnce = 64;
  for (;;) {
    std::array<std::vector<std::uint8_t>, kAtOnce> bytes;
    std::array<void*, kAtOnce> pointers;
    for (std::size_t n = 0; n < kAtOnce; ++n) pointers[n] = &bytes[n];
    std::array<dds_sample_info_t, kAtOnce> infos;
    const dds_return_t count =
        dds_take(reader.entity, pointers.data(), infos.data(), kAtOnce, kAtOnce);
    for (std::size_t n = 0; static_cast<dds_return_t>(n) < count; ++n)
      if (infos[n].valid_data) samples.push_back({&reader, std::move(bytes[n])});
    if (count < static_cast<dds_return_t>(kAtOnce)) return;
  }
}

}  // namespace swell::apps
