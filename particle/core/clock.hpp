#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace surge {

/// The parts of a run that the manifest tells apart.
enum class Phase : std::size_t { setup, neighbours, pressure, forces, output };
inline constexpr std::array<const char*, 5> phase_names{"setup", "neighbours", "pressure", "forces",
                                                        "output"};

/// Wall-clock seconds per phase.
class Clock {
 public:
  /// Adds the time from its construction to its destruction to a phase.
  class Scope {
   public:
    Scope(Clock& clock, Phase phase)
        : clock_(clock), phase_(phase), start_(std::chrono::steady_clock::now()) {}
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() {
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
      clock_.seconds_[static_cast<std::size_t>(phase_)] += spent.count();
    }

   private:
    Clock& clock_;
    Phase phase_;
    std::chrono::steady_clock::time_point start_;
  };

  [[nodiscard]] Scope measure(Phase phase) { return Scope(*this, phase); }
  [[nodiscard]] double seconds(Phase phase) const {
    return seconds_[static_cast<std::size_t>(phase)];
  }

 private:
  std::array<double, phase_names.size()> seconds_{};
};

}  // namespace surge
