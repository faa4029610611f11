#include "particle/io/method_sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <set>

#include "tests/case/case_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;

json sheet_of(const std::vector<std::string>& overrides) {
  const Computation c = test::make_computation(overrides);
  return method_sheet(c.method->name, *c.make_solver<2>(), c.flow.spacing);
}

/// Simpson's rule for int f(r, value) dr over the support, which 200 steps span; `at_zero` is the
/// integrand at r = 0, where a sheet may have no sample.
template <class F>
double integral(const json& function, double at_zero, F&& f) {
  const std::vector<double> r = function["r_m"], value = function["value"];
  const std::size_t first = r[0] == 0.0 ? 0 : 1;
  double sum = at_zero;
  for (std::size_t k = 1; k <= 200; ++k) {
    const double weight = k == 200 ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    sum += weight * f(r[k - first], value[k - first]);
  }
  return sum * function["support_m"].get<double>() / 200.0 / 3.0;
}

TEST(MethodSheet, WeightFunctionHasItsMoments) {
  const json sheet = sheet_of({"method.name=mps"});
  ASSERT_EQ(sheet["functions"].size(), 2U);
  for (const auto& [k, radius] : {std::pair{0, 0.021}, std::pair{1, 0.04}}) {
    const json& w = sheet["functions"][static_cast<std::size_t>(k)];
    const double re = w["support_m"];
    EXPECT_NEAR(re, radius, 1e-12);
    EXPECT_GT(w["r_m"][0], 0.0);
    const auto volume = [](double r, double v) { return 2.0 * pi * r * v; };
    const auto second = [](double r, double v) { return 2.0 * pi * r * r * r * v; };
    EXPECT_NEAR(integral(w, 2.0 * pi * re, volume), pi * re * re, 1e-12 * re * re);
    EXPECT_NEAR(integral(w, 0.0, second) / (pi * re * re), re * re / 6.0, 1e-12 * re * re);
    EXPECT_EQ(w["value"].back(), 0.0);
  }
}

TEST(MethodSheet, KernelIntegratesToOneAndItsSlopeToTwo) {
  for (const char* kernel : {"quintic_spline", "wendland_c2"}) {
    const json sheet = sheet_of({"method.name=sph", std::string("sph.kernel=") + kernel});
    const json& value = sheet["functions"][0];
    const json& slope = sheet["functions"][1];
    EXPECT_EQ(value["r_m"][0], 0.0);
    EXPECT_NEAR(value["support_m"].get<double>() / sheet["length_m"].get<double>(),
                std::string(kernel) == "wendland_c2" ? 2.0 : 3.0, 1e-12);
    EXPECT_NEAR(integral(value, 0.0, [](double r, double v) { return 2.0 * pi * r * v; }), 1.0,
                1e-7);
    EXPECT_NEAR(integral(slope, 0.0, [](double r, double v) { return -2.0 * pi * r * r * v; }), 2.0,
                1e-7);
    EXPECT_EQ(value["unit"], "1/m2");
    EXPECT_EQ(slope["unit"], "1/m3");
  }
}

/// Names of the class's functions that the text calls, in order. Another way than the build's.
std::vector<std::string> calls_of(const std::string& header, std::string body) {
  std::set<std::string> declared;
  const std::regex declaration(R"(\n  (?:[\w\[\]:<>, ]+ )?(\w+)\([^;{]*(?:;| \{))");
  for (std::sregex_iterator it(header.begin(), header.end(), declaration), end; it != end; ++it)
    declared.insert((*it)[1]);
  std::vector<std::string> calls;
  const std::regex word(R"([\w.:>]+(?=\())");
  for (std::sregex_iterator it(body.begin(), body.end(), word), end; it != end; ++it)
    if (declared.contains(it->str())) calls.push_back(it->str());
  return calls;
}

TEST(MethodSheet, EveryFunctionThatTheStepCallsHasItsStage) {
  for (const Method& entry : methods()) {
    const std::string method(entry.name);
    const auto stages = stages_of(method);
    const std::string folder = tests::sources() + "/particle/" + method;
    const std::string source = test::read_text(folder + "/solver.cpp");
    const auto start = source.find("::step(double dt_limit) {");
    ASSERT_NE(start, std::string::npos);
    const std::string body = source.substr(start + 25, source.find("\n}\n", start) - start - 25);
    std::vector<std::string> functions;
    for (const Stage& stage : stages) {
      functions.emplace_back(stage.function);
      EXPECT_FALSE(stage.does.empty())
          << folder << "/solver.hpp: " << stage.function
          << ": no comment above its declaration, expected a line that says what it does";
    }
    EXPECT_EQ(functions, calls_of(test::read_text(folder + "/solver.hpp"), body)) << method;
    EXPECT_GE(functions.size(), 8U);
  }
}

TEST(MethodSheet, StagesNameTheEquationsOfThePaper) {
  const json sheet = sheet_of({"method.name=sph"});
  std::string equations;
  for (const json& stage : sheet["stages"])
    equations += stage["equations"].get<std::string>() + " ";
  for (const char* number : {"(20)", "(21)", "(22)", "(23)", "(24)", "(25)"})
    EXPECT_THAT(equations, testing::HasSubstr(number));
  EXPECT_EQ(sheet["loop"]["until"], "RunLoop::run");
  std::string options;
  for (const json& stage : sheet["stages"]) options += stage["if"].get<std::string>() + ";";
  EXPECT_THAT(options, testing::HasSubstr("shifting or negative_pressure=difference;"));
}

// What the build's script makes of a source: calls by plain name in their order, comments of the
// declarations, and nothing else.
TEST(MethodSheet, StagesFollowTheSource) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "toy");
  std::ofstream(folder.path() / "toy/solver.hpp") << R"(
template <int D>
class Solver {
  /// Not this one.
  void other();
  /// Moves it, Eqs. (1), (2).
  /// More about it.
  void move(double dt,
            int times);
  [[nodiscard]] double step_size() const;
  /// Weighs it; with care.
  template <class K>
  void weigh(const K& k);
};
)";
  std::ofstream(folder.path() / "toy/solver.cpp") << R"(
void Solver<D>::other() { hidden(); }
StepReport Solver<D>::step(double dt_limit) {
  // commented_out();
  const double dt = std::min(step_size(), dt_limit);
  if (dt > 0) move(dt, p_.size());  // if shifting or source=new
  weigh<D>(dt); report.add(1);
  return report;
}
void f() { after(); }
)";
  const std::string output = (folder.path() / "stages.cpp").string();
  const std::string command = "cmake -DSOURCE_DIR='" + folder.path().string() +
                              "' -DMETHODS=toy -DOUTPUT='" + output + "' -P '" + tests::sources() +
                              "/particle/io/describe_step.cmake'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(test::read_text(output), testing::HasSubstr(R"list(list_of_toy[] = {
    {"step_size", R"text()text", "", ""},
    {"move", R"text(Moves it)text", "Eqs. (1), (2)", "shifting or source=new"},
    {"weigh", R"text(Weighs it; with care)text", "", ""},
};)list"));
}

}  // namespace
}  // namespace surge
