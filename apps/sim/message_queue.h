// Messages on their way to the outputs. A thread of its own gives them, so that the next ones are
// made meanwhile.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "apps/messages/message_output.h"
#include "apps/sim/costs.h"

namespace swell::apps {

// Real time: when a stamp's moment comes.
struct Pace {
  using Clock = std::chrono::steady_clock;
  Clock::time_point start;
  std::int64_t first_ns = 0;  // the stamp of the start

  Clock::time_point time_of(std::int64_t stamp_ns) const {
    return start + std::chrono::nanoseconds(stamp_ns - first_ns);
  }
};

// What the simulation's source number `source` has published.
struct QueuedMessage {
  std::size_t source = 0, topic = 0;
  std::int64_t stamp_ns = 0;
  msg::Message message;
};

// Gives messages in the order in which they are put in, with a pace none before its moment. What an
// output throws reaches the next call of put() or finish(). Used by one thread.
class MessageQueue {
 public:
  // The outputs have to outlive it. `measures`: it keeps how late each message was.
  MessageQueue(std::span<MessageOutput* const> outputs, const std::optional<Pace>& pace,
               bool measures, std::size_t sources);
  // What has not been given yet is lost.
  ~MessageQueue();
  MessageQueue(const MessageQueue&) = delete;
  MessageQueue& operator=(const MessageQueue&) = delete;

  // Waits while there is much to be given already.
  void put(QueuedMessage message);

  // Waits until all has been given; if it `is_stopped`, all whose moment has come.
  void finish(bool is_stopped);

  // What giving took and when it was; after finish().
  const GivenMessages& given() const { return given_; }

 private:
  void give_all();
  bool next(QueuedMessage& message);
  void give(const QueuedMessage& message);

  std::span<MessageOutput* const> outputs_;
  std::optional<Pace> pace_;
  bool measures_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<QueuedMessage> waiting_;
  std::size_t bytes_ = 0;  // of what waits and of what is being given
  bool has_ended_ = false, is_stopped_ = false;
  std::exception_ptr fault_;
  GivenMessages given_;
  std::thread thread_;
};

}  // namespace swell::apps
