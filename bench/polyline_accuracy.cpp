// Fits polylines with given numbers of vertices to the scans of Schaefer, Buescher, Luft & Burgard, IROS 2018, and
// prints the results beside those that the authors published: the root mean square residual along the beam of the
// explained returns (mean over scans) and the share of returns explained. Needs ${SCANBENCH_DATA}/ple-bench-a.
//
//   polyline_accuracy [sim|real] [SCANS]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxBytes = 64 << 20;
constexpr double kSigma = 0.03;  // standard deviation that the authors use
constexpr int kBudgets[] = {10, 20, 30, 40, 50};

struct BenchScan {
  SensorModel sensor;
  std::vector<double> ranges;
};

double number(std::string_view text) {
  return std::strtod(std::string(text).c_str(), nullptr);
}

SensorModel sensor_of(double angle_min, double step, int beams) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(angle_min, step, beams);
  return sensor;
}

// Simulated rows: id, ranges. Real rows: id, log, index, x, y, theta, largest range, n, first angle, increment, ranges.
std::vector<BenchScan> read_scans(const fs::path& file, bool real) {
  const std::string text = io::read_text_file(file, kMaxBytes);
  std::string_view rest = text;
  std::vector<BenchScan> scans;
  std::vector<std::string_view> fields;
  while (!rest.empty()) {
    const std::string_view line = io::take_line(rest);
    if (line.empty() || line[0] == '#') continue;
    io::split_fields(line, fields);
    const std::size_t head = real ? 10 : 1;
    if (fields.size() <= head) throw ConfigError(file.string() + ": a row without ranges");
    BenchScan scan;
    for (std::size_t i = head; i < fields.size(); ++i) scan.ranges.push_back(number(fields[i]));
    const int n = static_cast<int>(scan.ranges.size());
    if (real) {
      const double largest = number(fields[6]);
      for (double& r : scan.ranges)
        if (!(r < largest)) r = kInf;
      scan.sensor = sensor_of(number(fields[8]), number(fields[9]), n);
    } else {
      scan.sensor = sensor_of(-kPi, kTwoPi / (n - 1), n);
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

struct Fit {
  double rmse_m = 0.0;
  double explained = 0.0;
};

Fit fit_of(const BenchScan& bench, const LineExtractor& extractor) {
  const Scan scan{bench.sensor, bench.ranges};
  Trace silent;
  const ScanLines found = extractor.extract(scan, silent);
  double squares = 0.0;
  int returns = 0, explained = 0;
  for (int i = 0; i < scan.beams(); ++i) {
    if (!scan.valid(i)) continue;
    ++returns;
    const int k = found.labels[as_index(i)];
    if (k < 0) continue;
    ++explained;
    const PolarLine& line = found.lines[as_index(k)].line;
    const double error = scan.ranges[as_index(i)] - line.rho / line.normal().dot(scan.sensor.geometry.direction(i));
    squares += error * error;
  }
  return {std::sqrt(squares / explained), static_cast<double>(explained) / returns};
}

void print_row(const std::vector<BenchScan>& scans, double sigma_m, bool clutter) {
  fmt::print("| polyline, sigma {:g} cm |", 100 * sigma_m);
  for (const int v : kBudgets) {
    const auto extractor = Registry<LineExtractor>::make(
        "polyline", {{"vertices", std::int64_t{v}}, {"clutter", clutter}, {"min_points", std::int64_t{1}}});
    Fit mean;
    for (BenchScan scan : scans) {
      scan.sensor.noise.sigma_m = sigma_m;
      const Fit fit = fit_of(scan, *extractor);
      mean.rmse_m += fit.rmse_m / static_cast<double>(scans.size());
      mean.explained += fit.explained / static_cast<double>(scans.size());
    }
    fmt::print(" {:.4f} m, {:.1f} % |", mean.rmse_m, 100 * mean.explained);
    std::fflush(stdout);
  }
  fmt::print("\n");
}

void print_table(const fs::path& folder, const std::string& set, std::size_t most_scans) {
  const bool real = set == "real";
  auto scans = read_scans(folder / (set + "_scans.csv.gz"), real);
  scans.resize(std::min(scans.size(), most_scans));
  fmt::print("\n{} scans, {}\n\n| method |", scans.size(), set);
  for (const int v : kBudgets) fmt::print(" {} |", v);
  fmt::print("\n|---|---|---|---|---|---|\n");
  print_row(scans, kSigma, real);
  // With a larger stated sigma fewer returns count as clutter. The shares are then comparable to the published ones.
  if (real)
    for (const double sigma_m : {0.06, 0.1}) print_row(scans, sigma_m, true);
  const fs::path file = folder / "published_results.csv";
  const io::CsvTable published(io::read_text_file(file, kMaxBytes), file,
                               {"dataset", "method", "max_vertices", "rmse_m", "fraction_of_returns_explained"});
  std::map<std::string, std::string> rows;
  for (std::size_t i = 0; i < published.rows(); ++i)
    if (published.text(i, "dataset") == set)
      rows[published.text(i, "method")] += fmt::format(" {:.4f} m, {:.1f} % |", published.number(i, "rmse_m"),
                                                       100 * published.number(i, "fraction_of_returns_explained"));
  for (const auto& [method, row] : rows) fmt::print("| {} (published) |{}\n", method, row);
}

int run(const std::vector<std::string>& args) {
  const char* data = std::getenv("SCANBENCH_DATA");
  const fs::path folder = fs::path(data ? data : "") / "ple-bench-a";
  if (!data || !fs::is_directory(folder)) {
    fmt::print(stderr,
               "ple-bench-a: not found; allowed: the environment variable SCANBENCH_DATA names the folder that holds "
               "the data set ple-bench-a\n");
    return 2;
  }
  const std::size_t most = args.size() > 1 ? std::strtoull(args[1].c_str(), nullptr, 10) : 1000;
  for (const std::string set : {"sim", "real"})
    if (args.empty() || args[0] == set) print_table(folder, set, most);
  return 0;
}

}  // namespace
}  // namespace scanbench::accuracy

int main(int argc, char** argv) {
  try {
    return scanbench::accuracy::run({argv + 1, argv + argc});
  } catch (const scanbench::ConfigError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
