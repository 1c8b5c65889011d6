// swell-dataset's command line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "math/parallel.h"

namespace swell::apps {

// One of several parts of the samples: those whose number leaves `index` on division by `count`.
struct Shard {
  int index = 0, count = 1;
};

// "2/8": 0 <= index < count <= 1000000. Throws OptionError.
Shard parse_shard(std::string_view text);

struct DatasetOptions {
  std::string recipe, out;
  Shard shard;
  int threads = available_cpus();
  std::string simd;
  bool quiet = false;
  bool check = false;
  bool try_only = false;
};

// Nothing if --help or --version was asked for. Throws OptionError.
std::optional<DatasetOptions> parse_dataset_options(int argc, char** argv);

}  // namespace swell::apps
