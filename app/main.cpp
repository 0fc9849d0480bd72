// scanbench: the command line, and the one place where exceptions become exit codes.
#include <fmt/format.h>

#include <new>

#include "app/commands.hpp"
#include "core/error.hpp"
#include "harness/run_folder.hpp"

namespace {

using namespace scanbench;

int run_program(int argc, char** argv) {
  CLI::App app{
      "A testbench for algorithms on 2D laser scans: simulates or replays scans, runs the algorithms, compares them "
      "with the truth."};
  app.name("scanbench");
  app.set_version_flag("--version", harness::version_text());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 good, 1 a gate failed, 2 bad input, 3 some cells failed, 4 incomplete, 70 a bug of ours, 130 "
      "interrupted.");
  app.get_formatter()->column_width(34);

  app::Action action;
  app::Context context{app, action, {argv, argv + argc}, argv[0]};
  app::add_run(context);
  app::add_inspection(context);
  app::add_recordings(context);
  app::add_results(context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    fmt::print(stderr, "scanbench: {}\n(scanbench --help shows the verbs, scanbench VERB --help its options)\n",
               error.what());
    return app::kBadInput;
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const ConfigError& error) {
    fmt::print(stderr, "scanbench: {}\n", error.what());
    return app::kBadInput;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "scanbench: out of memory\n");
    return app::kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "scanbench: internal error, please report it: {}\n", error.what());
    return app::kOurBug;
  }
}
