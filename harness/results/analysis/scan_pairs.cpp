// Reads the values of scans in two runs and says why some cannot be paired.
#include "harness/results/analysis/scan_pairs.hpp"

namespace scanbench::results {
namespace {

/// Why two lists of values cannot be paired; nullptr if they can.
const char* obstacle(const std::optional<ScanValues>& before, const std::optional<ScanValues>& after) {
  if (!before || !after || before->mean != after->mean) return "it is not a mean over scans";
  return before->values.size() == after->values.size() ? nullptr : "the runs have different numbers of scans";
}

ScanPairs not_paired(const std::string& why) {
  ScanPairs none;
  none.obstacle = why;
  return none;
}

ScanPairs paired(const ScanValues& before, const ScanValues& after) {
  ScanPairs scans{.mean = before.mean, .counts = {.count = before.values.size(), .of = before.of}};
  for (std::size_t i = 0; i < before.values.size(); ++i) {
    const ScanPair pair{before.values[i], before.weights[i], after.values[i], after.weights[i]};
    scans.counts.lost += pair.weight_before > 0 && !(pair.weight_after > 0) ? 1U : 0U;
    scans.counts.gained += pair.weight_after > 0 && !(pair.weight_before > 0) ? 1U : 0U;
    scans.pairs.push_back(pair);
  }
  return scans;
}

}  // namespace

ScanPairer::Side::Side(const RunResults& results) : run(results) {
  if (!results.folder.empty()) reader.emplace(results.folder);
}

ScanPairer::ScanPairer(const RunResults& before, const RunResults& after) : before_(before), after_(after) {}

std::optional<ScanPairs> ScanPairer::pairs_of(const runs::CellKey& key, const std::string& metric,
                                              bool same_recording) {
  if (!before_.is_log(key) && !after_.is_log(key)) return std::nullopt;
  for (Side* side : {&before_, &after_})
    if (!side->is_log(key)) return not_paired(side->run.name + " keeps no single scans");
  if (!same_recording) return not_paired("the two recordings are not the same");
  const auto before = before_.reader->of(key, metric);
  const auto after = after_.reader->of(key, metric);
  if (const char* why = obstacle(before, after)) return not_paired(why);
  return paired(*before, *after);
}

}  // namespace scanbench::results
