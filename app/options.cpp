// Declares, reads and checks options with CLI11, which costs eight seconds of compile time in each unit that uses it.
#include "app/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <deque>
#include <map>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include "app/parse_fault.hpp"
#include "core/error.hpp"
#include "core/names.hpp"

namespace scanbench::app {

struct OptionState {
  CLI::Option* option;
  Words choices = {};
  std::function<Words()> words = {};
};

struct VerbState {
  CLI::App* app;
  CommandLineState* line;
  std::string details = {};
  std::map<std::string, std::string> renamed = {};  // options of earlier versions, and what is said of each
};

struct CommandLineState {
  explicit CommandLineState(const std::string& about) : app(about) {}

  CLI::App app;
  Words argv;
  std::function<int()> action;
  std::string drawer;
  std::map<std::string, std::string> renamed;  // verbs of earlier versions, and their names now
  std::deque<VerbState> verbs;                 // a deque, because Verb and Option keep addresses of elements
  std::deque<OptionState> options;             // those with a value
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

/// "a format", "an option".
std::string with_article(const std::string& what) {
  return (std::string_view("aeiou").find(what.front()) == std::string_view::npos ? "a " : "an ") + what;
}

/// Refuses what is not a number of the type from `low` to `high`.
template <class Number>
CLI::Validator bounded(const std::string& what, const std::string& kind, Number low, Number high) {
  const std::string bounds = fmt::format("{} .. {}", low, high);
  return {[=](std::string& text) {
            Number value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error == std::errc() && stop == end && low <= value && value <= high) return std::string();
            return fmt::format("'{}' is not {}; allowed: {}{}", text, with_article(what), kind, bounds);
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

VerbDescription described(const CLI::App& verb, const CommandLineState& line, const std::string& before) {
  const auto state = std::ranges::find(line.verbs, &verb, &VerbState::app);
  VerbDescription text{.name = verb.get_name(),
                       .path = before + verb.get_name(),
                       .help = verb.get_description(),
                       .details = state == line.verbs.end() ? "" : state->details,
                       .options = {},
                       .verbs = {}};
  for (const CLI::Option* option : verb.get_options()) text.options.push_back(described(*option, line.options));
  for (const CLI::App* each : verbs_of(verb)) text.verbs.push_back(described(*each, line, text.path + " "));
  return text;
}

/// Why the arguments were refused, for message_of().
ParseFault fault_of(const CommandLineState& line, const CLI::ParseError& error) {
  const CLI::App* app = &line.app;
  std::string before;
  for (auto chosen = app->get_subcommands(); !chosen.empty(); chosen = app->get_subcommands()) {
    if (app != &line.app) before += app->get_name() + " ";
    app = chosen.front();
  }
  ParseFault fault{
      .argv = line.argv, .verb = described(*app, line, before), .renamed = {}, .missing = {}, .extras = {}};
  if (app == &line.app) fault.verb.path.clear();
  const auto state = std::ranges::find(line.verbs, app, &VerbState::app);
  if (state != line.verbs.end()) fault.renamed = state->renamed;
  fault.is_required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) fault.extras = line.app.remaining(true);
  for (const CLI::Option* option : app->get_options())
    if (option->get_required() && option->count() == 0)
      fault.missing.push_back(option->get_name() + ": " + option->get_description());
  return fault;
}

/// A former name is answered with one sentence, which has all that the user needs.
std::string refusal_text(const CommandLineState& line, const CLI::ParseError& error) {
  const ParseFault fault = fault_of(line, error);
  if (const std::string now = renamed_option(fault); !now.empty()) return now;
  const std::string text = message_of(fault);
  return (text.empty() ? error.what() : text) +
         "\n(scanbench --help shows the verbs, scanbench VERB --help its options)";
}

Option added(const VerbState& verb, CLI::Option* option) {
  return Option(verb.line->options.emplace_back(OptionState{option}));
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
    return fmt::format("'{}' is not {}{}; allowed: {}", text, with_article(what),
                       near.empty() ? "" : "; did you mean '" + near + "'?", fmt::join(words, ", "));
  };
  state_->option->check(check, fmt::format("{{{}}}", fmt::join(words, ",")));
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

Verb Verb::add_verb(const std::string& name, const std::string& help) {
  state_->app->require_subcommand(1);
  CLI::App* verb = state_->app->add_subcommand(name, help);
  verb->group("Verbs");  // else it is in the drawer of this one
  return Verb(state_->line->verbs.emplace_back(VerbState{verb, state_->line}));
}

void Verb::details(const std::string& text) {
  state_->details = text;
  state_->app->footer(text + "\n\n" + state_->line->app.get_footer());
}

void Verb::renamed(const std::string& option, const std::string& sentence) {
  state_->renamed[option] = sentence;
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
  app.get_formatter()->label("SUBCOMMAND", "VERB");
}

CommandLine::~CommandLine() = default;

void CommandLine::drawer(const std::string& name) {
  state_->drawer = name;
}

Verb CommandLine::add_verb(const std::string& name, const std::string& help) {
  CLI::App* verb = state_->app.add_subcommand(name, help);
  if (!state_->drawer.empty()) verb->group(state_->drawer);
  return Verb(state_->verbs.emplace_back(VerbState{verb, state_.get()}));
}

void CommandLine::renamed(const std::string& verb, const std::string& now) {
  state_->renamed[verb] = now;
}

std::function<int()> CommandLine::parse() {
  CLI::App& app = state_->app;
  if (state_->argv.size() > 1)
    if (const auto now = state_->renamed.find(state_->argv[1]); now != state_->renamed.end())
      throw ConfigError("`" + now->first + "` is now `" + now->second + "`");
  try {
    Words reversed(state_->argv.rbegin(), state_->argv.rend());
    if (!reversed.empty()) reversed.pop_back();  // the program's name
    app.parse(std::move(reversed));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw ConfigError(refusal_text(*state_, error));
    app.exit(error);  // prints the help or the version
    return {};
  }
  return state_->action;
}

const Words& CommandLine::argv() const {
  return state_->argv;
}

ProgramDescription CommandLine::description() const {
  ProgramDescription text{described(state_->app, *state_, ""), state_->app.get_footer(), {}};
  text.program.verbs.clear();
  for (const CLI::App* verb : verbs_of(state_->app)) text.verbs.push_back(described(*verb, *state_, ""));
  return text;
}

}  // namespace scanbench::app
