// Counts what is allocated, by replacing the operators: in a program of its own for that reason.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "tests/case/solver_fixture.hpp"
#include "tests/places.hpp"

namespace {

std::atomic<long> allocations{0};

void* count(void* memory) {
  ++allocations;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return count(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto a = static_cast<std::size_t>(alignment);
  return count(std::aligned_alloc(a, (size + a - 1) / a * a));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace surge {
namespace {

/// Allocations in the steps of a collapse after the first ones. While the water spreads, its grids
/// still grow now and then: three steps of four must do without any.
template <class Solver>
void expect_steps_without_allocation(const std::string& method, const std::string& preset,
                                     const std::vector<std::string>& more = {}) {
  const std::vector<std::string> overrides{"method.name=" + method, "method.preset=" + preset,
                                           "resolution.spacing=0.005"};
  std::vector<std::string> all = overrides;
  all.insert(all.end(), more.begin(), more.end());
  if (method == "mps") all.emplace_back("mps.ppe_solver=multigrid");
  auto solver = test::make_solver<Solver>(
      read_computation(tests::sources() + "/particle/cases/dam_break.toml", all));
  const double any = std::numeric_limits<double>::max();
  for (int k = 0; k < 60; ++k) solver.step(any);
  int allocating = 0;
  for (int k = 0; k < 60; ++k) {
    const long before = allocations;
    solver.step(any);
    allocating += allocations > before ? 1 : 0;
  }
  EXPECT_LE(allocating, 15) << "of 60 steps";
}

TEST(Step, OfSphAllocatesNothing) {
  expect_steps_without_allocation<sph::Solver<2>>("sph", "paper");
}
TEST(Step, OfDeltaPlusAllocatesNothing) {
  expect_steps_without_allocation<sph::Solver<2>>("sph", "delta-plus");
}
TEST(Step, OfMpsAllocatesNothing) {
  expect_steps_without_allocation<mps::Solver<2>>("mps", "paper");
}
TEST(Step, OfMpsImprovedAllocatesNothing) {
  expect_steps_without_allocation<mps::Solver<2>>("mps", "improved");
}

TEST(Counter, SeesAnAllocation) {
  const long before = allocations;
  const std::vector<double> some(1000, 1.0);
  EXPECT_EQ(some.front(), 1.0);
  EXPECT_GT(allocations, before);
}

}  // namespace
}  // namespace surge
