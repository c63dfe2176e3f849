// Who may work where when several threads fill one field: locks on strips of rows around the torus.

#pragma once

#include <hwy/cache_control.h>

#include <atomic>
#include <cstddef>
#include <vector>

namespace bn::noise {

/// Strips of rows, each held by at most one thread. What a thread wrote there is seen by the next that holds
/// it.
class RowLocks {
 public:
  static constexpr int kRows = 8;  ///< of a strip at least

  /// Threads look and write up to `reach` rows around where they are. With `exclusive` there is one thread
  /// only, and nothing is locked.
  RowLocks(int rows, int reach, bool exclusive)
      : rows_(rows), reach_(reach), taken_(static_cast<std::size_t>(exclusive ? 1 : rows / kRows)) {}

  /// What one thread holds. What it cannot get, another thread is working on; it never waits for that while
  /// it holds anything, so no two threads wait for each other.
  class Holder {
   public:
    explicit Holder(RowLocks& locks) : locks_(locks) {}
    ~Holder() { release(); }
    Holder(const Holder&) = delete;
    Holder& operator=(const Holder&) = delete;

    /// Holds all rows in reach of `row`, and lets others go; without success it holds none.
    bool move_to(int row) {
      const int strips = locks_.strips();
      if (strips == 1) return true;
      const int above = locks_.strip_of(row - locks_.reach_);
      const int count = (locks_.strip_of(row + locks_.reach_) - above + strips) % strips + 1;
      if (above == first_ && count == count_) return true;
      const auto wants = [&](int strip) { return (strip - above + strips) % strips < count; };
      const auto has = [&](int strip) { return (strip - first_ + strips) % strips < count_; };
      for (int i = 0; i < count_; ++i) {
        if (const int strip = (first_ + i) % strips; !wants(strip)) locks_.give(strip);
      }
      for (int i = 0; i < count; ++i) {
        const int strip = (above + i) % strips;
        if (has(strip) || locks_.take(strip)) continue;
        for (int j = 0; j < count; ++j) {
          const int other = (above + j) % strips;
          if (j < i || has(other)) locks_.give(other);
        }
        count_ = 0;
        return false;
      }
      first_ = above;
      count_ = count;
      return true;
    }

    /// move_to(), tried again for about as long as another thread needs to move on.
    bool wait_for(int row) {
      constexpr int kTries = 200;
      for (int i = 0; i < kTries; ++i) {
        if (move_to(row)) return true;
        hwy::Pause();
      }
      return false;
    }

    void release() {
      for (int i = 0; i < count_; ++i) locks_.give((first_ + i) % locks_.strips());
      count_ = 0;
    }

   private:
    RowLocks& locks_;
    int first_ = 0;  // of the strips held, which follow each other around the torus
    int count_ = 0;
  };

 private:
  // A line of memory each: threads that hold neighbours do not disturb each other.
  struct alignas(64) Taken {
    std::atomic<bool> value = false;
  };

  int strips() const { return static_cast<int>(taken_.size()); }
  int strip_of(int row) const {
    row = row < 0 ? row + rows_ : row >= rows_ ? row - rows_ : row;
    return row / kRows < strips() ? row / kRows : strips() - 1;
  }
  bool take(int strip) {
    auto& taken = taken_[static_cast<std::size_t>(strip)].value;
    return !taken.load(std::memory_order_relaxed) && !taken.exchange(true, std::memory_order_acquire);
  }
  void give(int strip) {
    taken_[static_cast<std::size_t>(strip)].value.store(false, std::memory_order_release);
  }

  int rows_;
  int reach_;
  std::vector<Taken> taken_;
};

}  // namespace bn::noise
