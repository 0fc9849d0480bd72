// The verb compare, which judges one run against another.
#include "app/verbs/compare.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/inputs.hpp"
#include "app/terminal/progress.hpp"
#include "app/text_format.hpp"
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

namespace fs = std::filesystem;

struct CompareOptions {
  std::string before, after;
  std::vector<std::string> out;
  TextFormat format;
  bool all = false;
};

/// Two runs and what they differ in.
struct Compared {
  results::RunResults before, after;
  results::Gates gates;
  results::Comparison comparison;
};

/// "markdown" of a file that ends in .md. Throws ConfigError for other endings, and if the folder is not there.
std::string format_of_file(const fs::path& file) {
  if (!file.parent_path().empty() && !fs::is_directory(file.parent_path()))
    throw ConfigError(fmt::format("--out {}: there is no folder {}", file.string(), file.parent_path().string()));
  const std::string ending = file.extension().string();
  if (ending == ".md") return "markdown";
  if (ending == ".xml") return "junit";
  if (ending == ".json" || ending == ".csv") return ending.substr(1);
  throw ConfigError(
      fmt::format("--out {}: the ending of the name chooses the format; allowed: .csv, .json, .md, "
                  ".xml (JUnit)",
                  file.string()));
}

std::string text_of(const Compared& compared, const std::string& format) {
  if (format == "json") return results::comparison_json(compared.comparison);
  if (format == "csv") return results::value_pairs_csv(compared.before, compared.after, compared.gates);
  if (format == "junit") return results::comparison_junit(compared.comparison);
  return results::to_markdown(results::comparison_document(compared.comparison));
}

int compare(const CompareOptions& options) {
  const std::string printed = format_of(options.format);
  for (const std::string& file : options.out) format_of_file(file);  // before anything is compared
  check_run_exists(options.before);
  check_run_exists(options.after);
  Compared runs{.before = results::load_run_results(options.before),
                .after = results::load_run_results(options.after),
                .gates = results::Gates(runs::load_gates(options.after)),
                .comparison = {}};
  runs.comparison = results::compare(runs.before, runs.after, runs.gates);
  for (const std::string& file : options.out) io::write_file_atomically(file, text_of(runs, format_of_file(file)));
  if (printed == "text")
    fmt::print("{}", results::to_terminal(results::comparison_document(runs.comparison, options.all), use_color(),
                                          terminal_width()));
  else
    fmt::print("{}", text_of(runs, printed));
  return runs.comparison.exit_code();
}

}  // namespace

void add_compare(CommandLine& line) {
  auto options = std::make_shared<CompareOptions>();
  Verb verb = line.add_verb("compare", "Judges run B against run A, pipeline by pipeline over their seeds");
  verb.details(
      "The exit code is 1 if a gate is worse or a cell failed, 2 if nothing could be compared, 4 if cells are missing, "
      "5 "
      "if both 1 and 4.");
  verb.option("A", options->before, "the run folder to compare with").required();
  verb.option("B", options->after, "the run folder that is judged; its suite's gates hold").required();
  add_format_options(verb, options->format, {"text", "markdown", "json", "csv", "junit"}, "the comparison");
  verb.option(
          "-o,--out", options->out,
          "also write it to this file: .md for a pull request, .json, .xml (JUnit) for a CI server, .csv with every "
          "value of both runs; may be repeated")
      .one_value_each();
  for (const auto& [option, ending] : {std::pair{"--csv", "csv"}, {"--markdown", "md"}, {"--junit", "xml"}})
    verb.renamed(option, fmt::format("`compare {} FILE` is now `compare --out FILE.{}`", option, ending));
  verb.flag("--all", options->all, "also show what is unchanged");
  verb.runs([options] { return compare(*options); });
}

}  // namespace scanbench::app
