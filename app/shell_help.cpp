// Walks over the verbs and options of the command line.
#include "app/shell_help.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"

namespace scanbench::app {
namespace {

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// "--out", "-o", ... of all options.
std::vector<std::string> option_names(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The allowed values of an option that has a list of them, which one_of() and CLI11 keep as the text "TEXT:{a,b}".
std::vector<std::string> values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto open = type.find('{');
  const auto close = type.find('}');
  std::vector<std::string> values;
  if (open == std::string::npos || close == std::string::npos) return values;
  std::string word;
  for (const char c : type.substr(open + 1, close - open - 1) + ",") {
    if (c == ',')
      values.push_back(std::exchange(word, ""));
    else
      word += c;
  }
  return values;
}

/// Cases of the word before the one that is completed: options with a list of values.
std::string value_cases(const CLI::App& verb) {
  std::string out;
  for (const CLI::Option* option : verb.get_options())
    if (const auto values = values_of(*option); !values.empty() && !option->get_lnames().empty())
      out += fmt::format("      {}:--{}) words='{}' options='' ;;\n", verb.get_name(), option->get_lnames().front(),
                         join(values, " "));
  return out;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  if (!out.empty() && (out.front() == '.' || out.front() == '\'')) out.insert(0, "\\&");
  return out;
}

/// "-o,--out TEXT" as roff; of a positional argument its name.
std::string heading(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  if (names.empty()) return "\\fI" + escaped(option.get_name()) + "\\fR";
  std::string text = "\\fB" + escaped(join(names)) + "\\fR";
  if (option.get_items_expected_max() > 0) text += " \\fIVALUE\\fR";
  return text;
}

std::string options_text(const CLI::App& app) {
  std::string out;
  for (const CLI::Option* option : app.get_options())
    out += ".TP\n" + heading(*option) + "\n" + escaped(option->get_description()) +
           (option->get_default_str().empty() ? "" : escaped(" (default: " + option->get_default_str() + ")")) + "\n";
  return out;
}

}  // namespace

std::string bash_completion(const Context& context) {
  std::vector<std::string> verbs;
  std::string cases;
  std::string values;
  for (const CLI::App* verb : verbs_of(context.app)) {
    verbs.push_back(verb->get_name());
    std::vector<std::string> words;
    for (const auto& [option, list] : context.words)
      for (const CLI::Option* own : verb->get_options())
        if (own == option) words = list();
    cases += fmt::format("    {}) words='{}' options='{}' ;;\n", verb->get_name(), join(words, " "),
                         join(option_names(*verb), " "));
    values += value_cases(*verb);
  }
  return fmt::format(R"bash(# Completion of scanbench's command line for bash: source <(scanbench completion)
_scanbench() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} verb= words= options= i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${{COMP_WORDS[i]}} != -* ]]; then
      verb=${{COMP_WORDS[i]}}
      break
    fi
  done
  case $verb in
    '') words='{}' options='{}' ;;
{}  esac
  case $verb:$before in
      -) ;;
{}  esac
  if [[ $word == -* ]]; then words=$options; fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o default -F _scanbench scanbench
)bash",
                     join(verbs, " "), join(option_names(context.app), " "), cases, values);
}

std::string manual_page(const CLI::App& app) {
  std::string out = ".TH SCANBENCH 1\n.SH NAME\nscanbench \\- a testbench for algorithms on 2D laser scans\n";
  out += ".SH SYNOPSIS\n.B scanbench\n.I verb\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n" + escaped(app.get_description()) +
         "\n.SH OPTIONS\n" + options_text(app) + ".SH VERBS\n";
  for (const CLI::App* verb : verbs_of(app))
    out += ".SS " + escaped(verb->get_name()) + "\n" + escaped(verb->get_description()) + ".\n" + options_text(*verb);
  return out + ".SH NOTES\n" + escaped(app.get_footer()) + "\n";
}

void add_shell_help(Context& context) {
  context.app
      .add_subcommand("completion", "Prints a script that completes the command line: source <(scanbench completion)")
      ->callback([&context] {
        context.action = [&context] {
          fmt::print("{}", bash_completion(context));
          return kGood;
        };
      });
  context.app.add_subcommand("manual", "Prints the manual page: scanbench manual | man -l -")->callback([&context] {
    context.action = [&context] {
      fmt::print("{}", manual_page(context.app));
      return kGood;
    };
  });
  for (const auto& [name, what] :
       {std::pair{"build", "Builds the program"}, std::pair{"test", "Builds and runs the tests"}})
    context.app
        .add_subcommand(name, fmt::format("{0}; the script ./scanbench in the folder of the sources does it: "
                                          "./scanbench {1}",
                                          what, name))
        ->allow_extras()
        ->callback([&context, verb = std::string(name)] {
          context.action = [verb]() -> int {
            throw ConfigError(verb + " is done by the script ./scanbench in the folder of the sources: ./scanbench " +
                              verb);
          };
        });
}

}  // namespace scanbench::app
