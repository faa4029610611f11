#include <zlib.h>

#include <nlohmann/json.hpp>

#include "particle/io/checkpoint.hpp"
#include "particle/io/source_hash.hpp"
#include "particle/support/version.hpp"
#include "tests/fuzz/reader_fuzz.hpp"

using namespace surge;

// Checkpoints whose checksum is right: what stands in them is not believed for that. An input is a
// line of JSON, {"run", "fields"}, and the bytes of the state; what names the build and the case is
// put around it, so that the corpus holds for every build. What is taken is a state that steps.

namespace {

constexpr const char* collapse = R"(title = "Fuzz"
dimension = 2
[fluid]
density = 1000.0
gravity = [0.0, -9.81]
[tank]
lower = [0.0, 0.0]
upper = [0.05, 0.05]
[[block]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.02, 0.03]
[resolution]
spacing = 0.01
[time]
end = 0.1
[output]
interval = 0.01
[method]
name = "sph"
preset = "paper"
)";

const Computation& computation() {
  static const Computation read = parse_computation(collapse, "fuzz.toml");
  return read;
}

/// The checkpoint around an input.
std::string checkpoint_of(std::string_view text) {
  const std::size_t line = std::min(text.find('\n'), text.size());
  nlohmann::json header = nlohmann::json::parse(text.substr(0, line), nullptr, false);
  if (header.is_object()) {
    const BuildInfo build = build_info();
    header["build"] = source_hash();
    header["compiler"] = build.compiler;
    header["flags"] = build.flags;
    header["case"] = to_toml(computation());
  }
  const std::string head =
      header.is_object() ? header.dump() + '\n' : std::string(text.substr(0, line));
  std::string whole =
      "surge-particle checkpoint, format 1\n" + std::to_string(head.size()) + '\n' + head;
  whole += line < text.size() ? text.substr(line + 1) : std::string_view();
  char sum[32];
  std::snprintf(sum, sizeof sum, "crc32 %08lx\n",
                crc32_z(0, reinterpret_cast<const Bytef*>(whole.data()), whole.size()));
  return whole + sum;
}

/// The input that stands for a real checkpoint, for the corpus: SURGE_FUZZ_SEED names its file.
void write_seed(const std::filesystem::path& file) {
  const auto solver = computation().make_solver<2>();
  RunRecord record;
  for (int k = 0; k < 3; ++k) record.add(solver->step(1e-3), solver->time());
  nlohmann::json fields = nlohmann::json::array();
  std::string bytes;
  for (const StateField& field : solver->state()) {
    fields.push_back({field.name, field.type, field.count, field.value_bytes});
    bytes.append(reinterpret_cast<const char*>(field.data), field.bytes());
  }
  std::ofstream(file, std::ios::binary)
      << nlohmann::json{{"run", to_json(record)}, {"fields", fields}}.dump() << '\n'
      << bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool seeded = [] {
    if (const char* file = std::getenv("SURGE_FUZZ_SEED")) write_seed(file);
    return true;
  }();
  (void)seeded;
  fuzz::scratch().put("checkpoint.bin", checkpoint_of(fuzz::text_of(data, size)));
  fuzz::try_reading([&] {
    Checkpoint checkpoint(fuzz::scratch().path(), computation());
    const auto solver = computation().restore_solver<2>(checkpoint.state());
    for (int k = 0; k < 2; ++k) (void)solver->step(1e-3);
  });
  return 0;
}
