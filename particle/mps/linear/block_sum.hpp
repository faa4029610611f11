#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "particle/core/particles.hpp"

namespace surge::mps {

/// Runs a loop in blocks of fixed size over all threads and adds up what the blocks return in their
/// order: the sum is the same to the last bit whatever the number of threads.
class BlockSum {
 public:
  static constexpr std::int32_t block = 1024;

  /// `body(begin, end)` returns the partial sum of its range.
  template <class Body>
  double operator()(std::size_t size, const Body& body) {
    const auto n = static_cast<std::int32_t>(size);
    const std::int32_t blocks = (n + block - 1) / block;
    partial_.resize(static_cast<std::size_t>(blocks));
#pragma omp parallel for schedule(static) if (blocks > 4)
    for (std::int32_t b = 0; b < blocks; ++b) {
      const auto begin = static_cast<std::size_t>(b) * block;
      partial_[static_cast<std::size_t>(b)] = body(begin, std::min(begin + block, size));
    }
    double sum = 0.0;
    for (const double part : partial_) sum += part;
    return sum;
  }

 private:
  Field partial_;
};

/// a . b
inline double dot(const Field& a, const Field& b, BlockSum& block_sum) {
  return block_sum(a.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
  });
}

}  // namespace surge::mps
