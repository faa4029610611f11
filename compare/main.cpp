#include <cstdio>
#include <exception>

#include "compare/commands/commands.hpp"
#include "particle/support/version.hpp"

namespace surge::compare {
namespace {

int run(int argc, char** argv) {
  CLI::App app{"Compares particle and volume-of-fluid runs of free-surface flows."};
  const BuildInfo build = build_info();
  app.set_version_flag("--version", "surge-compare " + build.version + " (" + build.commit + ")");
  app.require_subcommand(1);
  int exit_code = exit_success;
  add_front_command(app);
  add_measure_command(app, exit_code);
  add_metrics_command(app);
  add_check_command(app, exit_code);
  add_figure_command(app);
  add_figures_command(app);
  add_report_command(app);
  add_study_command(app);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_success : exit_error;
  }
}

}  // namespace
}  // namespace surge::compare

int main(int argc, char** argv) {
  try {
    return surge::compare::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "surge-compare: %s\n", error.what());
    return surge::compare::exit_error;
  }
}
