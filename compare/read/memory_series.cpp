#include "compare/read/memory_series.hpp"

#include <cmath>

#include "compare/read/first_column.hpp"
#include "compare/read/frame_watch.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

std::string place_of(const std::string& name, Seconds time) {
  return name + ": frame of " + number_text(time.value()) + " s";
}

class MemorySeries : public FrameReader {
 public:
  MemorySeries(std::string name, std::vector<ParticleFrame> frames, const FileAxes& axes)
      : name_(std::move(name)), frames_(std::move(frames)), axes_(axes) {
    if (frames_.empty()) throw Error(name_ + ": found no frame, one at least expected");
    for (const ParticleFrame& frame : frames_) {
      if (!frame.time.is_finite() || (!times_.empty() && frame.time <= times_.back()))
        throw Error(place_of(name_, frame.time) + ": expected a finite time after that before it");
      times_.push_back(frame.time);
      require_size(frame, frame.velocity.size(), "velocities");
      require_size(frame, frame.pressure.size(), "pressures");
    }
  }

  [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }

  [[nodiscard]] Frame read(std::size_t index, Fields fields) override {
    const ParticleFrame& given = frames_.at(index);
    ParticleFrame frame;
    frame.time = given.time;
    const std::string place = place_of(name_, given.time);
    const bool velocity = fields.velocity && !given.velocity.empty();
    const bool pressure = fields.pressure && !given.pressure.empty();
    for (std::size_t i = 0; i < given.position.size(); ++i) {
      const Vec3& x = given.position[i];
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2])) {
        ++frame.nonfinite;
        continue;
      }
      frame.position.push_back(axes_.apply(x));
      if (velocity) frame.velocity.push_back(axes_.apply(given.velocity[i]));
      if (pressure) frame.pressure.push_back(given.pressure[i]);
    }
    watch_.look(frame, index, place);
    return frame;
  }

  [[nodiscard]] std::vector<std::string> notices() const override { return watch_.notices(times_); }

  void expect(Metres spacing, const std::optional<Extent>& tank) { watch_.expect(spacing, tank); }

 private:
  void require_size(const ParticleFrame& frame, std::size_t size, const std::string& what) const {
    if (size != 0 && size != frame.position.size())
      throw Error(place_of(name_, frame.time) + ": found " + std::to_string(size) + " " + what +
                  ", expected " + std::to_string(frame.position.size()) + " or none");
  }

  std::string name_;
  std::vector<ParticleFrame> frames_;
  FileAxes axes_;
  std::vector<Seconds> times_;
  FrameWatch watch_;
};

}  // namespace

Run open_memory(const std::string& name, std::vector<ParticleFrame> frames,
                const SourceOptions& options) {
  if (!options.spacing || !options.gravity)
    throw Error(name + ": found no spacing or no gravity, expected both");
  Run run;
  run.name = name;
  run.path = name;
  run.kind = SourceKind::particle_series;
  auto series =
      std::make_unique<MemorySeries>(name, std::move(frames), options.axes.value_or(FileAxes{}));
  MemorySeries& reader = *series;
  run.frames = std::move(series);
  settle_column(run, options, options.axes || options.vertical_stated,
                [&](Metres spacing, const auto& tank) { reader.expect(spacing, tank); });
  apply_options(run, options);
  return run;
}

}  // namespace surge::compare
