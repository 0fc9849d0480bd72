// The store: one SQLite file with the results of every night. It is made from run folders, and can be made again from
// them. Others may read it while it is written (write-ahead log).
//
// Schema 1 (docs/formats.md):
//   meta(key, value)                                  program = scanbench, schema = 1
//   nights(night, suite, start, commit_hash, compiler, libraries, processor, command, folder, verdict, sentence,
//          overrides)                              overrides: those of --set; a store of an earlier version gets them
//   settings(night, scenario, path, value)            effective settings (harness/study/scenario/effective.hpp)
//   cells(cell, night, scenario, pipeline, seed, status, message, recording, requested)
//   metrics(metric, name, unit)
//   metric_rows(cell, position, metric, subject, value, count)      rows of metrics.csv; NULL: not defined
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/analysis/run_results.hpp"
#include "harness/results/nightly/database.hpp"

namespace scanbench::results {

/// A row of the table `nights`.
struct Night {
  std::int64_t id = 0;
  std::string suite;
  std::string start;  ///< UTC, ISO 8601, of the run
  std::string commit;
  std::string folder;    ///< of the run
  std::string verdict;   ///< PASS, FAIL, INCOMPLETE; empty: not judged
  std::string sentence;  ///< the verdict's sentence
  /// "key=value, ..." of --set; empty: a night like the others. A night with overrides is in no trend.
  std::string overrides;
};

struct StoredVerdict {
  std::string word;      ///< PASS, FAIL, INCOMPLETE; empty: not judged
  std::string sentence;  ///< empty: not judged
};

/// The folder of a run as the store names it: absolute.
std::string folder_in_store(const std::filesystem::path& folder);

/// The value of one metric of one pipeline in a past night: the mean over its seeds.
struct TrendPoint {
  std::int64_t night = 0;
  std::string start;
  std::string commit;
  double value = 0.0;
};

class Store {
 public:
  /// Opens the file, and makes it if there is none. Throws ConfigError for a file of another program, of another schema
  /// version, one that is cut off, and one that another program keeps locked for ten seconds.
  explicit Store(const std::filesystem::path& file);

  /// Adds a night with its verdict, all of it or nothing, and flushes it to disk. Nights of the folder that began at
  /// `unfinished` are removed: they were killed, and this one is the same again.
  std::int64_t add(const std::string& suite, const std::filesystem::path& folder, const RunResults& results,
                   const StoredVerdict& verdict = {}, const std::vector<std::string>& unfinished = {});
  /// The same for a run that may be there already (same start and folder): its older rows are removed.
  std::int64_t replace(const std::string& suite, const std::filesystem::path& folder, const RunResults& results);

  std::vector<Night> nights(const std::string& suite) const;  ///< oldest first
  RunResults load(std::int64_t night) const;

  /// The last `count` nights of a suite, oldest first; nights without a value, and those with overrides, are left out.
  std::vector<TrendPoint> trend(const std::string& suite, const std::string& scenario, const std::string& pipeline,
                                const std::string& metric, std::size_t count) const;

 private:
  bool is_empty() const;
  void create();
  void add_overrides();
  std::int64_t insert(const std::string& suite, const std::string& place, const RunResults& results,
                      const StoredVerdict& verdict);
  void remove(const std::string& place, const std::string& start);
  void check_schema() const;
  mutable Database database_;
};

}  // namespace scanbench::results
