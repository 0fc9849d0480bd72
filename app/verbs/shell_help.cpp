// Writes the manual page from the description of the command line.
#include "app/verbs/shell_help.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>

#include "app/verbs/completion.hpp"
#include "core/error.hpp"
#include "core/names.hpp"

namespace scanbench::app {
namespace {

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

/// The section of a verb and of those below it.
std::string verb_text(const VerbDescription& verb) {
  std::string out = ".SS " + escaped(verb.path) + "\n" + escaped(verb.help) + ".\n";
  if (!verb.details.empty()) out += ".PP\n" + escaped(verb.details) + "\n";
  if (verb.verbs.empty()) out += options_text(verb);
  for (const VerbDescription& each : verb.verbs) out += verb_text(each);
  return out;
}

void add_script_verb(CommandLine& line, const std::string& name, const std::string& what) {
  Verb verb = line.add_verb(name, fmt::format("{}, from the folder of the sources: ./scanbench {}", what, name));
  verb.ignore_other_arguments();
  verb.runs([name]() -> int {
    throw ConfigError(name + " is done by the script ./scanbench in the folder of the sources: ./scanbench " + name);
  });
}

}  // namespace

std::string manual_page(const ProgramDescription& text) {
  std::string out = ".TH SCANBENCH 1\n.SH NAME\nscanbench \\- a testbench for algorithms on 2D laser scans\n";
  out += ".SH SYNOPSIS\n.B scanbench\n.I verb\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n" + escaped(text.program.help) +
         "\n.SH OPTIONS\n" + options_text(text.program) + ".SH VERBS\n";
  for (const VerbDescription& verb : text.verbs) out += verb_text(verb);
  return out + ".SH NOTES\n" + escaped(text.footer) + "\n";
}

void add_shell_help(CommandLine& line) {
  auto shell = std::make_shared<std::string>("bash");
  Verb completion = line.add_verb("completion", "Prints a script that completes the command line in a shell");
  completion.details(
      "In bash and zsh: source <(scanbench completion SHELL). In fish: scanbench completion fish | source");
  completion.option("SHELL", *shell, "bash, zsh or fish").one_of("shell", {"bash", "zsh", "fish"}).shows_default();
  completion.runs([&line, shell] {
    fmt::print("{}", completion_script(line.description(), *shell));
    return kGood;
  });
  Verb manual = line.add_verb("manual", "Prints the manual page: scanbench manual | man -l -");
  manual.runs([&line] {
    fmt::print("{}", manual_page(line.description()));
    return kGood;
  });
  add_script_verb(line, "build", "Builds the program");
  add_script_verb(line, "test", "Builds and runs the tests");
  add_script_verb(line, "peers", "Builds modules of other libraries");
}

}  // namespace scanbench::app
