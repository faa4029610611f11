#include <vtkLogger.h>
#include <vtkStringOutputWindow.h>

#include <algorithm>

#include "compare/read/readers.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

VtkErrors::VtkErrors()
    : window_(vtkSmartPointer<vtkStringOutputWindow>::New()),
      previous_(vtkOutputWindow::GetInstance()) {
  vtkOutputWindow::SetInstance(window_);
  // VTK logs to stderr besides; its errors become ours, so that they are printed once.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkErrors::~VtkErrors() {
  vtkOutputWindow::SetInstance(previous_);
}

void VtkErrors::check(const std::filesystem::path& file) const {
  const std::string text = window_->GetOutput();
  // A warning, too: readers warn of a file that is cut short and go on with what they have.
  const auto start = std::min(text.find("ERROR"), text.find("Warning"));
  if (start == std::string::npos) return;
  // "ERROR: In <source file>, line <n>\n<class> (<address>): <message>\n\n"
  auto message = text.find("): ", start);
  message = message == std::string::npos ? start : message + 3;
  throw Error(file.string() +
              ": cannot be read: " + text.substr(message, text.find('\n', message) - message));
}

}  // namespace surge::compare
