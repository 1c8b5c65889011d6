#include "lod/queue.h"

#include <algorithm>
#include <limits>
#include <span>

#include "lod/diamond.h"
#include "math/check.h"

namespace swell::lod {
namespace {

constexpr std::uint64_t kFirstRangeStep = 1u << 19;  // in a float's bits: 3 to 6 %

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

Queue::Queue(Order order, int capacity, int node_capacity)
    : capacity_(index(capacity)),
      rank_flip_(order == Order::kHighestPriorityFirst ? 0u : ~0u),
      tie_flip_(order == Order::kHighestPriorityFirst ? 0u : ~std::uint64_t{0}),
      positions_(index(node_capacity), -1) {
  for (auto* array : {&nodes_, &x_, &y_, &level_}) array->reserve(capacity_);
  keys_.reserve(capacity_);
  heap_.reserve(capacity_);
  close_range();
}

PriorityKey Queue::key(int node) const { return keys_[index(positions_[index(node)])]; }

void Queue::clear() {
  for (const std::int32_t node : nodes_) positions_[index(node)] = -1;
  for (auto* array : {&nodes_, &x_, &y_, &level_}) array->clear();
  keys_.clear();
  next_update_ = 0;
  close_range();
}

void Queue::insert(const PriorityFrame& frame, int node, int x, int y, int level) {
  SWELL_DCHECK(!contains(node) && nodes_.size() < capacity_, "node={}", node);
  const std::size_t position = nodes_.size();
  positions_[index(node)] = static_cast<std::int32_t>(position);
  nodes_.push_back(node);
  x_.push_back(x);
  y_.push_back(y);
  level_.push_back(level);
  keys_.push_back(priority_key(frame, x, y, level));

  if (rank(position) >= range_end_) return;
  if (heap_.size() == capacity_) return fill_heap();  // throws stale entries out
  heap_.push_back(entry(position));
  std::push_heap(heap_.begin(), heap_.end(), comes_later);
}

void Queue::erase(int node) {
  SWELL_DCHECK(contains(node), "node={}", node);
  const std::size_t position = index(positions_[index(node)]);
  positions_[index(nodes_.back())] = static_cast<std::int32_t>(position);
  positions_[index(node)] = -1;
  for (auto* array : {&nodes_, &x_, &y_, &level_}) {
    (*array)[position] = array->back();
    array->pop_back();
  }
  keys_[position] = keys_.back();
  keys_.pop_back();
}

void Queue::update_keys(const PriorityFrame& frame, int groups) {
  const auto update = [&](std::size_t begin, std::size_t count) {
    const auto part = [&](auto& array) { return std::span(array).subspan(begin, count); };
    compute_priority_keys(frame, part(x_), part(y_), part(level_), part(keys_));
  };
  // From where the last group ended, and on from the first member.
  const std::size_t size = nodes_.size(), group = (size + index(groups) - 1) / index(groups);
  const std::size_t begin = std::min(next_update_, size), to_end = std::min(group, size - begin);
  update(begin, to_end);
  update(0, group - to_end);
  next_update_ = begin + to_end < size ? begin + to_end : group - to_end;
  close_range();
}

std::optional<QueueMember> Queue::first() {
  for (;;) {
    while (!heap_.empty() && is_stale(heap_.front())) {
      std::pop_heap(heap_.begin(), heap_.end(), comes_later);
      heap_.pop_back();
    }
    if (!heap_.empty()) {
      const Entry& front = heap_.front();
      return QueueMember{front.node, front.rank ^ rank_flip_, front.tie ^ tie_flip_};
    }
    if (!widen_range()) return std::nullopt;
  }
}

Queue::Entry Queue::entry(std::size_t position) const {
  const std::uint64_t tie = lattice_order(level_[position], x_[position], y_[position]);
  return {rank(position), nodes_[position], tie ^ tie_flip_};
}

// A node number may meanwhile stand for another diamond, or the diamond have come back with a newer
// key, so both are compared as well.
bool Queue::is_stale(const Entry& e) const {
  const std::int32_t position = positions_[index(e.node)];
  return position < 0 || rank(index(position)) != e.rank || entry(index(position)).tie != e.tie;
}

void Queue::close_range() {
  heap_.clear();
  range_end_ = 0;
  range_step_ = kFirstRangeStep;
}

void Queue::fill_heap() {
  heap_.clear();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (rank(i) < range_end_) heap_.push_back(entry(i));
  std::make_heap(heap_.begin(), heap_.end(), comes_later);
}

// Moves the range's end behind the next member; false if there is none.
bool Queue::widen_range() {
  std::uint64_t next = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const std::uint64_t r = rank(i);
    if (r >= range_end_ && r < next) next = r;
  }
  if (next == std::numeric_limits<std::uint64_t>::max()) return false;
  range_end_ = next + range_step_;
  range_step_ *= 2;
  fill_heap();
  return true;
}

bool Queue::heap_is_consistent() const {
  std::size_t in_range = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) in_range += rank(i) < range_end_;
  std::vector<std::int32_t> live;
  for (const Entry& e : heap_)
    if (!is_stale(e)) live.push_back(e.node);
  std::sort(live.begin(), live.end());
  live.erase(std::unique(live.begin(), live.end()), live.end());
  return live.size() == in_range && std::is_heap(heap_.begin(), heap_.end(), comes_later);
}

}  // namespace swell::lod
