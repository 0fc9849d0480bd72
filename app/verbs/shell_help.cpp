// Writes the completion and the manual page from the description of the command line.
#include "app/verbs/shell_help.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/error.hpp"
#include "core/names.hpp"

namespace scanbench::app {
namespace {

/// "--out", "-o", ... of all options.
Words option_names(const VerbDescription& verb) {
  Words names;
  for (const OptionDescription& option : verb.options) {
    names.insert(names.end(), option.long_names.begin(), option.long_names.end());
    names.insert(names.end(), option.short_names.begin(), option.short_names.end());
  }
  return names;
}

/// Cases of the word before the one that is completed: options with a list of values.
std::string value_cases(const VerbDescription& verb) {
  std::string out;
  for (const OptionDescription& option : verb.options)
    if (!option.choices.empty() && !option.long_names.empty())
      out += fmt::format("      {}:{}) words='{}' options='' ;;\n", verb.name, option.long_names.front(),
                         join(option.choices, " "));
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

/// "-o,--out VALUE" as roff; of a positional argument its name.
std::string heading(const OptionDescription& option) {
  Words names = option.short_names;
  names.insert(names.end(), option.long_names.begin(), option.long_names.end());
  if (names.empty()) return "\\fI" + escaped(option.name) + "\\fR";
  return "\\fB" + escaped(join(names)) + "\\fR" + (option.has_value ? " \\fIVALUE\\fR" : "");
}

std::string options_text(const VerbDescription& verb) {
  std::string out;
  for (const OptionDescription& option : verb.options)
    out += ".TP\n" + heading(option) + "\n" + escaped(option.help) +
           (option.default_value.empty() ? "" : escaped(" (default: " + option.default_value + ")")) + "\n";
  return out;
}

void add_script_verb(CommandLine& line, const std::string& name, const std::string& what) {
  Verb verb = line.add_verb(
      name,
      fmt::format("{0}; the script ./scanbench in the folder of the sources does it: ./scanbench {1}", what, name));
  verb.ignore_other_arguments();
  verb.runs([name]() -> int {
    throw ConfigError(name + " is done by the script ./scanbench in the folder of the sources: ./scanbench " + name);
  });
}

}  // namespace

std::string bash_completion(const ProgramDescription& text) {
  Words verbs;
  std::string cases;
  std::string values;
  for (const VerbDescription& verb : text.verbs) {
    verbs.push_back(verb.name);
    Words words;
    for (const OptionDescription& option : verb.options)
      if (option.words) words = option.words();
    cases +=
        fmt::format("    {}) words='{}' options='{}' ;;\n", verb.name, join(words, " "), join(option_names(verb), " "));
    values += value_cases(verb);
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
                     join(verbs, " "), join(option_names(text.program), " "), cases, values);
}

std::string manual_page(const ProgramDescription& text) {
  std::string out = ".TH SCANBENCH 1\n.SH NAME\nscanbench \\- a testbench for algorithms on 2D laser scans\n";
  out += ".SH SYNOPSIS\n.B scanbench\n.I verb\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n" + escaped(text.program.help) +
         "\n.SH OPTIONS\n" + options_text(text.program) + ".SH VERBS\n";
  for (const VerbDescription& verb : text.verbs)
    out += ".SS " + escaped(verb.name) + "\n" + escaped(verb.help) + ".\n" + options_text(verb);
  return out + ".SH NOTES\n" + escaped(text.footer) + "\n";
}

void add_shell_help(CommandLine& line) {
  Verb completion =
      line.add_verb("completion", "Prints a script that completes the command line: source <(scanbench completion)");
  completion.runs([&line] {
    fmt::print("{}", bash_completion(line.description()));
    return kGood;
  });
  Verb manual = line.add_verb("manual", "Prints the manual page: scanbench manual | man -l -");
  manual.runs([&line] {
    fmt::print("{}", manual_page(line.description()));
    return kGood;
  });
  add_script_verb(line, "build", "Builds the program");
  add_script_verb(line, "test", "Builds and runs the tests");
}

}  // namespace scanbench::app
