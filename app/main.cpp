// The command line of scanbench, and the only place where exceptions become exit codes.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <new>
#include <system_error>

#include "app/drawers.hpp"
#include "app/options.hpp"
#include "app/terminal/progress.hpp"
#include "core/error.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/runs/store/manifest.hpp"

namespace {

using namespace scanbench;

int run_program(int argc, char** argv) {
  app::CommandLine line(
      argc, argv, "scanbench",
      "A testbench for algorithms on 2D laser scans: simulates or replays scans, runs the algorithms, compares them "
      "with the truth.",
      "Exit codes: 0 good, 1 a gate failed, 2 bad input, 3 some cells failed, 4 incomplete, 5 both 1 and 4, 70 a bug "
      "of the program, 130 "
      "interrupted.",
      runs::version_text());
  app::add_drawers(line);
  const std::function<int()> action = line.parse();
  if (!action) return app::kGood;  // --help, --version
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
    app::say(fmt::format("scanbench: {}\n", results::plain_text(error.what())));
    return app::kBadInput;
  } catch (const app::Interrupted&) {
    app::say("\nscanbench: interrupted\n");
    return app::kInterrupted;
  } catch (const std::filesystem::filesystem_error& error) {
    app::say(fmt::format("scanbench: {}: {}\n", results::plain_text(error.path1().string()), error.code().message()));
    return app::kBadInput;
  } catch (const std::system_error& error) {  // standard output or a folder cannot be used
    app::say(fmt::format("scanbench: {}\n", results::plain_text(error.what())));
    return app::kBadInput;
  } catch (const std::bad_alloc&) {
    app::say("scanbench: out of memory\n");
    return app::kBadInput;
  } catch (const std::exception& error) {
    app::say(fmt::format("scanbench: internal error, please report it: {}\n", results::plain_text(error.what())));
    return app::kOurBug;
  }
}
