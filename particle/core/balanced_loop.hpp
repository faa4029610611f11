#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace surge {

/// A loop over all threads in blocks. Every thread begins with its own contiguous share, whose
/// memory it has touched first, and then takes what is left of the others' shares: the loop ends
/// when the work does, not when the slowest thread has done a fixed part of it. Which thread does a
/// block is left open, so that a body must not let its result depend on that.
class BalancedLoop {
 public:
  /// Short enough that the last blocks do not keep threads waiting.
  static constexpr std::size_t usual_block = 256;

  /// body(begin, end) for the blocks of [0, size), each once.
  template <class Body>
  void blocks(std::size_t size, std::size_t block, const Body& body) {
    const std::size_t count = (size + block - 1) / block;
    const auto run = [&](std::size_t b) { body(b * block, std::min((b + 1) * block, size)); };
    const auto threads =
        std::min(static_cast<std::size_t>(omp_get_max_threads()), count / blocks_worth_a_thread);
    if (threads <= 1) {
      for (std::size_t b = 0; b < count; ++b) run(b);
      return;
    }
    if (shares_.size() < threads) shares_ = std::vector<Share>(threads);
    for (std::size_t t = 0; t < threads; ++t) {
      shares_[t].next.store(t * count / threads, std::memory_order_relaxed);
      shares_[t].end = (t + 1) * count / threads;
    }
#pragma omp parallel num_threads(static_cast <int>(threads))
    {
      // A team may be smaller than asked for: the shares of those who did not come are taken too.
      const auto own = static_cast<std::size_t>(omp_get_thread_num());
      for (std::size_t k = 0; k < threads; ++k) {
        Share& share = shares_[(own + k) % threads];
        for (std::size_t b = share.take(); b < share.end; b = share.take()) run(b);
      }
    }
  }

  /// f(i) for i < size.
  template <class F>
  void each(std::size_t size, const F& f) {
    blocks(size, usual_block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) f(i);
    });
  }

 private:
  static constexpr std::size_t blocks_worth_a_thread = 2;
  /// In a cache line of its own.
  struct alignas(64) Share {
    std::atomic<std::size_t> next = 0;
    std::size_t end = 0;
    std::size_t take() { return next.fetch_add(1, std::memory_order_relaxed); }
  };

  std::vector<Share> shares_;
};

}  // namespace surge
