#include "apps/bench/work_record.h"

#include <algorithm>
#include <utility>

#include "math/check.h"

namespace swell::apps {
namespace {

using Kind = WorkPart::Kind;

std::string stage_at(std::span<const StageSpan> stages, double time_us) {
  for (const StageSpan& span : stages)
    if (time_us >= span.start_us && time_us < span.end_us) return std::string(span.stage);
  return "frame";
}

// A serial part as pieces of one stage each.
void cut_serial(const WorkPart& part, std::span<const StageSpan> stages,
                std::vector<WorkPart>& pieces) {
  const double end_us = part.start_us + part.item_us.front();
  std::vector<double> cuts = {part.start_us, end_us};
  for (const StageSpan& span : stages)
    for (const double cut : {span.start_us, span.end_us})
      if (cut > part.start_us && cut < end_us) cuts.push_back(cut);
  std::ranges::sort(cuts);
  cuts.erase(std::ranges::unique(cuts).begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    pieces.push_back({Kind::kSerial,
                      cuts[i],
                      {cuts[i + 1] - cuts[i]},
                      stage_at(stages, 0.5 * (cuts[i] + cuts[i + 1]))});
}

std::vector<WorkPart> with_stages(std::vector<WorkPart> parts, std::span<const StageSpan> stages) {
  std::vector<WorkPart> result;
  for (WorkPart& part : parts) {
    if (part.kind == Kind::kSerial) {
      cut_serial(part, stages, result);
      continue;
    }
    part.stage = stage_at(stages, part.start_us);
    part.a = with_stages(std::move(part.a), stages);
    part.b = with_stages(std::move(part.b), stages);
    result.push_back(std::move(part));
  }
  return result;
}

// Names serial parts by the loops around them in their stage.
class SerialNames {
 public:
  void add(std::vector<WorkPart>& parts) {
    for (WorkPart& part : parts) {
      if (part.kind == Kind::kBoth) {
        add(part.a);
        add(part.b);
        continue;
      }
      if (part.stage != stage_) end_stage(part.stage);
      if (part.kind == Kind::kSerial) {
        waiting_.push_back(&part);
        continue;
      }
      name_waiting(part.name);
      last_loop_ = part.name;
    }
  }
  void end_stage(const std::string& next = "") {
    name_waiting("");
    stage_ = next;
    last_loop_.clear();
  }

 private:
  void name_waiting(const std::string& next_loop) {
    std::string name = last_loop_.empty() ? "" : "after " + last_loop_;
    if (!next_loop.empty()) name += (name.empty() ? "before " : ", before ") + next_loop;
    for (WorkPart* part : waiting_) part->name = name.empty() ? "all of it" : name;
    waiting_.clear();
  }

  std::string stage_, last_loop_;
  std::vector<WorkPart*> waiting_;
};

}  // namespace

void WorkRecorder::begin(double now_us) {
  parts_.clear();
  open_.clear();
  in_loop_ = false;
  frame_us_ = before_us_ = now_us;
}

void WorkRecorder::add_serial(double now_us) {
  if (now_us > before_us_)
    parts().push_back({Kind::kSerial, before_us_ - frame_us_, {now_us - before_us_}});
}

void WorkRecorder::add(WorkStep step, std::string_view function, double now_us) {
  SWELL_CHECK(!in_loop_ || step == WorkStep::kItemEnd || step == WorkStep::kLoopEnd,
              "function={} within a loop", function);
  switch (step) {
    case WorkStep::kLoopBegin:
      in_loop_ = true;
      add_serial(now_us);
      parts().push_back({Kind::kLoop, now_us - frame_us_, {}, {}, short_function_name(function)});
      break;
    case WorkStep::kItemEnd:
      parts().back().item_us.push_back(now_us - before_us_);
      break;
    case WorkStep::kLoopEnd:
      in_loop_ = false;
      if (parts().back().item_us.empty()) parts().pop_back();
      return;  // what follows the last body is serial
    case WorkStep::kBothBegin:
      add_serial(now_us);
      parts().push_back({Kind::kBoth, now_us - frame_us_, {}});
      open_.push_back(&parts().back().a);
      break;
    case WorkStep::kBothMiddle:
      add_serial(now_us);
      open_.pop_back();
      open_.push_back(&parts().back().b);
      break;
    case WorkStep::kBothEnd:
      add_serial(now_us);
      open_.pop_back();
      break;
  }
  before_us_ = now_us;
}

std::vector<WorkPart> WorkRecorder::end(double now_us, std::span<const StageSpan> stages) {
  SWELL_CHECK(open_.empty(), "open={}", open_.size());
  add_serial(now_us);
  std::vector<WorkPart> parts = with_stages(std::exchange(parts_, {}), stages);
  SerialNames names;
  names.add(parts);
  names.end_stage();
  return parts;
}

std::vector<StageSpan> stage_spans(std::span<const render::TraceEvent> trace) {
  std::vector<StageSpan> spans;
  for (const render::TraceEvent& event : trace)
    if (event.thread < 0)
      spans.push_back({render::stage_name(event.stage), event.start_us, event.end_us});
  return spans;
}

std::string short_function_name(std::string_view pretty) {
  constexpr std::string_view kAnonymous = "(anonymous namespace)::";  // as Clang has it
  if (const std::size_t at = pretty.find(kAnonymous); at != std::string_view::npos)
    pretty.remove_prefix(at + kAnonymous.size());
  pretty = pretty.substr(0, pretty.find_first_of("(<"));
  const std::size_t before = pretty.find_last_of(" :");
  return std::string(before == std::string_view::npos ? pretty : pretty.substr(before + 1));
}

}  // namespace swell::apps
