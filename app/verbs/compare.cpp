// The verb compare, which judges one run against another.
#include "app/verbs/compare.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/inputs.hpp"
#include "app/terminal/progress.hpp"
#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/results/analysis/comparison.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/run_results.hpp"
#include "harness/results/analysis/value_pairs.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/nightly/comparison_files.hpp"
#include "harness/results/nightly/comparison_tables.hpp"
#include "harness/runs/store/run_scenarios.hpp"

namespace scanbench::app {
namespace {

struct CompareOptions {
  std::string before, after, csv, json, markdown, junit;
  bool all = false;
};

/// Before anything is compared: throws ConfigError if the folder of an output file is not there.
void check_folder(const std::string& option, const std::string& file) {
  const auto folder = std::filesystem::path(file).parent_path();
  if (!file.empty() && !folder.empty() && !std::filesystem::is_directory(folder))
    throw ConfigError(fmt::format("{}: {}: there is no folder {}", option, file, folder.string()));
}

int compare(const CompareOptions& options) {
  check_folder("--csv", options.csv);
  check_folder("--json", options.json);
  check_folder("--markdown", options.markdown);
  check_folder("--junit", options.junit);
  check_run_exists(options.before);
  check_run_exists(options.after);
  const results::RunResults before = results::load_run_results(options.before);
  const results::RunResults after = results::load_run_results(options.after);
  const results::Gates gates(runs::load_gates(options.after));
  const results::Comparison comparison = results::compare(before, after, gates);
  const auto write = [](const std::string& file, const std::string& bytes) {
    if (!file.empty()) io::write_file_atomically(file, bytes);
  };
  if (!options.csv.empty()) write(options.csv, results::value_pairs_csv(before, after, gates));
  if (!options.json.empty()) write(options.json, results::comparison_json(comparison));
  if (!options.markdown.empty())
    write(options.markdown, results::to_markdown(results::comparison_document(comparison)));
  if (!options.junit.empty()) write(options.junit, results::comparison_junit(comparison));
  fmt::print(
      "{}", results::to_terminal(results::comparison_document(comparison, options.all), use_color(), terminal_width()));
  return comparison.exit_code();
}

}  // namespace

void add_compare(CommandLine& line) {
  auto options = std::make_shared<CompareOptions>();
  Verb verb = line.add_verb("compare",
                            "Judges run B against run A, pipeline by pipeline over their seeds; exit "
                            "code 1 if a gate is worse or a cell failed, 2 if nothing could be compared, 4 if cells "
                            "are missing, 5 if both");
  verb.option("A", options->before, "the run folder to compare with").required();
  verb.option("B", options->after, "the run folder that is judged; its suite's gates hold").required();
  verb.option("--csv", options->csv, "write every value of both runs to this file");
  verb.option("--json", options->json, "write the comparison as JSON");
  verb.option("--markdown", options->markdown, "write it as Markdown, for a pull request");
  verb.option("--junit", options->junit, "write it as JUnit XML, for a CI server");
  verb.flag("--all", options->all, "also show what is unchanged");
  verb.runs([options] { return compare(*options); });
}

}  // namespace scanbench::app
