#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace navvi_nav::search {

/// A priority queue, the least key first: a heap with four children a node. The entry pushed last
/// is often the least, so the least one pushed since the last pop from the heap is kept outside of
/// it. Keeps its memory.
template <typename Key, typename Item>
class OpenList {
 public:
  struct Entry {
    Key key;
    Item item;
  };

  void clear() {
    heap_.clear();
    has_first_ = false;
  }
  [[nodiscard]] bool empty() const { return heap_.empty() && !has_first_; }
  void push(Key key, Item item) {
    Entry entry{key, item};
    if (!std::exchange(has_first_, true)) {
      first_ = entry;
      return;
    }
    if (entry.key < first_.key) std::swap(entry, first_);
    sift_up(entry);
  }
  /// Removes the least entry. The list must not be empty.
  Entry pop() {
    if (has_first_ && (heap_.empty() || first_.key <= heap_[0].key)) {
      has_first_ = false;
      return first_;
    }
    const Entry least = heap_[0];
    const Entry last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sift_down(last);
    return least;
  }

 private:
  void sift_up(const Entry& entry) {
    std::size_t i = heap_.size();
    heap_.push_back(entry);
    while (i > 0) {
      const std::size_t up = (i - 1) / 4;
      if (heap_[up].key <= entry.key) break;
      heap_[i] = heap_[up];
      i = up;
    }
    heap_[i] = entry;
  }
  void sift_down(const Entry& entry) {
    const std::size_t count = heap_.size();
    std::size_t i = 0;
    while (4 * i + 1 < count) {
      std::size_t least = 4 * i + 1;
      const std::size_t end = std::min(least + 4, count);
      for (std::size_t k = least + 1; k < end; ++k) {
        if (heap_[k].key < heap_[least].key) least = k;
      }
      if (heap_[least].key >= entry.key) break;
      heap_[i] = heap_[least];
      i = least;
    }
    heap_[i] = entry;
  }

  std::vector<Entry> heap_;
  Entry first_{};
  bool has_first_ = false;
};

}  // namespace navvi_nav::search
