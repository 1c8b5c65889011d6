// The clock and poses of bodies from topics of ROS 2, over DDS.
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "apps/dds/domain.h"
#include "apps/sim/inputs.h"

namespace swell::apps {

// Subscribes to /clock, if the clock comes from outside, and to /FRAME/pose of the bodies of
// `inputs`, with best effort, to which publishers of both kinds are heard: what the network loses
// is missing. Poses that came before a clock are put in before it; those of one publisher come in
// its order if the domain's environment is ordered (environment.h). What this process publishes is
// not heard.
class DdsInputs : public InputSource {
 public:
  // Both have to outlive it. Throws std::runtime_error.
  DdsInputs(DdsDomain& domain, bool takes_clock, Inputs& inputs);
  ~DdsInputs() override;
  DdsInputs(const DdsInputs&) = delete;
  DdsInputs& operator=(const DdsInputs&) = delete;

 private:
  struct Reader {
    std::string topic, frame;  // no frame: the clock
    dds_entity_t entity = 0;
  };
  struct Sample {
    const Reader* reader;
    std::vector<std::uint8_t> bytes;
  };

  void add_reader(DdsDomain& domain, const std::string& topic, const std::string& frame,
                  std::string_view type);
  void listen();
  void take(const Reader& reader, std::vector<Sample>& samples) const;

  Inputs& inputs_;
  std::vector<Reader> readers_;  // the clock first
  dds_entity_t waitset_ = 0;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

}  // namespace swell::apps
