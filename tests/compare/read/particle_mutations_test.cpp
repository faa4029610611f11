#include <gmock/gmock.h>

#include <functional>
#include <random>
#include <set>

#include "tests/compare/foreign_hdf5_writers.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using testing::foreign_facts;
using testing::foreign_front;
using testing::ForeignFlow;
using testing::TemporaryFolder;

/// A kind of source: how its files are written, and what its user says.
struct Kind {
  const char* name;
  std::function<void(const fs::path&, const ForeignFlow&)> write;
  std::string source;  ///< inside the folder; empty for the folder
  SourceOptions options = foreign_facts();
  std::vector<std::string> names;  ///< of arrays and of what else stands in the files
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// One seeded damage to the files of a source, as disks, copies and slips of the hand make them.
class Mutation {
 public:
  Mutation(fs::path folder, const Kind& kind, unsigned seed)
      : folder_(std::move(folder)), kind_(kind), random_(seed) {
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.is_regular_file()) files_.push_back(entry.path());
    std::sort(files_.begin(), files_.end());
  }

  /// Damages the files and says how.
  std::string apply() {
    switch (pick(11)) {
      case 0:
        return cut();
      case 1:
        return flip_bits(1);
      case 2:
        return flip_bits(20);
      case 3:
        return change_character("0123456789", "0123456789");
      case 4:
        return change_character("0123456789.", "-.e,D ");
      case 5:
        return exchange();
      case 6:
        return rename_array();
      case 7:
        return other_units();
      case 8:
        return drop();
      case 9:
        return other_run();
      default:
        return replace_number();
    }
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }
  const fs::path& any_file() { return files_[pick(files_.size())]; }
  static std::string told(const std::string& what, const fs::path& file) {
    return what + " " + file.filename().string();
  }

  std::string cut() {
    const fs::path& file = any_file();
    fs::resize_file(file, pick(fs::file_size(file) + 1));
    return told("cut", file);
  }
  std::string flip_bits(std::size_t count) {
    const fs::path& file = any_file();
    std::string text = bytes_of(file);
    for (std::size_t i = 0; i < count; ++i) {
      char& c = text[pick(text.size())];
      c = static_cast<char>(c ^ (1 << pick(8)));
    }
    put(file, text);
    return told("flipped " + std::to_string(count) + " in", file);
  }
  std::string change_character(const std::string& from, const std::string& to) {
    const fs::path& file = any_file();
    std::string text = bytes_of(file);
    const std::size_t start = pick(text.size());
    const std::size_t at = std::min(text.find_first_of(from, start), text.rfind(from[0]));
    if (at == std::string::npos) return cut();
    text[at] = to[pick(to.size())];
    put(file, text);
    return told("changed byte " + std::to_string(at) + " of", file);
  }
  /// Two files change places.
  std::string exchange() {
    if (files_.size() < 2) return cut();
    const fs::path a = any_file(), b = any_file();
    if (a == b || a.extension() != b.extension()) return cut();
    fs::rename(a, folder_ / "moved");
    fs::rename(b, a);
    fs::rename(folder_ / "moved", b);
    return told(told("exchanged", a) + " and", b);
  }
  std::string rename_array() {
    const std::string& name = kind_.names[pick(kind_.names.size())];
    const bool all = pick(2) == 0;
    const std::size_t one = pick(files_.size());
    for (std::size_t k = 0; k < files_.size(); ++k) {
      if (!all && k != one) continue;
      std::string text = bytes_of(files_[k]);
      for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
        text[at] = static_cast<char>(text[at] == 'q' ? 'r' : 'q');
      put(files_[k], text);
    }
    return told("renamed " + name + (all ? " in all like" : " in"), files_[one]);
  }
  /// One file, or all, in other units.
  std::string other_units() {
    constexpr double scales[] = {1000.0, 100.0, 10.0, 0.1, 0.001};
    const double scale = scales[pick(5)];
    const TemporaryFolder other;
    kind_.write(other.path(), ForeignFlow{.scale = scale});
    const bool all = pick(2) == 0;
    const fs::path one = fs::relative(any_file(), folder_);
    for (const fs::path& file : files_)
      if (const fs::path name = fs::relative(file, folder_); all || name == one)
        fs::copy_file(other.path() / name, file, fs::copy_options::overwrite_existing);
    return told("scaled by " + std::to_string(scale) + (all ? " all like" : ""), one);
  }
  std::string drop() {
    const fs::path& file = any_file();
    fs::remove(file);
    return told("dropped", file);
  }
  /// Files of another run: under names of their own, with numbers that go on, or in between.
  std::string other_run() {
    const TemporaryFolder other;
    kind_.write(other.path(), ForeignFlow{.ahead = 3});
    const std::size_t way = pick(3);
    for (const fs::path& file : files_) {
      const fs::path from = other.path() / fs::relative(file, folder_);
      std::string name = file.filename().string();
      if (way == 0) name = "b" + name;
      if (way == 1) {
        const auto digit = name.find_last_of("0123456789");
        if (digit == std::string::npos) continue;
        name.insert(digit, "1");
      }
      if (way == 2 && pick(3) != 0) continue;
      fs::copy_file(from, file.parent_path() / name, fs::copy_options::overwrite_existing);
    }
    return "another run's files, way " + std::to_string(way);
  }
  std::string replace_number() {
    static const std::vector<std::string> words{"nan", "1e400", "-1", "99999999999", "inf", "0"};
    const fs::path& file = any_file();
    std::string text = bytes_of(file);
    const std::string& word = words[pick(words.size())];
    std::size_t at = text.empty() ? 0 : pick(text.size());
    at = std::min(text.find_first_of("0123456789", at), text.size());
    const std::size_t end = std::min(text.find_first_not_of("0123456789.e-", at), text.size());
    text.replace(at, end - at, word);
    put(file, text);
    return told("a number became " + word + " in", file);
  }

  fs::path folder_;
  const Kind& kind_;
  std::mt19937 random_;
  std::vector<fs::path> files_;
};

struct Outcome {
  bool refused = false;
  std::set<std::string> notices;
  double off = 0.0;  ///< of the front, in L of the clean source
  std::size_t frames = 0;
};

Outcome outcome_of(const fs::path& source, const SourceOptions& options) {
  Outcome outcome;
  try {
    auto run = open_run(source, options);
    const FrontHistory front = measure_front(run, foreign_front());
    outcome.notices = {run.notices.begin(), run.notices.end()};
    outcome.frames = front.size();
    for (const FrontSample& sample : front) {
      const double clean = 0.1 + ForeignFlow::l0 * sample.time.value() / ForeignFlow::interval;
      outcome.off = std::max(outcome.off, std::abs(sample.position.value() - clean) / 0.1);
    }
  } catch (const Error&) {
    outcome.refused = true;
  }
  return outcome;
}

class ParticleMutations : public ::testing::TestWithParam<Kind> {};

/// Of seeded damages none crashes a reader (that would end this program) and none gives another
/// front without an error, or a notice that the clean source does not have.
TEST_P(ParticleMutations, NoneGivesAnotherFrontInSilence) {
  const unsigned tries = testing::mutation_count();
  const Kind& kind = GetParam();
  const TemporaryFolder folder;
  kind.write(folder / "clean", {});
  const Outcome clean = outcome_of(folder / "clean" / kind.source, kind.options);
  ASSERT_EQ(clean.frames, static_cast<std::size_t>(ForeignFlow::frames));
  ASSERT_LT(clean.off, 1e-5);
  unsigned refused = 0, noticed = 0, harmless = 0;
  for (unsigned seed = 1; seed <= tries; ++seed) {
    fs::copy(folder / "clean", folder / "run", fs::copy_options::recursive);
    const std::string what = Mutation(folder / "run", kind, seed).apply();
    const Outcome outcome = outcome_of(folder / "run" / kind.source, kind.options);
    const bool told = !std::includes(clean.notices.begin(), clean.notices.end(),
                                     outcome.notices.begin(), outcome.notices.end());
    // A series that is shorter, or starts later, is right where it is.
    EXPECT_TRUE(outcome.refused || told || outcome.off <= 0.02)
        << "seed " << seed << ": " << what << ": front " << outcome.off << " L off, "
        << outcome.frames << " frames";
    refused += outcome.refused ? 1 : 0;
    noticed += !outcome.refused && told ? 1 : 0;
    harmless += !outcome.refused && !told ? 1 : 0;
    fs::remove_all(folder / "run");
  }
  std::printf("%s: %u mutations: %u refused, %u with a notice, %u harmless\n", kind.name, tries,
              refused, noticed, harmless);
}

SourceOptions stepped() {
  SourceOptions options = foreign_facts();
  options.time_step = Seconds(ForeignFlow::interval);
  return options;
}

SourceOptions with_fluid() {
  SourceOptions options = foreign_facts();
  options.time_step = Seconds(1e-4);
  options.fluid_type = 1;
  return options;
}

SourceOptions table_options() {
  SourceOptions options = foreign_facts();
  options.position_array = {"px", "py"};
  options.type_array = "kind";
  options.type_required = true;
  options.fluid_type = 1;
  options.units.length = 1e-3;
  return options;
}

std::vector<Kind> kinds() {
  using Path = const fs::path&;
  using Flow = const ForeignFlow&;
  return {{"LegacyVtk",
           [](Path p, Flow f) { testing::write_dualsphysics_vtk(p, f); },
           "",
           stepped(),
           {"Type", "Vel", "Idp"}},
          {"LegacyVtkOfFluid",
           [](Path p, Flow f) { testing::write_splishsplash(p, f); },
           "",
           stepped(),
           {"velocity", "POINT", "FIELD"}},
          {"Vtu",
           [](Path p, Flow f) { testing::write_mps_basic(p, f); },
           "",
           foreign_facts(),
           {"Particle Type", "Time", "Velocity", "Points"}},
          {"VtpWithWall",
           [](Path p, Flow f) { testing::write_sphinxsys(p, false, f); },
           "",
           foreign_facts(),
           {"SortedParticle_ID", "Velocity", "Position"}},
          {"Collection",
           [](Path p, Flow f) { testing::write_trixi(p, f); },
           "fluid_1.pvd",
           foreign_facts(),
           {"velocity", "timestep", "file"}},
          {"Csv",
           [](Path p, Flow f) { testing::write_openmps(p, f); },
           "",
           stepped(),
           {"Type", "x", "z"}},
          {"CsvWithHead",
           [](Path p, Flow f) { testing::write_partvtk_csv(p, ";", f); },
           "",
           foreign_facts(),
           {"Type", "Pos.x", "TimeStep"}},
          {"TimeTable",
           [](Path p, Flow f) { testing::write_time_table(p / "all.csv", ",", f); },
           "all.csv",
           table_options(),
           {"t", "px", "kind"}},
          {"Lammps",
           [](Path p, Flow f) { testing::write_lammps(p, {}, f); },
           "dump.lammpstrj",
           with_fluid(),
           {"type", "x y z", "TIMESTEP", "ATOMS"}},
          {"Parallel",
           [](Path p, Flow f) { testing::write_parallel(p, f); },
           "",
           foreign_facts(),
           {"Points", "Source", "Time", "Piece"}},
          {"FileSeries",
           [](Path p, Flow f) { testing::write_file_series(p, f); },
           "all.vtp.series",
           foreign_facts(),
           {"name", "time", "Position", "files"}},
          {"GpuSph",
           [](Path p, Flow f) { testing::write_gpusph(p, f); },
           "VTUinp.pvd",
           foreign_facts(),
           {"Part type", "Position", "timestep"}},
          {"Gadget",
           [](Path p, Flow f) { testing::write_gadget(p, testing::GadgetUnits{}, f); },
           "",
           foreign_facts(),
           {"PartType0", "Header", "Units"}},
          {"PySph",
           [](Path p, Flow f) { testing::write_pysph(p, f); },
           "",
           foreign_facts(),
           {"fluid", "boundary", "solver_data", "arrays"}}};
}

INSTANTIATE_TEST_SUITE_P(All, ParticleMutations, ::testing::ValuesIn(kinds()),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace surge::compare
