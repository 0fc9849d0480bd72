// The page of a night: what a maintainer opens in the morning. It answers "is anything worse?" first.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/results/analysis/comparison.hpp"
#include "harness/results/analysis/method_ranking.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/figures/worst_scans.hpp"
#include "harness/results/nightly/night_pictures.hpp"
#include "harness/results/nightly/store.hpp"
#include "harness/runs/store/run_file.hpp"

namespace scanbench::results {

inline const runs::RunFile kNightPage("nightly.html");

struct NightInput {
  std::string suite;
  std::string sentence;  ///< the verdict; its first word is PASS, FAIL or INCOMPLETE
  RunResults now;
  std::optional<Comparison> comparison;  ///< none: the first night, with nothing to compare with
  std::string reference;                 ///< "baseline 0003 of 2026-03-01 (reason)", "the night of ..."
  std::optional<Comparison> drift;       ///< against the oldest baseline that is kept
  std::string drift_reference;
  std::vector<Night> nights;  ///< of this suite, oldest first, this one last
  /// Of every change that the page lists: the values of the last nights, by "scenario/pipeline/metric".
  std::map<std::string, std::vector<TrendPoint>> trends;
  NightPictures pictures;
  std::vector<MethodRanking> rankings;
  std::vector<PipelineWorst> worst;
  std::vector<std::pair<std::string, std::string>> facts;  ///< how to get the numbers again
  std::size_t reused = 0;                                  ///< cells that were not run again, because nothing changed
  std::string report;              ///< the run's own report beside this page: a relative link; empty: there is none
  std::string scenarios_page;      ///< the same; empty if the report has no anchor per scenario
  std::string player;              ///< the page that plays this run's scans; empty: there is none
  std::vector<std::string> files;  ///< other files beside this page that hold its numbers
};

/// How many cells the night took from an earlier one, as a sentence.
std::string reuse_text(std::size_t cells, std::size_t reused);

Document night_document(const NightInput& input);

}  // namespace scanbench::results
