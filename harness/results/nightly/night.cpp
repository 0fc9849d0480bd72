// Stores, judges and shows a night.
#include "harness/results/nightly/night.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/json.hpp"
#include "harness/results/analysis/comparison.hpp"
#include "harness/results/analysis/run_results.hpp"
#include "harness/results/analysis/verdict.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/document/html_page.hpp"
#include "harness/results/figures/recording_note.hpp"
#include "harness/results/nightly/baseline.hpp"
#include "harness/results/nightly/comparison_files.hpp"
#include "harness/results/nightly/comparison_tables.hpp"
#include "harness/results/nightly/night_page.hpp"
#include "harness/results/nightly/night_pictures.hpp"
#include "harness/results/pages/run_report.hpp"
#include "harness/results/player/player_page.hpp"
#include "harness/runs/store/json_file.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_lock.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTrendNights = 30;
constexpr std::size_t kListedChanges = 40;  // with a trend
constexpr std::size_t kWorstScans = 10;     // of each pipeline

struct Reference {
  std::string text;
  RunResults results;
  bool is_baseline = false;
};

std::string text_of(const Baseline& baseline) {
  return fmt::format("baseline {} of {} ({})", baseline.file.stem().string(), baseline.accepted.substr(0, 10),
                     baseline.reason);
}

std::optional<fs::path> chosen_baseline(const NightPlan& plan) {
  const auto files = baseline_files(plan.baselines, plan.suite);
  if (plan.baseline.empty()) return files.empty() ? std::nullopt : std::optional(files.back());
  const auto number_of = [](const std::string& text) -> std::optional<unsigned long> {
    const bool is_number =
        !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? std::optional(std::stoul(text)) : std::nullopt;
  };
  for (const auto& file : files)
    if (const auto number = number_of(file.stem().string()); number && number == number_of(plan.baseline)) return file;
  std::string known;
  for (const auto& file : files) known += (known.empty() ? "" : ", ") + file.stem().string();
  throw ConfigError(fmt::format("{} has no baseline '{}' of {}; known: {}", plan.baselines.string(), plan.baseline,
                                plan.suite, known.empty() ? "none" : known));
}

/// Where the run folder of the last good night is kept.
fs::path last_good_folder(const fs::path& run) {
  const fs::path whole = fs::absolute(run).lexically_normal();
  return whole.parent_path() / (whole.filename().string() + ".last_good");
}

/// The results of an earlier night, with its folder if that is still there.
RunResults night_results(const Store& store, const Night& night, const fs::path& run) {
  RunResults results = store.load(night.id);
  for (const fs::path& kept : {last_good_folder(run), fs::path(night.folder)})
    if (results.folder.empty() && fs::exists(kept / runs::kManifestFile) &&
        runs::load_provenance(kept).start == night.start)
      results.folder = kept;
  return results;
}

/// The nights of the suite but those with overrides and those of this folder that began at `unfinished`.
std::vector<Night> earlier_nights(const NightPlan& plan, const Store& store,
                                  const std::vector<std::string>& unfinished) {
  std::vector<Night> nights = store.nights(plan.suite);
  std::erase_if(nights, [&](const Night& night) {
    if (!night.overrides.empty()) return true;
    return night.folder == folder_in_store(plan.run) && std::ranges::find(unfinished, night.start) != unfinished.end();
  });
  return nights;
}

std::optional<Reference> reference_of(const NightPlan& plan, const Store& store, const std::vector<Night>& nights) {
  if (const auto file = chosen_baseline(plan)) {
    const Baseline baseline = load_baseline(*file);
    return Reference{text_of(baseline), baseline.results, true};
  }
  for (std::size_t i = nights.size(); i-- > 0;) {
    const Night& night = nights[i];
    if (night.verdict != "PASS") continue;
    return Reference{"the last good night, " + night.start, night_results(store, night, plan.run), false};
  }
  return std::nullopt;
}

Comparison compare_with(const Reference& reference, const RunResults& now, const Gates& gates) {
  if (!reference.is_baseline) return compare(reference.results, now, gates);
  return compare(reference.results, gate_values(now, gates), gates);
}

/// Gates that became worse first, then what else the page lists.
std::vector<const MetricChange*> listed_changes(const Comparison& comparison) {
  std::vector<const MetricChange*> listed;
  for (const Finding finding : {Finding::worse, Finding::uncertain, Finding::better})
    for (const MetricChange* change : changes_with(comparison, finding))
      if (listed.size() < kListedChanges) listed.push_back(change);
  return listed;
}

/// Keeps a good night: cells and recordings as links to the same files, because nobody writes into a file that is
/// there.
void keep_good_night(const fs::path& run) {
  const fs::path kept = last_good_folder(run);
  io::StagedFolder staged(kept);
  const auto links = fs::copy_options::recursive | fs::copy_options::create_hard_links;
  for (const char* folder : {"cells", "recordings", "effective", "inputs", "figures"})
    if (fs::exists(run / folder)) fs::copy(run / folder, staged.path() / folder, links);
  for (const char* file : {"manifest.json", "artefacts.sha256", "effective.yaml", "summary.csv"})
    if (fs::exists(run / file)) fs::copy_file(run / file, staged.path() / file);
  staged.commit();
}

/// The scans that the page shows.
PlayedRecordings linked_scans(const NightInput& input) {
  PlayedRecordings recordings;
  for (const auto& pair : input.pictures.scans)
    if (pair.scan) recordings[{pair.scan->cell.scenario, pair.scan->cell.seed}].insert(pair.scan->frame);
  for (const auto& [pipeline, scans] : input.worst)
    for (const auto& scan : scans) recordings[{scan.key.scenario, scan.key.seed}].insert(scan.frame);
  return recordings;
}

/// Stands beside the run while a night is being stored. One line per start of a night in this folder that may be in the
/// store although it was killed.
fs::path unfinished_nights_file(const fs::path& run) {
  const fs::path whole = fs::absolute(run).lexically_normal();
  return whole.parent_path() / ("." + whole.filename().string() + ".night");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  return lines;
}

std::string all_ok_text(std::size_t cells) {
  return cells == 1 ? "the one cell is ok" : fmt::format("all {} cells are ok", cells);
}

/// Stores, judges and shows the night. `unfinished`: the starts of killed nights in this folder, which it replaces.
NightOutcome judge_night(const NightPlan& plan, Store store, const std::vector<std::string>& unfinished) {
  NightInput input;
  input.suite = plan.suite;
  input.reused = plan.reused;
  input.now = load_run_results(plan.run);
  input.facts = runs::manifest_facts(plan.run);
  if (fs::exists(plan.run / kReportPage)) input.report = kReportPage.name();
  if (!runs::load_benchmark(plan.run)) input.scenarios_page = input.report;
  const std::vector<study::Scenario> scenarios = runs::load_run_scenarios(plan.run);
  std::map<std::string, std::string> conditions;
  for (const auto& scenario : scenarios) conditions[scenario.name] = condition_text(scenario);
  input.rankings =
      rank_methods(input.now.cells, load_scan_seconds(runs::RunStore(plan.run), input.now.cells), conditions);
  input.worst = worst_scans(plan.run, input.now, kWorstScans);
  input.files = {runs::kSummaryFile.name(), runs::kManifestFile.name()};
  io::write_file_atomically(plan.run / kNightFile, io::json_line(nlohmann::ordered_json{{"suite", plan.suite}}) + "\n");
  NightOutcome outcome;
  const auto earlier = earlier_nights(plan, store, unfinished);
  const auto reference = reference_of(plan, store, earlier);
  if (reference) {
    const Comparison comparison = compare_with(*reference, input.now, plan.gates);
    outcome.sentence = verdict_sentence(comparison);
    outcome.exit_code = comparison.exit_code();
    store.add(plan.suite, plan.run, input.now, {verdict_word(comparison), outcome.sentence}, unfinished);
    input.reference = reference->text;
    for (const MetricChange* change : listed_changes(comparison)) {
      if (!input.now.overrides.empty()) break;  // this night is in no trend
      input.trends[change->scenario + "/" + change->pipeline + "/" + change->metric.metric] =
          store.trend(plan.suite, change->scenario, change->pipeline, change->metric.metric, kTrendNights);
    }
    const fs::path before = reference->results.folder.empty() ? last_good_folder(plan.run) : reference->results.folder;
    input.pictures = night_pictures(plan.run, before, comparison);
    for (const runs::RunFile* file : {&kComparisonJson, &kComparisonMarkdown, &kComparisonJunit})
      input.files.push_back(file->name());
    io::write_file_atomically(plan.run / kComparisonJson, comparison_json(comparison));
    io::write_file_atomically(plan.run / kComparisonMarkdown, to_markdown(comparison_document(comparison)));
    io::write_file_atomically(plan.run / kComparisonJunit, comparison_junit(comparison));
    input.comparison = comparison;
  } else {
    const auto bad = std::ranges::count_if(input.now.cells, [](const CellResults& cell) { return !cell.ok(); });
    const bool missing = std::ranges::any_of(
        input.now.cells, [](const CellResults& cell) { return cell.status == "missing" && cell.requested; });
    for (const runs::RunFile* file : {&kComparisonJson, &kComparisonMarkdown, &kComparisonJunit})
      fs::remove(plan.run / *file);  // of an earlier night, which had a reference
    outcome.exit_code = missing ? 4 : bad > 0 ? 1 : 0;
    const std::string why = !earlier.empty() ? "no earlier night of the suite was good and there is no baseline"
                                             : "this is the first night of the suite";
    const auto first = std::ranges::find_if(input.now.cells, [](const CellResults& cell) { return !cell.ok(); });
    outcome.sentence =
        bad == 0 ? fmt::format("PASS: {}, so nothing can be worse; {}.", why, all_ok_text(input.now.cells.size()))
                 : fmt::format("{}: {} of {} cells are not ok, first {}: {}. There is nothing to compare with: {}.",
                               missing ? "INCOMPLETE" : "FAIL", bad, input.now.cells.size(),
                               runs::to_string(first->key), first->status, why);
    store.add(plan.suite, plan.run, input.now,
              {missing   ? "INCOMPLETE"
               : bad > 0 ? "FAIL"
                         : "PASS",
               outcome.sentence},
              unfinished);
  }
  if (const auto files = current_baselines(baseline_files(plan.baselines, plan.suite)); files.size() > 1) {
    const Baseline oldest = load_baseline(files.front());
    input.drift = compare(oldest.results, gate_values(input.now, plan.gates), plan.gates);
    input.drift_reference = text_of(oldest);
  }
  if (write_player(plan.run, scenarios, linked_scans(input))) input.player = kPlayerPage.name();
  input.sentence = outcome.sentence;
  input.nights = store.nights(plan.suite);
  outcome.page = plan.run / kNightPage;
  io::write_file_atomically(outcome.page, to_html(night_document(input)));
  runs::refresh_manifest(plan.run);
  if (outcome.exit_code == 0 && input.now.overrides.empty()) keep_good_night(plan.run);
  return outcome;
}

}  // namespace

std::string suite_of_run(const fs::path& run) {
  if (!fs::exists(run / kNightFile)) return fs::absolute(run).lexically_normal().filename().string();
  return runs::with_json_of(run / kNightFile, [&](const nlohmann::ordered_json& json) {
    const auto suite = json.at("suite").get<std::string>();
    io::check_name("suite", suite);
    return suite;
  });
}

void check_plan(const NightPlan& plan) {
  if (const auto file = chosen_baseline(plan)) load_baseline(*file);
}

NightOutcome close_night(const NightPlan& plan, Store store) {
  const runs::RunLock lock(plan.run);
  runs::refuse_linked_folders(plan.run);
  io::remove_unfinished_folders(last_good_folder(plan.run));
  const fs::path mark = unfinished_nights_file(plan.run);
  const std::string starts = fs::exists(mark) ? io::read_file(mark) : "";
  io::write_file_atomically(mark, starts + runs::load_provenance(plan.run).start + "\n");
  const NightOutcome outcome = judge_night(plan, std::move(store), lines_of(starts));  // closes the store
  io::remove_file(mark);
  return outcome;
}

}  // namespace scanbench::results
