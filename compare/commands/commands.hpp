#pragma once

#include <CLI/CLI.hpp>

namespace surge::compare {

/// What the program returns to the shell.
enum ExitCode : int { exit_success = 0, exit_error = 1, exit_check_failed = 2, exit_skipped = 77 };

/// Each adds a subcommand whose callback does the work and throws surge::Error; where there is an
/// exit_code, it stores in it what main returns.
void add_front_command(CLI::App& app);
void add_measure_command(CLI::App& app, int& exit_code);
void add_metrics_command(CLI::App& app, int& exit_code);
void add_figure_command(CLI::App& app);
void add_figures_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_study_command(CLI::App& app);
void add_new_study_command(CLI::App& app);
void add_plot_command(CLI::App& app);
void add_check_command(CLI::App& app, int& exit_code);

}  // namespace surge::compare
