#include "compare/measure/observable.hpp"

#include <algorithm>
#include <cmath>

#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

std::size_t TimeSeries::absent() const {
  return static_cast<std::size_t>(std::count(values.begin(), values.end(), std::nullopt));
}

FrameObservable::FrameObservable(std::vector<Column> columns) {
  for (Column& column : columns)
    found_.series.push_back({std::move(column.name), std::move(column.unit), {}, {}});
}

void FrameObservable::look(FrameView& frame) {
  Values values = measure(frame);
  for (std::size_t k = 0; k < found_.series.size(); ++k) {
    TimeSeries& series = found_.series[k];
    const std::optional<double>& value = values.at(k);
    if (value && !std::isfinite(*value))
      throw Error(series.name + ": found a value that is not finite at " +
                  number_text(frame.time().value()) + " s, expected finite fields");
    series.times.push_back(frame.time());
    series.values.push_back(value);
  }
}

}  // namespace surge::compare
