// swell-bench scaling: what more cores would give, from the work of frames on one thread.
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <memory>

#include "apps/bench/bench.h"
#include "apps/bench/frame_run.h"
#include "apps/bench/scaling_report.h"
#include "apps/bench/work_record.h"
#include "apps/shared/report.h"
#include "render/world_view.h"

namespace swell::apps {
namespace {

// Draws frames with a number of threads, one at a time.
class Drawing {
 public:
  Drawing(const FrameRun& run, const render::World& world, int threads)
      : run_(run), world_(world), workers_(threads) {}

  Workers& workers() { return workers_; }
  render::Workspace& workspace() { return workspace_; }

  // Calls before_stages between finding the camera and the frame's stages.
  void draw(int frame, FunctionRef<void()> before_stages) {
    const double t_s = frame / kFramesPerSecond;
    const PictureSize size = run_.setup.size;
    const View view =
        render::world_view(world_, t_s, size.width_px, size.height_px, sea_, workers_);
    before_stages();
    render::render_frame(world_, view, t_s, run_.setup.frame, workspace_, target_, workers_);
  }

 private:
  const FrameRun& run_;
  const render::World& world_;
  Workers workers_;
  render::Workspace workspace_;
  render::Target target_;
  ocean::SeaFrame sea_;
};

// A frame with one thread, and with several right after it: both meet the machine at one speed.
struct DrawnTwice {
  std::vector<WorkPart> parts;
  double one_ms = 0.0, several_ms = 0.0;
  std::int64_t interruptions = 0;  // by other programs while one thread drew: a piece seems longer
};

std::int64_t interruptions() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_nivcsw;
}

std::vector<DrawnTwice> draw_frames(const FrameRun& run, const render::World& world) {
  Drawing one(run, world, 1), several(run, world, run.setup.threads);
  const Stopwatch clock;
  const auto now_us = [&] { return clock.elapsed_ms() * 1e3; };
  WorkRecorder recorder;
  one.workspace().trace_enabled = true;  // says where stages begin and end
  one.workers().observe([&](WorkStep step, const std::source_location& caller) {
    recorder.add(step, caller.function_name(), now_us());
  });
  std::vector<DrawnTwice> frames;
  for (int k = -kWarmUp; k < run.frames; ++k) {
    const std::int64_t interruptions_before = interruptions();
    const double start_us = now_us();
    double stages_us = 0.0;
    recorder.begin(start_us);
    one.draw(k, [&] { stages_us = now_us() - start_us; });
    const double one_us = now_us();
    const std::int64_t interruptions_after = interruptions();
    several.draw(k, [] {});
    const double several_us = now_us();
    if (k < 0) continue;
    std::vector<StageSpan> stages = stage_spans(one.workspace().trace);
    for (StageSpan& span : stages) span.start_us += stages_us, span.end_us += stages_us;
    frames.push_back({recorder.end(one_us, stages), (one_us - start_us) * 1e-3,
                      (several_us - one_us) * 1e-3, interruptions_after - interruptions_before});
  }
  return frames;
}

struct Measurement {
  std::vector<std::vector<WorkPart>> frames;
  MeasuredTimes times;
  std::int64_t interruptions = 0;  // of each frame
};

// Measures the frames that were interrupted least: as a rule, not at all.
Measurement measure_scaling(const FrameRun& run, const render::World& world) {
  std::vector<DrawnTwice> frames = draw_frames(run, world);
  const std::int64_t least = std::ranges::min(frames, {}, &DrawnTwice::interruptions).interruptions;
  std::erase_if(frames, [&](const DrawnTwice& frame) { return frame.interruptions > least; });
  Measurement measurement;
  measurement.interruptions = least;
  std::vector<double> one_ms, several_ms;
  for (DrawnTwice& frame : frames) {
    measurement.frames.push_back(std::move(frame.parts));
    one_ms.push_back(frame.one_ms);
    several_ms.push_back(frame.several_ms);
  }
  measurement.times = {run.setup.threads, spread(one_ms).median, spread(several_ms).median};
  return measurement;
}

void run_scaling_bench(const FrameRun& run) {
  const render::World world = begin_run(run);
  const Measurement measurement = measure_scaling(run, world);
  const ScalingReport report = predict_scaling(measurement.frames, run.setup.threads);
  const std::string how =
      fmt::format("{} of {} frames of one thread (interrupted {} times each)",
                  measurement.frames.size(), run.frames, measurement.interruptions);
  Json figures = {{"frames", measurement.frames.size()},
                  {"interruptions", measurement.interruptions}};
  figures.update(scaling_json(report, measurement.times));
  report_run(run, world, how, scaling_text(report, measurement.times), figures);
}

}  // namespace

BenchMode add_bench_scaling(CommandLine& program) {
  const auto run = std::make_shared<FrameRun>();
  CommandLine line = program.add_mode(
      "scaling",
      "What more threads would give: frames of one thread are recorded piece by piece, and the "
      "pieces scheduled on 1 to 32 threads; also which parts no second thread can share. Frames of "
      "--threads are measured beside, to check the prediction");
  add_frame_run(line,
                "Frames to record; frame k is at k / 60 s. Only those that other programs "
                "interrupted least count",
                *run);
  return {line, [run] { run_scaling_bench(*run); }};
}

}  // namespace swell::apps
