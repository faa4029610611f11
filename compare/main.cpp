#include <cstdio>
#include <exception>

#include "compare/commands.hpp"
#include "particle/support/version.hpp"

int main(int argc, char** argv) {
  using namespace surge::compare;
  CLI::App app{"Compares particle and volume-of-fluid runs of free-surface flows."};
  const surge::BuildInfo build = surge::build_info();
  app.set_version_flag("--version", "surge-compare " + build.version + " (" + build.commit + ")");
  app.require_subcommand(1);
  int exit_code = exit_success;
  add_front_command(app);
  add_metrics_command(app);
  add_check_command(app, exit_code);
  add_figure_command(app);
  add_figures_command(app);
  add_report_command(app);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_success : exit_error;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "surge-compare: %s\n", error.what());
    return exit_error;
  }
}
