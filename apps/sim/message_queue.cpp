#include "apps/sim/message_queue.h"

#include <utility>
#include <variant>

namespace swell::apps {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr std::size_t kMostBytes = std::size_t{64} << 20;

// About how much room a message takes.
std::size_t bytes_of(const msg::Message& message) {
  return std::visit(
      [](const auto& m) {
        if constexpr (requires { m.data.size(); }) return sizeof m + m.data.size();
        return sizeof m;
      },
      message);
}

}  // namespace

MessageQueue::MessageQueue(std::span<MessageOutput* const> outputs, const std::optional<Pace>& pace,
                           bool measures, std::size_t sources)
    : outputs_(outputs), pace_(pace), measures_(measures) {
  given_.sources.resize(sources);
  thread_ = std::thread([this] { give_all(); });
}

MessageQueue::~MessageQueue() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    has_ended_ = is_stopped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void MessageQueue::put(QueuedMessage message) {
  const std::size_t bytes = bytes_of(message.message);
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return fault_ || bytes_ == 0 || bytes_ + bytes <= kMostBytes; });
  if (fault_) std::rethrow_exception(fault_);
  bytes_ += bytes;
  waiting_.push_back(std::move(message));
  changed_.notify_all();
}

void MessageQueue::finish(bool is_stopped) {
  {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
    is_stopped_ = is_stopped;
  }
  changed_.notify_all();
  thread_.join();
  if (fault_) std::rethrow_exception(fault_);
}

void MessageQueue::give_all() {
  try {
    for (QueuedMessage message; next(message);) {
      give(message);
      const std::lock_guard lock(mutex_);
      bytes_ -= bytes_of(message.message);
      changed_.notify_all();
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    fault_ = std::current_exception();
    changed_.notify_all();
  }
}

// Waits for the next message and for its moment. False at the end.
bool MessageQueue::next(QueuedMessage& message) {
  std::unique_lock lock(mutex_);
  while (true) {
    if (waiting_.empty()) {
      if (has_ended_) return false;
      changed_.wait(lock);
      continue;
    }
    const auto moment =
        pace_ ? pace_->time_of(waiting_.front().stamp_ns) : Pace::Clock::time_point::min();
    if (moment <= Pace::Clock::now()) break;
    if (is_stopped_) return false;
    changed_.wait_until(lock, moment);
  }
  message = std::move(waiting_.front());
  waiting_.pop_front();
  return true;
}

void MessageQueue::give(const QueuedMessage& message) {
  const auto begin = Pace::Clock::now();
  for (MessageOutput* output : outputs_)
    output->write(message.topic, message.stamp_ns, message.message);
  const auto end = Pace::Clock::now();
  if (!outputs_.empty()) given_.cost.add(Milliseconds(end - begin).count());
  given_.last_stamp_ns = message.stamp_ns;
  if (!pace_ || !measures_) return;
  given_.late_ms.push_back(
      static_cast<float>(Milliseconds(end - pace_->time_of(message.stamp_ns)).count()));
  given_.sources[message.source].add(message.stamp_ns,
                                     std::chrono::duration<double>(end - pace_->start).count());
}

}  // namespace swell::apps
