// Where there is no transport of Gazebo's to build with.
#include "apps/gazebo/gazebo_inputs.h"
#include "apps/gazebo/gazebo_output.h"
#include "apps/shared/program.h"

namespace swell::apps {

void check_gazebo() {
  throw OptionError(
      "command line: --gazebo: got 'on', allowed off: this swell-sim was built without Gazebo's "
      "transport");
}

struct GazeboOutput::State {};
struct GazeboInputs::State {};

GazeboOutput::GazeboOutput(std::span<const Topic>, const scene::Water&) { check_gazebo(); }
GazeboOutput::~GazeboOutput() = default;
std::string GazeboOutput::audience() const { return {}; }
void GazeboOutput::write(std::size_t, std::int64_t, const msg::Message&) {}
void GazeboOutput::finish() {}

GazeboInputs::GazeboInputs(const GazeboInputTopics&, GazeboTakers) { check_gazebo(); }
GazeboInputs::~GazeboInputs() = default;

}  // namespace swell::apps
