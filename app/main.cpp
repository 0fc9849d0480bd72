// The command line of scanbench, and the only place where exceptions become exit codes.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "app/authoring/conform.hpp"
#include "app/authoring/new_module.hpp"
#include "app/compare.hpp"
#include "app/figures.hpp"
#include "app/film.hpp"
#include "app/inspection.hpp"
#include "app/nightly.hpp"
#include "app/progress.hpp"
#include "app/recordings.hpp"
#include "app/results.hpp"
#include "app/run.hpp"
#include "app/shell_help.hpp"
#include "app/show.hpp"
#include "app/sweep.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/page/plain_text.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_folder.hpp"

namespace {

using namespace scanbench;

// The message about the first option that its verb does not have, with the nearest one that it has; empty if there is
// none.
std::string unknown_option(const CLI::App& app, int argc, char** argv) {
  const auto chosen = app.get_subcommands();
  const CLI::App& verb = chosen.empty() ? app : *chosen.front();
  std::vector<std::string> known;
  for (const CLI::Option* option : verb.get_options()) {
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
    for (const auto& name : option->get_snames()) known.push_back("-" + name);
  }
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string name = word.substr(0, word.find('='));
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

// CLI11's message for `scanbench rnu` is only that a subcommand is required; this one names the verbs.
std::string parse_message(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    if (const std::string option = unknown_option(app, argc, argv); !option.empty()) return option;
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    // A misspelt option that is required is both unknown and missing: the name that is wrong helps more.
    if (const std::string option = unknown_option(app, argc, argv); !option.empty()) return option;
    if (const std::string argument = missing_argument(app); !argument.empty()) return argument;
  }
  const std::string first = argc > 1 ? argv[1] : "";
  if (dynamic_cast<const CLI::RequiredError*>(&error) == nullptr || !app.get_subcommands().empty() ||
      (!first.empty() && first.front() == '-'))
    return error.what();
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    verbs.push_back(verb->get_name());
  return (argc > 1 ? "there is no verb '" + first + "'" : "a verb is missing") + known_names(first, verbs);
}

int run_program(int argc, char** argv) {
  CLI::App app{
      "A testbench for algorithms on 2D laser scans: simulates or replays scans, runs the algorithms, compares them "
      "with the truth."};
  app.name("scanbench");
  app.set_version_flag("--version", harness::version_text());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 good, 1 a gate failed, 2 bad input, 3 some cells failed, 4 incomplete, 5 both 1 and 4, 70 a bug "
      "of the program, 130 "
      "interrupted.");
  app.get_formatter()->column_width(34);

  app::Action action;
  app::Context context{app, action, {argv, argv + argc}, argv[0]};
  app::add_run(context);
  app::add_sweep(context);
  app::add_inspection(context);
  app::add_recordings(context);
  app::add_results(context);
  app::add_figures(context);
  app::add_film(context);
  app::add_compare(context);
  app::add_nightly(context);
  app::add_new_module(context);
  app::add_conform(context);
  app::add_shell_help(context);
  app::add_show(context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    app::say(fmt::format("scanbench: {}\n(scanbench --help shows the verbs, scanbench VERB --help its options)\n",
                         harness::plain_text(parse_message(app, error, argc, argv))));
    return app::kBadInput;
  }
  const int code = action();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw ConfigError("cannot write to standard output");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  app::open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is then an error of write(), with a message
  try {
    return run_program(argc, argv);
  } catch (const ConfigError& error) {
    app::say(fmt::format("scanbench: {}\n", harness::plain_text(error.what())));
    return app::kBadInput;
  } catch (const app::Interrupted&) {
    app::say("\nscanbench: interrupted\n");
    return app::kInterrupted;
  } catch (const std::filesystem::filesystem_error& error) {
    app::say(fmt::format("scanbench: {}: {}\n", harness::plain_text(error.path1().string()), error.code().message()));
    return app::kBadInput;
  } catch (const std::system_error& error) {  // standard output or a folder cannot be used
    app::say(fmt::format("scanbench: {}\n", harness::plain_text(error.what())));
    return app::kBadInput;
  } catch (const std::bad_alloc&) {
    app::say("scanbench: out of memory\n");
    return app::kBadInput;
  } catch (const std::exception& error) {
    app::say(fmt::format("scanbench: internal error, please report it: {}\n", harness::plain_text(error.what())));
    return app::kOurBug;
  }
}
