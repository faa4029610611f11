#pragma once

#include <CLI/CLI.hpp>

namespace surge::compare {

/// Adds the subcommand movie, see commands/commands.hpp.
void add_movie_command(CLI::App& app);

}  // namespace surge::compare
