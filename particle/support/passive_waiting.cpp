#include "particle/support/passive_waiting.hpp"

#include <unistd.h>

#include <cstdlib>

namespace surge {
namespace {

/// Looks at the barrier, each with a pause of up to some 140 cycles in between: about as long as
/// waking a thread that sleeps takes, so that the two together cost no more than twice the best.
constexpr const char* spins = "1000";

}  // namespace

void wait_passively(char** arguments) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  if (setenv("GOMP_SPINCOUNT", spins, 0) != 0) return;
  execv("/proc/self/exe", arguments);
}

}  // namespace surge
