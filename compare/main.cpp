#include <cstdio>
#include <exception>

#include "compare/commands/commands.hpp"
#include "compare/movie/command_movie.hpp"
#include "particle/support/command_line.hpp"
#include "particle/support/file_size_limit.hpp"
#include "particle/support/printable.hpp"
#include "particle/support/version.hpp"

namespace surge::compare {
namespace {

int run(int argc, char** argv) {
  CLI::App app{"Compares particle and volume-of-fluid runs of free-surface flows", "surge-compare"};
  const BuildInfo build = build_info();
  app.set_version_flag("--version", "surge-compare " + build.version + " (" + build.commit + ")");
  app.require_subcommand(1);
  int exit_code = exit_success;
  add_front_command(app);
  add_measure_command(app, exit_code);
  add_metrics_command(app, exit_code);
  add_check_command(app, exit_code);
  add_figure_command(app);
  add_figures_command(app);
  add_report_command(app);
  add_movie_command(app);
  add_study_command(app);
  add_new_study_command(app);
  add_plot_command(app);
  try {
    return parse_command_line(app, argc, argv) ? exit_code : static_cast<int>(exit_success);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
}

}  // namespace
}  // namespace surge::compare

int main(int argc, char** argv) {
  try {
    surge::report_file_size_limit();
    return surge::compare::run(argc, argv);
  } catch (const std::exception& error) {
    surge::print_error("surge-compare", surge::printable_lines(error.what()));
    return surge::compare::exit_error;
  }
}
