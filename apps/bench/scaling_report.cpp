#include "apps/bench/scaling_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "apps/bench/work_schedule.h"
#include "apps/shared/report.h"
#include "math/check.h"

namespace swell::apps {
namespace {

constexpr double kShownPart = 2e-4;  // of the frame: serial parts below this are not in the text

// The numbers of one part in every frame, by what it is.
template <class Key>
class Rows {
 public:
  struct Row {
    Key key;
    std::vector<std::array<double, 3>> frames;  // items, sum, largest
  };
  explicit Rows(std::size_t frames) : frames_(frames) {}

  void add(const Key& key, std::size_t frame, std::span<const double> item_us) {
    auto row = std::ranges::find(rows_, key, &Row::key);
    if (row == rows_.end())
      row = rows_.insert(rows_.end(), {key, std::vector<std::array<double, 3>>(frames_)});
    auto& [items, sum_ms, largest_ms] = row->frames[frame];
    for (const double us : item_us) {
      ++items;
      sum_ms += us * 1e-3;
      largest_ms = std::max(largest_ms, us * 1e-3);
    }
  }
  const std::vector<Row>& rows() const { return rows_; }

  static double median(const Row& row, std::size_t number) {
    std::vector<double> values;
    for (const auto& frame : row.frames) values.push_back(frame[number]);
    return spread(std::move(values)).median;
  }

 private:
  std::size_t frames_;
  std::vector<Row> rows_;
};

using SerialKey = std::tuple<std::string, std::string, bool>;  // stage, name, beside
using LoopKey = std::tuple<std::string, std::string>;          // stage, name

struct Tally {
  explicit Tally(std::size_t frames) : serial(frames), loops(frames) {}

  void add(std::span<const WorkPart> parts, std::size_t frame, bool beside) {
    for (const WorkPart& part : parts) {
      if (part.kind == WorkPart::Kind::kSerial)
        serial.add({part.stage, part.name, beside}, frame, part.item_us);
      if (part.kind == WorkPart::Kind::kLoop)
        loops.add({part.stage, part.name}, frame, part.item_us);
      add(part.a, frame, true);
      add(part.b, frame, true);
    }
  }

  Rows<SerialKey> serial;
  Rows<LoopKey> loops;
};

double speed_up(const ScalingReport& report, std::size_t i) {
  return report.frame_ms.front() / report.frame_ms[i];
}

std::string prediction_text(const ScalingReport& report) {
  std::string threads, frame, faster;
  for (std::size_t i = 0; i < kPredictedThreads.size(); ++i) {
    threads += fmt::format(" {:>7}", kPredictedThreads[i]);
    frame += fmt::format(" {:>7.2f}", report.frame_ms[i]);
    faster += fmt::format(" {:>7.2f}", speed_up(report, i));
  }
  return fmt::format("threads  {}\nframe, ms{}\nspeed-up {}\n", threads, frame, faster);
}

std::string serial_text(const ScalingReport& report) {
  const double frame_ms = report.frame_ms.front();
  std::string text = fmt::format("\n{:>8} {:>10}  one thread alone\n", "ms", "of frame");
  for (const SerialPart& part : report.serial)
    if (part.ms >= kShownPart * frame_ms)
      text += fmt::format("{:>8.3f} {:>8.2f} %  {}: {}{}\n", part.ms, 100.0 * part.ms / frame_ms,
                          part.stage, part.name, part.beside ? " (beside other work)" : "");
  return text + fmt::format("{:>8.3f} {:>8.2f} %  all that has nothing beside it\n",
                            report.serial_ms(), 100.0 * report.serial_ms() / frame_ms);
}

std::string loop_text(const ScalingReport& report) {
  std::string text =
      fmt::format("\n{:>8} {:>7} {:>10}  loops that threads share\n", "ms", "items", "largest ms");
  for (const LoopWork& loop : report.loops)
    text += fmt::format("{:>8.3f} {:>7.0f} {:>10.3f}  {}: {}\n", loop.ms, loop.items,
                        loop.largest_ms, loop.stage, loop.name);
  return text;
}

}  // namespace

double ScalingReport::serial_ms() const {
  double sum = 0.0;
  for (const SerialPart& part : serial)
    if (!part.beside) sum += part.ms;
  return sum;
}

ScalingReport predict_scaling(std::span<const std::vector<WorkPart>> frames, int checked_threads) {
  SWELL_CHECK(!frames.empty(), "frames={}", frames.size());
  ScalingReport report;
  const auto predict_ms = [&](int threads) {
    std::vector<double> frame_ms;
    for (const auto& parts : frames) frame_ms.push_back(schedule_us(parts, threads) * 1e-3);
    return spread(std::move(frame_ms)).median;
  };
  std::ranges::transform(kPredictedThreads, report.frame_ms.begin(), predict_ms);
  report.checked_ms = predict_ms(checked_threads);
  Tally tally(frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) tally.add(frames[k], k, false);
  for (const auto& row : tally.serial.rows()) {
    const auto& [stage, name, beside] = row.key;
    report.serial.push_back({stage, name, beside, Rows<SerialKey>::median(row, 1)});
  }
  std::ranges::stable_sort(report.serial, std::ranges::greater{}, &SerialPart::ms);
  for (const auto& row : tally.loops.rows()) {
    const auto& [stage, name] = row.key;
    const auto median = [&](std::size_t i) { return Rows<LoopKey>::median(row, i); };
    report.loops.push_back({stage, name, median(0), median(1), median(2)});
  }
  return report;
}

std::string scaling_text(const ScalingReport& report, const MeasuredTimes& measured) {
  return prediction_text(report) +
         fmt::format("measured: {} threads {:.2f} ms (predicted {:.2f}), one thread {:.2f} ms\n",
                     measured.threads, measured.threads_ms, report.checked_ms, measured.one_ms) +
         serial_text(report) + loop_text(report);
}

Json scaling_json(const ScalingReport& report, const MeasuredTimes& measured) {
  Json predicted = Json::array(), serial = Json::array(), loops = Json::array();
  for (std::size_t i = 0; i < kPredictedThreads.size(); ++i)
    predicted.push_back({{"threads", kPredictedThreads[i]},
                         {"frame_ms", report.frame_ms[i]},
                         {"speed_up", speed_up(report, i)}});
  for (const SerialPart& part : report.serial)
    serial.push_back(
        {{"stage", part.stage}, {"part", part.name}, {"beside", part.beside}, {"ms", part.ms}});
  for (const LoopWork& loop : report.loops)
    loops.push_back({{"stage", loop.stage},
                     {"loop", loop.name},
                     {"items", loop.items},
                     {"ms", loop.ms},
                     {"largest_ms", loop.largest_ms}});
  return {{"predicted", predicted},
          {"measured",
           {{"threads", measured.threads},
            {"frame_ms", measured.threads_ms},
            {"predicted_ms", report.checked_ms},
            {"one_thread_ms", measured.one_ms}}},
          {"serial_ms", report.serial_ms()},
          {"serial", serial},
          {"loops", loops}};
}

}  // namespace swell::apps
