#include "apps/bench/work_schedule.h"

#include <deque>
#include <functional>
#include <memory>
#include <queue>
#include <utility>

#include "math/check.h"

namespace swell::apps {
namespace {

class Schedule {
 public:
  Schedule(std::span<const WorkPart> parts, int threads) : free_(threads) { start(parts, nullptr); }

  double run() {
    double now_us = 0.0;
    while (true) {
      for (; free_ > 0 && !waiting_.empty(); --free_) {
        running_.push({now_us + waiting_.front().length_us, waiting_.front().strand});
        waiting_.pop_front();
      }
      if (running_.empty()) return now_us;
      const auto [end_us, strand] = running_.top();
      running_.pop();
      now_us = end_us;
      ++free_;
      finish_one(*strand);
    }
  }

 private:
  // A sequence of parts on its way.
  struct Strand {
    std::span<const WorkPart> rest;  // the first is in work
    std::size_t open = 0;            // of that, what has not ended
    Strand* parent = nullptr;        // whose kBoth this is a side of
  };
  struct Task {
    double length_us;
    Strand* strand;
  };
  using Running = std::pair<double, Strand*>;  // when it ends
  struct LaterEnd {
    bool operator()(const Running& a, const Running& b) const { return a.first > b.first; }
  };

  void start(std::span<const WorkPart> parts, Strand* parent) {
    strands_.push_back(std::make_unique<Strand>(Strand{parts, 0, parent}));
    open_next(*strands_.back());
  }

  void open_next(Strand& strand) {
    for (; !strand.rest.empty(); strand.rest = strand.rest.subspan(1)) {
      const WorkPart& part = strand.rest.front();
      if (part.kind == WorkPart::Kind::kBoth) {
        strand.open = 2;
        start(part.a, &strand);
        start(part.b, &strand);
        return;
      }
      strand.open = part.item_us.size();
      if (part.kind == WorkPart::Kind::kSerial)
        waiting_.push_front({part.item_us.front(), &strand});
      else
        for (const double us : part.item_us) waiting_.push_back({us, &strand});
      if (strand.open > 0) return;
    }
    if (strand.parent) finish_one(*strand.parent);
  }

  void finish_one(Strand& strand) {
    if (--strand.open > 0) return;
    strand.rest = strand.rest.subspan(1);
    open_next(strand);
  }

  int free_;
  std::deque<Task> waiting_;
  std::priority_queue<Running, std::vector<Running>, LaterEnd> running_;
  std::vector<std::unique_ptr<Strand>> strands_;
};

}  // namespace

double schedule_us(std::span<const WorkPart> parts, int threads) {
  SWELL_CHECK(threads >= 1, "threads={}", threads);
  return Schedule(parts, threads).run();
}

}  // namespace swell::apps
