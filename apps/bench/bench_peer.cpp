// swell-bench peer: the same frames by Swell and by OpenGL on llvmpipe, one after the other.
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "apps/bench/bench.h"
#include "apps/bench/frame_run.h"
#include "apps/bench/picture_difference.h"
#include "apps/shared/cpu_name.h"
#include "apps/shared/json.h"
#include "apps/shared/notices.h"
#include "apps/shared/options.h"
#include "apps/shared/output_file.h"
#include "apps/shared/picture_file.h"
#include "apps/shared/report.h"
#include "math/simd_target.h"
#include "render/world_view.h"
#include "tools/peer/peer.h"

namespace swell::apps {
namespace {

using render::kStages;

// Threads of the one that drew last go to sleep before the other begins.
constexpr std::chrono::milliseconds kPause{3};
constexpr int kDifferenceGain = 8;

struct PeerBench {
  FrameSetup setup;
  int frames = 30, warm_up = 3;
  double first_s = 0.0;
  std::string json;
  std::string picture, peer_picture, difference_picture;
};

struct PeerSamples {
  std::vector<double> swell_ms, peer_ms, take_ms, read_ms;
  std::array<std::vector<double>, kStages> stage_ms;
  std::array<std::vector<double>, kPeerPasses> pass_ms;
  PictureDifference difference;  // of the first frame
};

template <class Work>
double timed_ms(const Work& work) {
  const Stopwatch watch;
  work();
  return watch.elapsed_ms();
}

// One frame at a time by both.
class Duel {
 public:
  Duel(const PeerBench& bench, const render::World& world, Peer& peer)
      : bench_(bench), world_(world), peer_(peer), workers_(bench.setup.threads) {
    rgba_.resize(static_cast<std::size_t>(bench.setup.size.width_px) * bench.setup.size.height_px);
  }

  void draw(int frame, PeerSamples* samples);
  // The peer draws its last frame again and waits after each pass.
  void draw_by_pass(PeerSamples& samples);
  PictureDifference compare_and_write();

 private:
  const PeerBench& bench_;
  const render::World& world_;
  Peer& peer_;
  Workers workers_;
  render::Workspace workspace_;
  render::Target target_;
  ocean::SeaFrame camera_sea_;
  std::vector<std::uint32_t> rgba_;  // the peer's picture
};

void Duel::draw(int frame, PeerSamples* samples) {
  const double t_s = bench_.first_s + frame / kFramesPerSecond;
  render::FrameStatistics statistics;
  std::this_thread::sleep_for(kPause);
  const double swell_ms = timed_ms([&] {
    const View view = render::world_view(world_, t_s, bench_.setup.size.width_px,
                                         bench_.setup.size.height_px, camera_sea_, workers_);
    statistics =
        render::render_frame(world_, view, t_s, bench_.setup.frame, workspace_, target_, workers_);
  });
  const double take_ms = timed_ms([&] { peer_.take(workspace_); });
  std::this_thread::sleep_for(kPause);
  const double peer_ms = timed_ms([&] { peer_.draw(); });
  const double read_ms = timed_ms([&] { peer_.read(rgba_); });
  if (!samples) return;
  samples->swell_ms.push_back(swell_ms);
  samples->take_ms.push_back(take_ms);
  samples->peer_ms.push_back(peer_ms);
  samples->read_ms.push_back(read_ms);
  for (std::size_t i = 0; i < kStages; ++i) samples->stage_ms[i].push_back(statistics.stage_ms[i]);
}

void Duel::draw_by_pass(PeerSamples& samples) {
  const std::array<double, kPeerPasses> pass_ms = peer_.draw_by_pass();
  for (std::size_t i = 0; i < kPeerPasses; ++i) samples.pass_ms[i].push_back(pass_ms[i]);
}

PictureDifference Duel::compare_and_write() {
  const auto write = [&](const std::string& path, const std::vector<std::uint32_t>& rgba) {
    if (path.empty()) return;
    render::Target picture;
    picture.width_px = target_.width_px;
    picture.height_px = target_.height_px;
    picture.rgba = rgba;
    write_picture(picture, path);
  };
  write(bench_.picture, target_.rgba);
  write(bench_.peer_picture, rgba_);
  if (!bench_.difference_picture.empty())
    write(bench_.difference_picture, difference_picture(target_.rgba, rgba_, kDifferenceGain));
  return picture_difference(target_.rgba, rgba_);
}

PeerSamples measure_peer(const PeerBench& bench, const render::World& world, Peer& peer) {
  Duel duel(bench, world, peer);
  PeerSamples samples;
  // The first frame a few times: the peer compiles its shaders, both make their storage.
  for (int k = -bench.warm_up; k < 0; ++k) duel.draw(0, nullptr);
  for (int k = 0; k < bench.frames; ++k) {
    duel.draw(k, &samples);
    if (k == 0) samples.difference = duel.compare_and_write();
  }
  for (int k = 0; k < std::min(bench.frames, 10); ++k) duel.draw_by_pass(samples);
  return samples;
}

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json report_json(const PeerBench& bench, const render::World& world, const Peer& peer,
                 const PeerSamples& samples) {
  const double swell_ms = spread(samples.swell_ms).median, peer_ms = spread(samples.peer_ms).median;
  Json stages = Json::object(), passes = Json::object();
  for (std::size_t i = 0; i < kStages; ++i)
    stages[std::string(stage_name(static_cast<render::Stage>(i)))] =
        rounded(spread(samples.stage_ms[i]).median);
  for (std::size_t i = 0; i < kPeerPasses; ++i)
    passes[std::string(peer_pass_name(static_cast<PeerPass>(i)))] =
        rounded(spread(samples.pass_ms[i]).median);
  const PictureDifference& d = samples.difference;
  return {{"scene", world.scene().name},
          {"size", {bench.setup.size.width_px, bench.setup.size.height_px}},
          {"frames", bench.frames},
          {"threads", bench.setup.threads},
          {"simd", simd_target_name(current_simd_target())},
          {"swell_ms", rounded(swell_ms)},
          {"peer_ms", rounded(peer_ms)},
          {"ratio", rounded(peer_ms / swell_ms)},
          {"swell_stages_ms", stages},
          {"peer_passes_ms", passes},
          {"peer_take_ms", rounded(spread(samples.take_ms).median)},
          {"peer_read_ms", rounded(spread(samples.read_ms).median)},
          {"mean_difference", rounded(d.mean)},
          {"p99_difference", d.p99},
          {"max_difference", d.max},
          {"psnr_db", rounded(d.psnr_db)},
          {"renderer", peer.renderer()},
          {"version", peer.version()},
          {"cpu", cpu_name()}};
}

std::string report_text(const Json& r) {
  std::string text =
      fmt::format("{} {}x{}, {} threads, {}, medians of {} frames on {}\npeer: {}, OpenGL {}\n",
                  r["scene"].get<std::string>(), r["size"][0].get<int>(), r["size"][1].get<int>(),
                  r["threads"].get<int>(), r["simd"].get<std::string>(), r["frames"].get<int>(),
                  r["cpu"].get<std::string>(), r["renderer"].get<std::string>(),
                  r["version"].get<std::string>());
  const auto add_rows = [&](const char* who, const Json& rows, const Json& frame) {
    for (const auto& [name, ms] : rows.items())
      text += fmt::format("{:<6} {:<12} {:>9.3f} ms\n", who, name, ms.get<double>());
    text += fmt::format("{:<6} {:<12} {:>9.3f} ms\n", who, "frame", frame.get<double>());
  };
  add_rows("swell", r["swell_stages_ms"], r["swell_ms"]);
  add_rows("peer", r["peer_passes_ms"], r["peer_ms"]);
  text += fmt::format(
      "outside the peer's frame: {:.3f} ms to take over vertices and maps, {:.3f} ms to read back\n"
      "ratio {:.2f}; pictures differ by {:.3f} of 255 on average, 99 % of values by at most {}, "
      "all by at most {}; PSNR {:.1f} dB\n",
      r["peer_take_ms"].get<double>(), r["peer_read_ms"].get<double>(), r["ratio"].get<double>(),
      r["mean_difference"].get<double>(), r["p99_difference"].get<int>(),
      r["max_difference"].get<int>(), r["psnr_db"].get<double>());
  return text;
}

void check_peer_picture(const std::string& path) {
  if (path.empty()) return;
  check_picture_file(path);
  if (stores_linear_light(path))
    throw OptionError(fmt::format(
        "command line: picture of a peer, got '{}', allowed 8 bits: .png .tif .tiff", path));
}

void run_peer_bench(const PeerBench& bench) {
  select_simd(bench.setup.simd);
  check_text_place(bench.json);
  for (const std::string* path : {&bench.picture, &bench.peer_picture, &bench.difference_picture})
    check_peer_picture(*path);
  scene::Scene scene = load_scene(bench.setup.scene);
  Peer peer(bench.setup.threads);  // before any thread starts
  const render::World world(std::move(scene));
  const PeerSamples samples = measure_peer(bench, world, peer);
  const Json report = report_json(bench, world, peer, samples);
  if (bench.json != "-") fmt::print("{}", report_text(report));
  if (!bench.json.empty()) write_text(bench.json, report.dump(2) + "\n");
}

}  // namespace

BenchMode add_bench_peer(CommandLine& program) {
  const auto bench = std::make_shared<PeerBench>();
  bench->setup.frame.edge_samples = 0;
  CommandLine line = program.add_mode(
      "peer", "The same frames by OpenGL on Mesa's llvmpipe: times and how pictures differ");
  add_required_frame_setup(line, bench->setup);
  add_without_option(line, bench->setup.frame.without);
  add_integer(line, "--frames", bench->frames, 1, 100000, "Frames to measure, of each");
  add_integer(line, "--warmup", bench->warm_up, 2, 10000, "Frames to draw before them");
  add_number(line, "--time", bench->first_s, 0.0, 1e6,
             "Time of the first frame in seconds; the next are 1/60 s apart");
  add_json_option(line, bench->json);
  line.add_text("--picture", "FILE", bench->picture, "Write Swell's first picture (.png, .tif)");
  line.add_text("--peer-picture", "FILE", bench->peer_picture, "Write the peer's");
  line.add_text("--difference-picture", "FILE", bench->difference_picture,
                "Write their difference, times 8");
  return {line, [bench] {
            bench->setup.frame.without.add(kPeerLacks);
            run_peer_bench(*bench);
          }};
}

}  // namespace swell::apps
