// In place of apps/dds, where it is not built.
#include "apps/shared/program.h"
#include "apps/sim/transport.h"

namespace swell::apps {

std::unique_ptr<Transport> open_dds(bool) {
  throw OptionError("command line: --dds: got on, allowed off: built without Cyclone DDS");
}

}  // namespace swell::apps
