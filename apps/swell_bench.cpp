// swell-bench: measures whole frames, the level of detail, height queries and sea states; draws
// figures of a scene's waves.
#include "apps/bench.h"
#include "apps/options.h"
#include "apps/program.h"

namespace swell::apps {
namespace {

void bench(int argc, char** argv) {
  CLI::App app("Measures the renderer.", "swell-bench");
  add_standard_options(app);
  app.require_subcommand(1);
  const Subcommand subcommands[] = {add_bench_frame(app), add_bench_lod(app), add_bench_query(app),
                                    add_bench_sea_state(app), add_bench_waves(app)};
  if (!parse_command_line(app, argc, argv)) return;
  for (const Subcommand& subcommand : subcommands)
    if (subcommand.app->parsed()) subcommand.run();
}

}  // namespace
}  // namespace swell::apps

int main(int argc, char** argv) {
  return swell::apps::run_program([&] { swell::apps::bench(argc, argv); });
}
