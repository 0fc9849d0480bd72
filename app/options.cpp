// Declares, reads and checks options with CLI11, which costs eight seconds of compile time in each unit that uses it.
#include "app/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <deque>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "core/names.hpp"

namespace scanbench::app {

struct OptionState {
  CLI::Option* option;
  CLI::App* verb;
  Words choices = {};
  std::function<Words()> words = {};
};

struct VerbState {
  CLI::App* app;
  CommandLineState* line;
};

struct CommandLineState {
  explicit CommandLineState(const std::string& about) : app(about) {}

  CLI::App app;
  Words argv;
  std::function<int()> action;
  std::deque<VerbState> verbs;      // a deque, because Verb and Option keep addresses of elements
  std::deque<OptionState> options;  // those with a value
};

namespace {

Words long_option_names(const CLI::Option& option) {
  Words names;
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

Words short_option_names(const CLI::Option& option) {
  Words names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// The message about the first option that its verb does not have, with the nearest one that it has; empty if there is
/// none.
std::string unknown_option(const CLI::App& app, const Words& argv) {
  const auto chosen = app.get_subcommands();
  const CLI::App& verb = chosen.empty() ? app : *chosen.front();
  Words known;
  for (const CLI::Option* option : verb.get_options())
    for (const auto& names : {long_option_names(*option), short_option_names(*option)})
      known.insert(known.end(), names.begin(), names.end());
  for (std::size_t i = 1; i < argv.size(); ++i) {
    const std::string name = argv[i].substr(0, argv[i].find('='));
    if (!name.starts_with("--") || name == "--" || std::ranges::count(known, name) > 0) continue;
    return (chosen.empty() ? std::string("there") : "'" + verb.get_name() + "'") +
           (chosen.empty() ? " is no option '" : " has no option '") + name + "'" + known_names(name, known);
  }
  return "";
}

/// "'check' needs FILE: scenario or suite files" for the first argument that the chosen verb lacks; empty if none.
std::string missing_argument(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) return "";
  for (const CLI::Option* option : chosen.back()->get_options())
    if (option->get_required() && option->count() == 0)
      return "'" + chosen.back()->get_name() + "' needs " + option->get_name() + ": " + option->get_description();
  return "";
}

/// CLI11's message for `scanbench rnu` is only that a subcommand is required; this one names the verbs.
std::string parse_message(const CLI::App& app, const CLI::ParseError& error, const Words& argv) {
  const bool is_required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  if (is_required || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    // A misspelt option that is required is both unknown and missing: the name that is wrong helps more.
    if (const std::string option = unknown_option(app, argv); !option.empty()) return option;
  }
  if (is_required)
    if (const std::string argument = missing_argument(app); !argument.empty()) return argument;
  const std::string first = argv.size() > 1 ? argv[1] : "";
  if (!is_required || !app.get_subcommands().empty() || first.starts_with('-')) return error.what();
  Words names;
  for (const CLI::App* verb : verbs_of(app)) names.push_back(verb->get_name());
  return (argv.size() > 1 ? "there is no verb '" + first + "'" : "a verb is missing") + known_names(first, names);
}

/// Refuses what is no number of the type from `low` to `high`.
template <class Number>
CLI::Validator bounded(const std::string& what, const std::string& kind, Number low, Number high) {
  const std::string bounds = fmt::format("{} .. {}", low, high);
  return {[=](std::string& text) {
            Number value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error == std::errc() && stop == end && low <= value && value <= high) return std::string();
            return fmt::format("'{}' is no {}; allowed: {}{}", text, what, kind, bounds);
          },
          bounds};
}

OptionDescription described(const CLI::Option& option, const std::deque<OptionState>& states) {
  OptionDescription text{.short_names = short_option_names(option),
                         .long_names = long_option_names(option),
                         .name = option.get_name(),
                         .help = option.get_description(),
                         .default_value = option.get_default_str(),
                         .has_value = option.get_items_expected_max() > 0,
                         .choices = {},
                         .words = {}};
  const auto state = std::ranges::find(states, &option, &OptionState::option);
  if (state != states.end()) {
    text.choices = state->choices;
    text.words = state->words;
  }
  return text;
}

VerbDescription described(const CLI::App& verb, const std::deque<OptionState>& states) {
  VerbDescription text{verb.get_name(), verb.get_description(), {}};
  for (const CLI::Option* option : verb.get_options()) text.options.push_back(described(*option, states));
  return text;
}

Option added(const VerbState& verb, CLI::Option* option) {
  return Option(verb.line->options.emplace_back(OptionState{option, verb.app}));
}

}  // namespace

Option Option::required() {
  state_->option->required();
  return *this;
}

Option Option::shows_default() {
  state_->option->capture_default_str();
  return *this;
}

Option Option::separated_by_commas() {
  state_->option->delimiter(',');
  return *this;
}

Option Option::repeatable() {
  state_->option->take_all();
  return *this;
}

Option Option::one_value_each() {
  state_->option->allow_extra_args(false)->take_all();
  return *this;
}

Option Option::values(int least, int most) {
  state_->option->expected(least, most);
  return *this;
}

Option Option::whole_number(const std::string& what, int low, int high) {
  state_->option->check(bounded(what, "a whole number ", low, high));
  return *this;
}

Option Option::number(const std::string& what, double low, double high) {
  state_->option->check(bounded(what, "", low, high));
  return *this;
}

Option Option::one_of(const std::string& what, const Words& words) {
  state_->choices = words;
  const auto check = [=](const std::string& text) {
    if (std::ranges::find(words, text) != words.end()) return std::string();
    const std::string near = nearest_name(text, words);
    return fmt::format("'{}' is no {}{}; allowed: {}", text, what, near.empty() ? "" : "; did you mean '" + near + "'?",
                       fmt::join(words, ", "));
  };
  state_->option->check(check, fmt::format("{{{}}}", fmt::join(words, ",")));
  return *this;
}

Option Option::excludes_all_but(const Words& names) {
  for (CLI::Option* other : state_->verb->get_options()) {
    const auto& own = other->get_lnames();
    const bool is_allowed = !own.empty() && std::ranges::count(names, own.front()) > 0;
    if (other != state_->option && other != state_->verb->get_help_ptr() && !is_allowed)
      state_->option->excludes(other);
  }
  return *this;
}

Option Option::completed_by(std::function<Words()> words) {
  state_->words = std::move(words);
  return *this;
}

bool Option::given() const {
  return state_->option->count() > 0;
}

Option Verb::option(const std::string& names, std::string& value, const std::string& help) {
  return added(*state_, state_->app->add_option(names, value, help));
}

Option Verb::option(const std::string& names, std::filesystem::path& value, const std::string& help) {
  return added(*state_, state_->app->add_option(names, value, help));
}

Option Verb::option(const std::string& names, std::vector<std::string>& values, const std::string& help) {
  return added(*state_, state_->app->add_option(names, values, help));
}

Option Verb::option(const std::string& names, int& value, const std::string& help) {
  return added(*state_, state_->app->add_option(names, value, help));
}

Option Verb::option(const std::string& names, double& value, const std::string& help) {
  return added(*state_, state_->app->add_option(names, value, help));
}

Option Verb::option(const std::string& names, std::size_t& value, const std::string& help) {
  return added(*state_, state_->app->add_option(names, value, help));
}

Option Verb::option(const std::string& names, std::optional<std::uint16_t>& value, const std::string& help) {
  return added(*state_, state_->app->add_option(names, value, help));
}

Option Verb::option(const std::string& names, std::optional<std::uint64_t>& value, const std::string& help) {
  return added(*state_, state_->app->add_option(names, value, help));
}

Option Verb::option(const std::string& names, const std::string& help) {
  return added(*state_, state_->app->add_option(names, help));
}

void Verb::flag(const std::string& names, bool& value, const std::string& help) {
  state_->app->add_flag(names, value, help);
}

void Verb::ignore_other_arguments() {
  state_->app->allow_extras();
}

void Verb::runs(std::function<int()> action) {
  state_->app->callback([line = state_->line, action = std::move(action)] { line->action = action; });
}

CommandLine::CommandLine(int argc, char** argv, const std::string& name, const std::string& about,
                         const std::string& footer, const std::string& version)
    : state_(std::make_unique<CommandLineState>(about)) {
  state_->argv.assign(argv, argv + argc);
  CLI::App& app = state_->app;
  app.name(name);
  app.set_version_flag("--version", version);
  app.require_subcommand(1);
  app.footer(footer);
  app.get_formatter()->column_width(34);
}

CommandLine::~CommandLine() = default;

Verb CommandLine::add_verb(const std::string& name, const std::string& help) {
  return Verb(state_->verbs.emplace_back(VerbState{state_->app.add_subcommand(name, help), state_.get()}));
}

std::function<int()> CommandLine::parse() {
  CLI::App& app = state_->app;
  try {
    Words reversed(state_->argv.rbegin(), state_->argv.rend());
    if (!reversed.empty()) reversed.pop_back();  // the program's name
    app.parse(std::move(reversed));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0)
      throw ConfigError(parse_message(app, error, state_->argv) +
                        "\n(scanbench --help shows the verbs, scanbench VERB --help its options)");
    app.exit(error);  // prints the help or the version
    return {};
  }
  return state_->action;
}

const Words& CommandLine::argv() const {
  return state_->argv;
}

ProgramDescription CommandLine::description() const {
  ProgramDescription text{described(state_->app, state_->options), state_->app.get_footer(), {}};
  for (const CLI::App* verb : verbs_of(state_->app)) text.verbs.push_back(described(*verb, state_->options));
  return text;
}

}  // namespace scanbench::app
