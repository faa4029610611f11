#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>

namespace surge {

/// Iterations of a few operations each that a second thread shortens. Fewer are done before it is
/// awake.
inline constexpr std::ptrdiff_t worth_sharing = 4096;

/// Whether a loop over n iterations is shared between threads, where `from` iterations are worth
/// it. OpenMP's own if-clause makes a team of one, whose barrier still asks the kernel to wake
/// nobody: a system call per loop, which at two thousand particles was a tenth of a step.
inline bool is_shared(std::ptrdiff_t n, std::ptrdiff_t from) {
  return n >= from && omp_get_max_threads() > 1;
}

/// f(i) for 0 <= i < n, by all threads, each with one contiguous range; by this thread alone where
/// there are less than `from` iterations. Index is an integer type that holds n.
template <class Index, class F>
void parallel_for(Index n, std::ptrdiff_t from, const F& f) {
  if (!is_shared(n, from)) {
    for (Index i = 0; i < n; ++i) f(i);
    return;
  }
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < n; ++i) f(i);
}

/// The same in stretches of `length` iterations, dealt out to the threads in turn, where the work
/// differs from stretch to stretch.
template <class Index, class F>
void parallel_for_in_stretches(Index n, int length, const F& f) {
  if (!is_shared(n, 2 * length)) {
    for (Index i = 0; i < n; ++i) f(i);
    return;
  }
#pragma omp parallel for schedule(static, length)
  for (Index i = 0; i < n; ++i) f(i);
}

/// f(i, thread), `length` iterations at a time for whichever thread is free: for long iterations of
/// which nobody knows how long they are. `thread` is less than omp_get_max_threads().
template <class Index, class F>
void parallel_for_in_turn(Index n, int length, const F& f) {
  if (!is_shared(n, length + 1)) {
    for (Index i = 0; i < n; ++i) f(i, std::size_t{0});
    return;
  }
#pragma omp parallel for schedule(dynamic, length)
  for (Index i = 0; i < n; ++i) f(i, static_cast<std::size_t>(omp_get_thread_num()));
}

/// What is left of `start` after f(i, own) for 0 <= i < n, where each thread has an `own` that
/// begins as `start`, and join(all, own) puts them together in any order. The result does not
/// depend on the number of threads where join is exact, as for the largest and for whole numbers,
/// and `start` is its neutral element.
template <class T, class Index, class F, class Join>
T parallel_reduce(Index n, std::ptrdiff_t from, const T& start, const F& f, const Join& join) {
  T all = start;
  if (!is_shared(n, from)) {
    for (Index i = 0; i < n; ++i) f(i, all);
    return all;
  }
#pragma omp parallel
  {
    T own = start;
#pragma omp for schedule(static) nowait
    for (Index i = 0; i < n; ++i) f(i, own);
#pragma omp critical(surge_parallel_reduce)
    join(all, own);
  }
  return all;
}

/// To join the largest of each thread.
inline void larger(double& all, double own) {
  all = std::max(all, own);
}

}  // namespace surge
