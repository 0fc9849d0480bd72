// Writes and reads summary.csv.
#include "harness/runs/store/summary.hpp"

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"

namespace scanbench::runs {

std::string summary_header() {
  return "scenario,pipeline,seed,metric,subject,value,unit,count\n";
}

std::string summary_lines(const CellKey& key, const std::vector<metrics::MetricRow>& rows) {
  io::CsvWriter csv({"scenario", "pipeline", "seed", "metric", "subject", "value", "unit", "count"});
  for (const auto& row : rows)
    csv.text(key.scenario)
        .text(key.pipeline)
        .seed(key.seed)
        .text(row.metric)
        .text(row.subject)
        .number(row.value)
        .text(row.unit)
        .integer(row.count)
        .end_row();
  return csv.str().substr(summary_header().size());
}

std::vector<SummaryRow> load_summary(const std::filesystem::path& path) {
  const io::CsvTable csv(io::read_file(path), path,
                         {"scenario", "pipeline", "seed", "metric", "subject", "value", "unit", "count"});
  std::vector<SummaryRow> rows;
  rows.reserve(csv.rows());
  for (std::size_t r = 0; r < csv.rows(); ++r)
    rows.push_back({csv.text(r, "scenario"), csv.text(r, "pipeline"),
                    static_cast<std::uint64_t>(csv.integer(r, "seed")), csv.text(r, "metric"), csv.text(r, "subject"),
                    csv.number(r, "value"), csv.text(r, "unit"), csv.integer(r, "count")});
  return rows;
}

}  // namespace scanbench::runs
