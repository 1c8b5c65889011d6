#include <cstdlib>

#include "apps/dds/dds_inputs.h"
#include "apps/dds/dds_output.h"
#include "apps/dds/domain.h"
#include "apps/sim/transport.h"

namespace swell::apps {
namespace {

class DdsTransport : public Transport {
 public:
  DdsTransport(const DdsEnvironment& environment, bool is_patient)
      : domain_(environment, is_patient) {}

  std::unique_ptr<MessageOutput> output(std::span<const Topic> topics,
                                        const scene::Water&) override {
    return std::make_unique<DdsOutput>(domain_, topics);
  }
  std::unique_ptr<InputSource> source(bool takes_clock, Inputs& inputs) override {
    return std::make_unique<DdsInputs>(domain_, takes_clock, inputs);
  }
  std::string audience() const override { return domain_.audience(); }

 private:
  DdsDomain domain_;
};

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

std::unique_ptr<Transport> open_dds(bool is_lock_step) {
  return std::make_unique<DdsTransport>(read_dds_environment(variable, is_lock_step), is_lock_step);
}

}  // namespace swell::apps
