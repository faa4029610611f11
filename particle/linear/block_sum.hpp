#pragma once

#include <cstddef>

#include "particle/core/balanced_loop.hpp"
#include "particle/core/particles.hpp"

namespace surge::linear {

/// Runs a loop in blocks of fixed size over all threads and adds up what the blocks return in their
/// order: the sum is the same to the last bit whatever the number of threads.
class BlockSum {
 public:
  static constexpr std::size_t block = 1024;

  /// `body(begin, end)` returns the partial sum of its range.
  template <class Body>
  double operator()(std::size_t size, const Body& body) {
    partial_.resize((size + block - 1) / block);
    loop_.blocks(size, block, [&](std::size_t begin, std::size_t end) {
      partial_[begin / block] = body(begin, end);
    });
    double sum = 0.0;
    for (const double part : partial_) sum += part;
    return sum;
  }

 private:
  Field partial_;
  BalancedLoop loop_;
};

/// a . b
inline double dot(const Field& a, const Field& b, BlockSum& block_sum) {
  return block_sum(a.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
  });
}

}  // namespace surge::linear
