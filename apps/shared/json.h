// JSON as the programs write it. A heavy header: for sources only.
#pragma once

#include <nlohmann/json.hpp>

namespace swell::apps {

using Json = nlohmann::ordered_json;  // keys stay in the order written

}  // namespace swell::apps
