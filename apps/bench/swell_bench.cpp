// swell-bench: measures whole frames, shading, the level of detail, the water's part of a frame,
// height queries, lidars and sea states; predicts what more threads would give; draws figures of a
// scene's waves, and those of papers.
#include "apps/bench/bench.h"
#include "apps/shared/program.h"

namespace swell::apps {
namespace {

void bench(int argc, char** argv) {
  CommandLine line("swell-bench", "Measures the renderer.");
  const BenchMode modes[] = {
      add_bench_frame(line),   add_bench_lidar(line),   add_bench_lod(line),
      add_bench_optics(line),  add_bench_papers(line),  add_bench_peer(line),
      add_bench_query(line),   add_bench_scaling(line), add_bench_sea_state(line),
      add_bench_shading(line), add_bench_terrain(line), add_bench_waves(line)};
  if (!line.parse(argc, argv)) return;
  for (const BenchMode& mode : modes)
    if (mode.line.given()) mode.run();
}

}  // namespace
}  // namespace swell::apps

int main(int argc, char** argv) {
  return swell::apps::run_program([&] { swell::apps::bench(argc, argv); });
}
