// sweep unpack: writes the files of cells that a merged run keeps in archives.
#include "app/verbs/unpack.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/inputs.hpp"
#include "app/terminal/progress.hpp"
#include "core/error.hpp"
#include "harness/runs/store/archived_run.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_lock.hpp"
#include "harness/runs/store/run_store.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

/// "room/iepf/7".
runs::CellKey cell_from(const std::string& text) {
  const std::size_t second = text.rfind('/'), first = text.find('/');
  const char* end = text.data() + text.size();
  runs::CellKey key;
  const char* seed = second == std::string::npos ? end : text.data() + second + 1;
  const auto [stop, error] = std::from_chars(seed, end, key.seed);
  if (first == second || seed == end || error != std::errc() || stop != end)
    throw ConfigError("'" + text + "' names no cell; allowed: SCENARIO/PIPELINE/SEED");
  key.scenario = text.substr(0, first);
  key.pipeline = text.substr(first + 1, second - first - 1);
  return key;
}

int unpack(const fs::path& run, const std::vector<std::string>& names, bool quiet) {
  check_run_exists(run);
  std::vector<runs::CellKey> cells;
  for (const auto& name : names) cells.push_back(cell_from(name));
  if (names.empty()) cells = runs::RunStore(run).keys();
  const runs::RunLock lock(run);
  runs::refuse_linked_folders(run);
  const InterruptGuard guard;
  Progress progress(progress_style(quiet));
  const std::size_t written = runs::unpack_cells(run, cells, [&](double share) { progress.update(share, "unpack"); });
  progress.finish();
  if (!quiet) fmt::print("{} unpacked: {}\n", counted(written, "cell"), (run / "cells").string());
  return kGood;
}

struct UnpackOptions {
  std::string run;
  std::vector<std::string> cells;
  bool quiet = false;
};

}  // namespace

void add_unpack(Verb& sweep) {
  auto options = std::make_shared<UnpackOptions>();
  Verb verb =
      sweep.add_verb("unpack", "Writes the files of cells that a merged run keeps in archives (docs/cluster.md)");
  verb.option("RUN", options->run, "a run folder").required();
  verb.option("CELL", options->cells,
              "SCENARIO/PIPELINE/SEED: only these; without any all, and the archives are removed");
  verb.flag("-q,--quiet", options->quiet, "print only errors");
  verb.runs([options] { return unpack(options->run, options->cells, options->quiet); });
}

}  // namespace scanbench::app
