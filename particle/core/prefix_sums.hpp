#pragma once

#include <omp.h>

#include <cstddef>
#include <vector>

namespace surge {

/// Sums of whole numbers, by all threads: their result does not depend on how many there are.
class PrefixSums {
 public:
  /// out[0] = 0, out[k + 1] = out[k] + count(k) for k < n; returns out[n]. `count` is called twice
  /// for each k, by threads in any order, and may read out[k + 1] as it was before.
  template <class T, class F>
  T operator()(std::size_t n, F&& count, T* out) {
    const auto most = static_cast<std::size_t>(omp_get_max_threads());
    if (most == 1 || n < worth_a_team) {
      out[0] = 0;
      for (std::size_t k = 0; k < n; ++k) out[k + 1] = out[k] + static_cast<T>(count(k));
      return out[n];
    }
    before_.resize(most + 1);
#pragma omp parallel
    {
      const auto t = static_cast<std::size_t>(omp_get_thread_num());
      const auto team = static_cast<std::size_t>(omp_get_num_threads());
      const std::size_t begin = n * t / team;
      const std::size_t end = n * (t + 1) / team;
      T sum = 0;
      for (std::size_t k = begin; k < end; ++k) sum += static_cast<T>(count(k));
      before_[t + 1] = static_cast<std::size_t>(sum);
#pragma omp barrier
#pragma omp single
      {
        before_[0] = 0;
        for (std::size_t k = 0; k < team; ++k) before_[k + 1] += before_[k];
        out[0] = 0;
      }
      T next = static_cast<T>(before_[t]);
      for (std::size_t k = begin; k < end; ++k) {
        next += static_cast<T>(count(k));
        out[k + 1] = next;
      }
    }
    return out[n];
  }

 private:
  /// Numbers that are summed faster than threads are woken.
  static constexpr std::size_t worth_a_team = 16384;
  std::vector<std::size_t> before_;  ///< sum before each thread's stretch
};

}  // namespace surge
