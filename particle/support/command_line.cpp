#include "particle/support/command_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "particle/support/error.hpp"
#include "particle/support/spelling.hpp"
#include "particle/support/version.hpp"

namespace surge {
namespace {

std::vector<CLI::App*> subcommands_of(CLI::App& app) {
  return app.get_subcommands([](CLI::App* command) { return !command->get_name().empty(); });
}

std::vector<CLI::Option*> shown_options(CLI::App& app) {
  return app.get_options([](CLI::Option* option) { return !option->get_group().empty(); });
}

/// What a subcommand is called must be known before its options can be understood.
void check_subcommand(CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const std::string word = argv[1];
  std::vector<std::string> names;
  std::string list;
  for (const CLI::App* command : subcommands_of(app)) {
    if (command->get_name() == word) return;
    names.push_back(command->get_name());
    list += (list.empty() ? "" : ", ") + command->get_name();
  }
  const std::string near = nearest(word, names);
  throw Error("found an unknown subcommand \"" + word + "\"" +
              (near.empty() ? "" : ", did you mean " + near + "?") + "; expected one of " + list);
}

/// Throws where an option is none of the subcommand's and nearly one that there is. What a misspelt
/// one was meant to give would else be told to be missing.
void suggest(CLI::App& app, int argc, char** argv) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  if (commands.empty()) return;
  std::vector<std::string> names{"--help"};
  for (const CLI::Option* known : shown_options(*commands.front()))
    for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i], option = word.substr(0, word.find('='));
    if (word == "--") return;
    if (!option.starts_with("--") || std::find(names.begin(), names.end(), option) != names.end())
      continue;
    const std::string near = nearest(option, names);
    if (!near.empty())
      throw Error("found an unknown option " + option + " of " + commands.front()->get_name() +
                  ", did you mean " + near + "?");
  }
}

/// What CLI11 says, and where to read on.
Error usage_error(CLI::App& app, const CLI::ParseError& error) {
  std::string said = error.what();
  if (said.ends_with('.')) said.pop_back();
  std::string command = app.get_name();
  for (const CLI::App* given : app.get_subcommands()) command += ' ' + given->get_name();
  return Error(said + " (" + command + " --help tells the usage)");
}

/// Text that roff prints as it is.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) {
      out += "\\&";
      out += c;
    } else {
      out += c;
    }
  }
  return out;
}

/// "--out FILE", "RUN ..."
std::string option_head(const CLI::Option& option) {
  std::string head = option.get_name(!option.get_positional(), true);
  std::replace(head.begin(), head.end(), ',', ' ');
  if (option.get_expected_max() > 0 && !option.get_positional())
    head += ' ' + option.get_type_name();
  if (option.get_expected_max() > 1) head += " ...";
  return head;
}

void write_options(std::ostream& out, CLI::App& app) {
  std::string group;
  for (const CLI::Option* option : shown_options(app)) {
    if (option->get_group() != group && option->get_group() != "Options")
      out << ".PP\n" << roff(option->get_group()) << ":\n";
    group = option->get_group();
    out << ".TP\n.B " << roff(option_head(*option)) << '\n' << roff(option->get_description());
    if (!option->get_default_str().empty()) out << roff(" [" + option->get_default_str() + "]");
    out << (option->get_required() ? " (required)\n" : "\n");
  }
}

void write_literally(std::ostream& out, const std::string& text) {
  if (!text.empty()) out << ".PP\n.nf\n" << roff(text) << "\n.fi\n";
}

std::string identifier(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Long options, blank separated.
std::string option_words(CLI::App& app) {
  std::string words;
  for (const CLI::Option* option : shown_options(app))
    for (const std::string& name : option->get_lnames())
      words += (words.empty() ? "--" : " --") + name;
  return words;
}

}  // namespace

void write_man_page(std::ostream& out, CLI::App& app) {
  const std::string name = app.get_name();
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  out << ".TH " << roff(title) << " 1 \"\" \"SurgeFront " << build_info().version
      << "\" \"SurgeFront\"\n.SH NAME\n"
      << roff(name) << " \\- " << roff(app.get_description()) << "\n.SH SYNOPSIS\n.B " << roff(name)
      << "\n.I subcommand\n[options]\n.SH OPTIONS\n";
  write_options(out, app);
  out << ".SH SUBCOMMANDS\n";
  for (CLI::App* command : subcommands_of(app)) {
    out << ".SS " << roff(command->get_name()) << '\n' << roff(command->get_description()) << '\n';
    write_options(out, *command);
    write_literally(out, command->get_footer());
  }
  out << ".SH FILES\nPresets, cases and published series are installed in "
         "/usr/share/surgefront or what stands for it.\n";
}

void write_bash_completion(std::ostream& out, CLI::App& app) {
  const std::string name = app.get_name(), function = "_" + identifier(name);
  std::string commands;
  for (const CLI::App* command : subcommands_of(app))
    commands += (commands.empty() ? "" : " ") + command->get_name();
  out << "# bash completion of " << name << ", made from its --help\n"
      << function << "() {\n"
      << "  local word=${COMP_WORDS[COMP_CWORD]} words=\n  COMPREPLY=()\n"
      << "  if ((COMP_CWORD == 1)); then\n    words='" << commands << ' ' << option_words(app)
      << "'\n  else\n    case ${COMP_WORDS[1]} in\n";
  for (CLI::App* command : subcommands_of(app))
    out << "      " << command->get_name() << ") words='" << option_words(*command) << "' ;;\n";
  out << "    esac\n    # Values are files as a rule.\n    [[ $word == -* ]] || words=\n  fi\n"
      << "  if [[ -n $words ]]; then\n    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- "
         "\"$word\")\n  fi\n"
      << "}\ncomplete -o default -o bashdefault -F " << function << ' ' << name << '\n';
}

bool parse_command_line(CLI::App& app, int argc, char** argv) {
  std::string print;
  app.add_option("--print", print, "man or completion")->group("");
  check_subcommand(app, argc, argv);
  if (argc == 3 && std::string_view(argv[1]) == "--print") {
    if (std::string_view(argv[2]) == "man") {
      write_man_page(std::cout, app);
    } else if (std::string_view(argv[2]) == "completion") {
      write_bash_completion(std::cout, app);
    } else {
      throw Error("--print: found \"" + std::string(argv[2]) + "\", expected man or completion");
    }
    return false;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) throw;
    suggest(app, argc, argv);
    throw usage_error(app, error);
  }
  return true;
}

void print_error(const std::string& program, const std::string& text) {
  const char* kind = std::getenv("TERM");
  const bool colour = isatty(STDERR_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr &&
                      kind != nullptr && std::string_view(kind) != "dumb";
  std::cerr << (colour ? "\x1b[1;31m" : "") << program << ':' << (colour ? "\x1b[0m " : " ") << text
            << std::endl;
}

}  // namespace surge
