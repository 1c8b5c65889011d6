// A priority queue whose members all change their keys every frame, of which only a few are asked
// for.
//
// Members lie in arrays (for SIMD over all keys); the nearest few also in a heap. "Near" is a
// range of ranks that grows, by twice the last step, whenever the heap runs dry: a frame that
// changes a few hundred of 30,000 diamonds never sorts the rest.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lod/priority.h"

namespace swell::lod {

struct QueueMember {
  std::int32_t node;
  PriorityKey key;
  std::uint64_t tie;  // lattice_order()

  // The total order: highest priority first, parents before children.
  friend bool operator<(const QueueMember& a, const QueueMember& b) {
    return a.key != b.key ? a.key < b.key : a.tie < b.tie;
  }
};

class Queue {
 public:
  enum class Order : std::uint8_t { kHighestPriorityFirst, kLowestPriorityFirst };

  // Storage for `capacity` members with node numbers below node_capacity.
  Queue(Order order, int capacity, int node_capacity);

  int size() const { return static_cast<int>(nodes_.size()); }
  bool contains(int node) const { return positions_[static_cast<std::size_t>(node)] >= 0; }
  PriorityKey key(int node) const;  // of a member

  // By position in [0, size()), in no order: insert() adds a last one, and erase() moves the last
  // one into the gap.
  int node_at(int position) const { return nodes_[static_cast<std::size_t>(position)]; }
  PriorityKey key_at(int position) const { return keys_[static_cast<std::size_t>(position)]; }

  void clear();
  void insert(const PriorityFrame& frame, int node, int x, int y, int level);
  void erase(int node);  // must be a member

  // New keys for one of `groups` >= 1 groups of about the same size, in turn; 1: for all members.
  // Members that erase() moves may miss their turn.
  void update_keys(const PriorityFrame& frame, int groups = 1);

  // The first member in the queue's order, if there is one.
  std::optional<QueueMember> first();

  // True if the heap holds every member of its range, in heap order. For tests.
  bool heap_is_consistent() const;

 private:
  // Heap entries sort ascending; both words are complemented if the lowest priority comes first.
  struct Entry {
    std::uint32_t rank;
    std::int32_t node;
    std::uint64_t tie;
  };
  static bool comes_later(const Entry& a, const Entry& b) {
    return a.rank != b.rank ? a.rank > b.rank : a.tie > b.tie;
  }

  std::uint32_t rank(std::size_t position) const { return keys_[position] ^ rank_flip_; }
  Entry entry(std::size_t position) const;
  bool is_stale(const Entry& entry) const;
  void close_range();
  void fill_heap();
  bool widen_range();

  std::size_t capacity_;
  std::uint32_t rank_flip_;
  std::uint64_t tie_flip_;
  std::vector<std::int32_t> nodes_, x_, y_, level_;
  std::vector<PriorityKey> keys_;
  std::vector<std::int32_t> positions_;  // by node; -1: not a member
  std::size_t next_update_ = 0;          // the first position of the next group
  std::vector<Entry> heap_;              // members with rank < range_end_, and stale ones
  std::uint64_t range_end_ = 0, range_step_ = 0;
};

}  // namespace swell::lod
