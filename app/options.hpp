// The command line: verbs with their options, whose values are checked with messages that say what was found and what
// is allowed. A verb adds itself to the command line and returns an exit code. CLI11 is included by the source file
// alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/exit_code.hpp"
#include "app/verb_description.hpp"

namespace scanbench::app {

struct OptionState;
struct VerbState;
struct CommandLineState;

/// An option or a positional argument of a verb. Copies refer to the same option, which the CommandLine owns.
class Option {
 public:
  explicit Option(OptionState& state) : state_(&state) {}

  Option required();
  /// The help shows the value that the variable has now.
  Option shows_default();
  /// One argument can hold several values, separated by commas.
  Option separated_by_commas();
  /// Each occurrence adds its values to those of the others.
  Option repeatable();
  /// Each occurrence has one value and adds it to those of the others.
  Option one_value_each();
  /// All occurrences together have from `least` to `most` values.
  Option values(int least, int most);
  /// Refuses what is not a whole number from `low` to `high`: "'0' is not a number of threads; allowed: a whole number
  /// 1 .. 9".
  Option whole_number(const std::string& what, int low, int high);
  /// Refuses what is not a number from `low` to `high`: "'9e9' is not a resolution in dpi; allowed: 36 .. 1200".
  Option number(const std::string& what, double low, double high);
  /// Refuses what is none of these words: "'xml' is not a format; allowed: carmen, csv". A shell completes them.
  Option one_of(const std::string& what, const Words& words);
  /// What a positional argument that is not a file can be; for completion on the command line.
  Option completed_by(std::function<Words()> words);
  /// True if the command line that was read has the option.
  bool given() const;

 private:
  OptionState* state_;
};

/// A verb of the program. Copies refer to the same verb, which the CommandLine owns. Variables must live until the verb
/// has run: the action should own them.
class Verb {
 public:
  explicit Verb(VerbState& state) : state_(&state) {}

  /// Adds an option ("-o,--out") or a positional argument ("RUN") that sets the variable.
  Option option(const std::string& names, std::string& value, const std::string& help);
  Option option(const std::string& names, std::filesystem::path& value, const std::string& help);
  Option option(const std::string& names, std::vector<std::string>& values, const std::string& help);
  Option option(const std::string& names, int& value, const std::string& help);
  Option option(const std::string& names, double& value, const std::string& help);
  Option option(const std::string& names, std::size_t& value, const std::string& help);
  Option option(const std::string& names, std::optional<std::uint16_t>& value, const std::string& help);
  Option option(const std::string& names, std::optional<std::uint64_t>& value, const std::string& help);
  /// One that is checked only.
  Option option(const std::string& names, const std::string& help);
  /// Adds an option without a value.
  void flag(const std::string& names, bool& value, const std::string& help);

  /// A verb of this one, like `plan` of `sweep`. A verb that has verbs has neither options nor an action.
  Verb add_verb(const std::string& name, const std::string& help);
  /// What the help of the verb says below its options.
  void details(const std::string& text);
  /// An option of earlier versions, which is refused with this sentence.
  void renamed(const std::string& option, const std::string& sentence);
  /// Accepts any other arguments.
  void ignore_other_arguments();
  /// What the program does if the user chooses this verb; returns the exit code.
  void runs(std::function<int()> action);

 private:
  VerbState* state_;
};

struct ProgramDescription {
  VerbDescription program;  ///< its own name, description and options
  std::string footer;
  std::vector<VerbDescription> verbs;
};

class CommandLine {
 public:
  /// `footer` ends every help text; --version prints `version`.
  CommandLine(int argc, char** argv, const std::string& name, const std::string& about, const std::string& footer,
              const std::string& version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Begins a drawer: a group of verbs in the help. The verbs that are added next are in it.
  void drawer(const std::string& name);
  Verb add_verb(const std::string& name, const std::string& help);
  /// A verb of earlier versions, which is refused: "`nightly` is now `night run`".
  void renamed(const std::string& verb, const std::string& now);

  /// Reads the arguments and returns the action of the verb that the user chose; none after --help and --version, which
  /// are printed. Throws ConfigError for arguments that no verb accepts.
  std::function<int()> parse();

  /// The arguments as they were given, the program's name first.
  const Words& argv() const;

  ProgramDescription description() const;

 private:
  std::unique_ptr<CommandLineState> state_;
};

}  // namespace scanbench::app
