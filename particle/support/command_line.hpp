#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>

namespace surge {

/// Parses the command line of a program with subcommands. A word that is none of them is an error
/// with the nearest that is. `--print man` and `--print completion`, which packages are made with,
/// write that to the standard output; false is then returned and nothing else is done. Throws
/// surge::Error where the words are not understood, with the option that a misspelt one may mean,
/// and CLI::ParseError where help or the version was asked for: app.exit() prints that.
[[nodiscard]] bool parse_command_line(CLI::App& app, int argc, char** argv);

/// The manual page (roff, section 1) of a program: what --help says of it and of each subcommand.
void write_man_page(std::ostream& out, CLI::App& app);

/// Completion of subcommands and options for bash; other words are completed as file names.
void write_bash_completion(std::ostream& out, CLI::App& app);

/// "program: text" as a line on the standard error, the name in red on a terminal (NO_COLOR and a
/// dumb one are heeded).
void print_error(const std::string& program, const std::string& text);

}  // namespace surge
