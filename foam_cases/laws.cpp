#include "foam_cases/laws.hpp"

#include <algorithm>

#include "particle/case/enum_names.hpp"
#include "particle/support/bounds.hpp"

namespace surge::foam {

void write_entry(std::ostream& out, const std::string& key, const std::string& value) {
  out << "        " << key << std::string(16 - std::min<std::size_t>(key.size(), 15), ' ') << value
      << ";\n";
}

void write_law(std::ostream& out, const ScalarMotion& law) {
  const auto number = [&](const char* key, double value) {
    write_entry(out, key, number_text(value));
  };
  write_entry(out, "law", std::string(name_of(law.kind)));
  if (law.kind == ScalarMotion::Kind::harmonic) {
    number("amplitude", law.amplitude);
    number("period", law.period);
    number("phase", law.phase);
    number("ramp", law.ramp);
    number("start", law.start);
  } else if (law.kind == ScalarMotion::Kind::constant) {
    number("speed", law.speed);
    number("start", law.start);
    number("stop", law.stop);
  } else {
    write_entry(out, "quantity", std::string(name_of(law.quantity)));
    std::string samples = "(";
    for (const auto& sample : law.samples)
      samples += "\n            (" + number_text(sample[0]) + " " + number_text(sample[1]) + ")";
    write_entry(out, "samples", samples + "\n        )");
  }
}

}  // namespace surge::foam
