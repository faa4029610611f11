#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkDummyController.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPOpenFOAMReader.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>

#include "compare/read/foam_times.hpp"
#include "compare/read/readers.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// vtkPOpenFOAMReader on one kind of case. It takes a missing case or a misspelt field for an empty
/// one, so everything is checked here.
class FoamReader : public FrameReader {
 public:
  FoamReader(fs::path folder, bool decomposed, std::string alpha, FoamTimes complete)
      : folder_(std::move(folder)),
        alpha_(std::move(alpha)),
        notices_(std::move(complete.notices)) {
    const VtkErrors errors;
    reader_->SetController(controller_);
    // Any file of the case's system folder names the case.
    reader_->SetFileName((folder_ / "system" / "controlDict").c_str());
    reader_->SetCaseType(decomposed ? vtkPOpenFOAMReader::DECOMPOSED_CASE
                                    : vtkPOpenFOAMReader::RECONSTRUCTED_CASE);
    reader_->SkipZeroTimeOff();
    reader_->CreateCellToPointOff();
    reader_->CacheMeshOn();
    // Kept whole: a decomposed polyhedron would no longer be one cell with one value.
    reader_->DecomposePolyhedraOff();
    reader_->UpdateInformation();
    errors.check(folder_);
    vtkDoubleArray* times = reader_->GetTimeValues();
    for (vtkIdType i = 0; times && i < times->GetNumberOfTuples(); ++i) {
      const Seconds time(times->GetValue(i));
      const bool usable = std::any_of(complete.times.begin(), complete.times.end(), [&](Seconds t) {
        return std::abs((t - time).value()) <= 1e-12 + 1e-9 * std::abs(t.value());
      });
      if (usable) times_.push_back(time);
    }
    reader_->DisableAllPatchArrays();
    reader_->SetPatchArrayStatus("internalMesh", 1);
  }

  [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }
  [[nodiscard]] std::vector<std::string> notices() const override { return notices_; }

  [[nodiscard]] Frame read(std::size_t index, Fields fields) override {
    MeshFrame frame;
    frame.time = times_.at(index);
    frame.alpha_name = alpha_;
    const std::string place = folder_.string() + ", time " + time_text(frame.time);
    const VtkErrors errors;
    reader_->DisableAllCellArrays();
    reader_->SetCellArrayStatus(alpha_.c_str(), 1);
    if (fields.pressure) reader_->SetCellArrayStatus("p", 1);
    if (fields.velocity) reader_->SetCellArrayStatus("U", 1);
    reader_->UpdateTimeStep(frame.time.value());
    errors.check(place);
    frame.grid = internal_mesh(place);
    vtkDataArray* alpha = frame.grid->GetCellData()->GetArray(alpha_.c_str());
    if (!alpha)
      throw Error(place + ": no volume fraction " + alpha_ +
                  " found, one expected (--alpha-array)");
    if (alpha->GetNumberOfComponents() != 1 ||
        alpha->GetNumberOfTuples() != frame.grid->GetNumberOfCells()) {
      throw Error(place + ": " + alpha_ + ": " + std::to_string(alpha->GetNumberOfTuples()) +
                  " values found, " + std::to_string(frame.grid->GetNumberOfCells()) +
                  " cells expected");
    }
    frame.alpha.resize(static_cast<std::size_t>(alpha->GetNumberOfTuples()));
    for (std::size_t c = 0; c < frame.alpha.size(); ++c) {
      frame.alpha[c] = alpha->GetComponent(static_cast<vtkIdType>(c), 0);
      if (!std::isfinite(frame.alpha[c]))
        throw Error(place + ": " + alpha_ + ": not finite in cell " + std::to_string(c));
    }
    return frame;
  }

 private:
  static std::string time_text(Seconds time) {
    std::string text = std::to_string(time.value());
    text.erase(text.find_last_not_of('0') + 1);
    return text + " s";
  }

  vtkSmartPointer<vtkUnstructuredGrid> internal_mesh(const std::string& place) {
    vtkMultiBlockDataSet* blocks = reader_->GetOutput();
    for (unsigned i = 0; blocks && i < blocks->GetNumberOfBlocks(); ++i) {
      auto* grid = vtkUnstructuredGrid::SafeDownCast(blocks->GetBlock(i));
      if (!grid || grid->GetNumberOfCells() == 0) continue;
      // The reader reuses its output; the frame must not change under its owner.
      auto copy = vtkSmartPointer<vtkUnstructuredGrid>::New();
      copy->ShallowCopy(grid);
      return copy;
    }
    throw Error(place + ": no mesh found, constant/polyMesh expected");
  }

  fs::path folder_;
  std::string alpha_;
  vtkNew<vtkDummyController> controller_;
  vtkNew<vtkPOpenFOAMReader> reader_;
  std::vector<Seconds> times_;
  std::vector<std::string> notices_;
};

/// The volume fraction of the water: as the user names it, or the only one that there is.
std::string alpha_of(const fs::path& folder, const std::string& asked) {
  const std::vector<std::string> found = foam_phases(folder);
  if (found.empty() || std::find(found.begin(), found.end(), asked) != found.end()) return asked;
  if (found.size() == 1 && asked == SourceOptions{}.alpha_array) return found.front();
  std::string names;
  for (const std::string& name : found) names += (names.empty() ? "" : ", ") + name;
  throw Error(folder.string() + ": no " + asked + ", found " + names +
              "; expected the one of the water (--alpha-array)");
}

}  // namespace

std::unique_ptr<FrameReader> open_foam_case(const fs::path& folder, const SourceOptions& options) {
  if (!fs::is_regular_file(folder / "system" / "controlDict")) {
    throw Error(folder.string() + ": no system/controlDict found, an OpenFOAM case expected");
  }
  const std::vector<fs::path> processors = foam_processors(folder);
  const std::string alpha =
      alpha_of(processors.empty() ? folder : processors.front(), options.alpha_array);
  std::unique_ptr<FrameReader> best;
  for (const bool decomposed : {false, true}) {
    if (decomposed && processors.empty()) continue;
    const fs::path& first = decomposed ? processors.front() : folder;
    if (!fs::is_directory(first / "constant" / "polyMesh")) continue;
    auto reader = std::make_unique<FoamReader>(
        folder, decomposed, alpha,
        foam_times(decomposed ? processors : std::vector<fs::path>{folder}, alpha));
    if (!best || reader->times().size() > best->times().size()) best = std::move(reader);
  }
  refuse_collated(folder, alpha);
  if (!best)
    throw Error(folder.string() +
                ": no constant/polyMesh found, a case with its mesh expected (blockMesh)");
  if (best->times().empty())
    throw Error(folder.string() + ": no time folder with " + alpha + " found, results expected");
  return best;
}

}  // namespace surge::compare
