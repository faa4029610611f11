#pragma once

#include <exception>
#include <string>

#include "compare/read/run.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

/// What is wrong with the files of one run: that run cannot be used, the others can.
class RunFault : public Error {
 public:
  RunFault(std::string run, const std::string& what) : Error(what), run_(std::move(run)) {}
  [[nodiscard]] const std::string& run() const { return run_; }

 private:
  std::string run_;
};

/// Calls `read`, which reads files of a run; whatever it throws becomes a RunFault with a file or
/// folder in its text.
template <class Read>
auto guarded(const std::string& name, const std::filesystem::path& files, Read&& read) {
  try {
    return read();
  } catch (const RunFault&) {
    throw;
  } catch (const Error& error) {
    throw RunFault(name, error.what());
  } catch (const std::bad_alloc&) {
    throw RunFault(name, files.string() + ": found more than fits into memory");
  } catch (const std::exception& error) {
    throw RunFault(name, files.string() + ": found something that cannot be read: " + error.what());
  }
}

/// Makes RunFaults of all that reading the run's frames throws from now on.
void guard_frames(Run& run, const std::string& name);

}  // namespace surge::compare
