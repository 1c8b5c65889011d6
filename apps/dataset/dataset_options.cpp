#include "apps/dataset/dataset_options.h"

#include <fmt/core.h>

#include "apps/shared/options.h"
#include "apps/shared/parse_number.h"

namespace swell::apps {

Shard parse_shard(std::string_view text) {
  constexpr int kMostShards = 1'000'000;
  const std::size_t middle = text.find('/');
  const auto index = parse_number<int>(text.substr(0, middle));
  const auto count =
      middle == std::string_view::npos ? std::nullopt : parse_number<int>(text.substr(middle + 1));
  if (!index || !count || *index < 0 || *index >= *count || *count > kMostShards)
    throw OptionError(fmt::format(
        "command line: --shard: got '{}', allowed I/N with 0 <= I < N <= {}", text, kMostShards));
  return {*index, *count};
}

std::optional<DatasetOptions> parse_dataset_options(int argc, char** argv) {
  DatasetOptions options;
  CommandLine line("swell-dataset",
                   "Draws a data set by a recipe: pictures, labels, masks, boxes, cameras");
  line.add_text("--recipe", "FILE", options.recipe, "Recipe (TOML; docs/do/datasets.md)");
  line.require("--recipe");
  line.add_text("--out", "FOLDER", options.out,
                "Folder of the data set; samples that it has are not drawn again");
  line.require("--out");
  line.add_value({"--shard", "I/N", "0/1", "Draw part I, from 0 on, of N parts of the samples",
                  [&](const std::string& text) { options.shard = parse_shard(text); }});
  add_machine_options(line, options.threads, options.simd);
  line.add_flag("--quiet", options.quiet, "No progress bar, which a terminal shows");
  line.add_flag("--check", options.check,
                "Draw nothing; fail unless all files are there and as the manifest says");
  line.add_flag("--try", options.try_only,
                "Draw and write nothing; fail if the recipe or a file that it names is wrong");
  line.exclude("--check", "--shard");
  line.exclude("--try", "--check");
  if (!line.parse(argc, argv)) return std::nullopt;
  return options;
}

}  // namespace swell::apps
