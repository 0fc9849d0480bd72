// Compares whole runs of the program with named alternatives and prints rows of bench/ratios.hpp.
//
//   run_bench PROGRAM [rounds] [FORMER]     default: 3 rounds
//
// PROGRAM and FORMER are programs `scanbench`: the one that is measured, and one of an earlier commit. Rows against the
// earlier one are printed only where it is given, with the commit's scenarios in both. Runs go into a folder under the
// system's folder of temporary files, which is removed.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/ratios.hpp"
#include "core/rng.hpp"

namespace scanbench::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kCells = 1000;

struct Spent {
  double wall_s = 0;
  double cpu_s = 0;  ///< of the program and of the processes that it has started
};

double cpu_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Runs the program into an empty folder. Throws if it fails.
Spent spent_by(const std::string& program, const std::string& arguments, const fs::path& out) {
  fs::remove_all(out);
  const std::string command =
      "'" + program + "' run " + arguments + " --quiet --out '" + out.string() + "' > /dev/null";
  const double cpu = cpu_of_children();
  const auto begin = std::chrono::steady_clock::now();
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  return {wall.count(), cpu_of_children() - cpu};
}

/// The cells' own work: the seconds in all files timing.csv of a run folder.
double work_in(const fs::path& out) {
  double seconds = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out / "cells")) {
    if (entry.path().filename() != "timing.csv") continue;
    std::ifstream file(entry.path());
    std::string row;
    std::getline(file, row);  // the header
    while (std::getline(file, row)) seconds += std::stod(row.substr(row.rfind(',') + 1));
  }
  return seconds;
}

/// Times per unit of work in every round.
struct Timed {
  std::string name;
  std::vector<double> ns = {};
};

void print_row(const std::string& work, const Timed& alternative, const Timed& method, double limit) {
  std::vector<double> factors;
  for (std::size_t i = 0; i < method.ns.size(); ++i) factors.push_back(alternative.ns[i] / method.ns[i]);
  std::printf("| %s | %s: %s | %s: %s | %.3g | %.3g .. %.3g |", work.c_str(), alternative.name.c_str(),
              time_text(quantile(alternative.ns, 0.5)).c_str(), method.name.c_str(),
              time_text(quantile(method.ns, 0.5)).c_str(), quantile(factors, 0.5), quantile(factors, 0.1),
              quantile(factors, 0.9));
  limit > 0 ? std::printf(" %g |\n", limit) : std::printf(" |\n");
  std::fflush(stdout);
}

const std::string kScenarios = std::string(SCANBENCH_SOURCE_DIR) + "/scenarios/";

/// A scenario on the walls and the path of abcdef.yaml.
std::string scenario(const std::string& world, int scans, const std::string& pipelines, const std::string& metrics) {
  return "schema: 1\nabout: a benchmark\nworld: {file: '" + world +
         "'}\nsensor: {preset: ladar_2d30}\ntrajectory:\n  kind: waypoints\n  points_m: {A: [6.45, 3.15], B: [4.60, "
         "1.50], C: [2.30, 8.15], D: [7.25, 6.00], E: [5.10, 7.45], F: [1.35, 7.70]}\n  scans: " +
         std::to_string(scans) + "\nseed: 1\npipelines:\n" + pipelines + "metrics: [" + metrics + "]\n";
}

void write(const fs::path& file, const std::string& text) {
  if (!(std::ofstream(file) << text)) throw std::runtime_error("cannot write " + file.string());
}

/// Walls of 0.3 m to 6 m in 500 m x 500 m, around the path of abcdef.yaml but not on it.
std::string many_walls() {
  std::string text = "schema: 1\nname: walls\nsegments:\n";
  char row[128];
  for (int i = 0; i < 100000; ++i) {
    CounterRng rng(1, RngStream::pose, static_cast<std::uint32_t>(i));
    const double x = 20 + 480 * rng.uniform();
    const double y = 500 * rng.uniform();
    std::snprintf(row, sizeof row, "  - [%d, %.2f, %.2f, %.2f, %.2f]\n", i + 1, x, y, x + 0.3 + 5.7 * rng.uniform(),
                  y + 3 * rng.uniform());
    text += row;
  }
  return text;
}

class WholeRuns {
 public:
  WholeRuns(std::string program, std::string former, int rounds, fs::path folder)
      : program_(std::move(program)), former_(std::move(former)), rounds_(rounds), folder_(std::move(folder)) {}

  void cells() {
    const fs::path file = folder_ / "cells.yaml";
    write(file,
          scenario(kScenarios + "worlds/borges15.yaml", 20, "  - {name: sef, extract: {module: sef}}\n", "segments"));
    std::string arguments = "'" + file.string() + "' --no-figures --seed 1";
    for (int seed = 2; seed <= kCells; ++seed) arguments += "," + std::to_string(seed);
    Timed work{"the cells' own work"}, processor{"whole run, processor time"}, one{"1 job"}, two{"2 jobs"};
    // Each run has a folder of its own until the last has ended: after many files are removed, ext4 takes longer to
    // make new ones.
    for (int round = 0; round < rounds_; ++round) {
      const fs::path by_one = new_out(), by_two = new_out();
      const Spent alone = spent_by(program_, arguments, by_one);
      work.ns.push_back(1e9 * work_in(by_one) / kCells);
      processor.ns.push_back(1e9 * alone.cpu_s / kCells);
      one.ns.push_back(1e9 * alone.wall_s / kCells);
      two.ns.push_back(1e9 * spent_by(program_, arguments + " --jobs 2", by_two).wall_s / kCells);
    }
    std::vector<double> beside;
    for (std::size_t i = 0; i < work.ns.size(); ++i) beside.push_back(processor.ns[i] - work.ns[i]);
    processor.name += " (" + time_text(quantile(beside, 0.5)) + " beside the work)";
    print_row("1000 cells of one 20-scan recording each (sef), a cell", work, processor, 0);
    print_row("the same, wall time of a cell", one, two, 1.7);
  }

  void suite() {
    const std::string arguments = "'" + kScenarios + "suites/extractors.yaml' --no-figures --seed 1";
    Timed one{"1 job"}, two{"2 jobs"};
    for (int round = 0; round < rounds_; ++round) {
      one.ns.push_back(1e9 * spent_by(program_, arguments, out()).wall_s);
      two.ns.push_back(1e9 * spent_by(program_, arguments + " --jobs 2", out()).wall_s);
    }
    print_row("suites/extractors.yaml with one seed, wall time", one, two, 1.9);
  }

  /// Former programs do not know the metric raster_truth.
  void abcdef() {
    const fs::path file = folder_ / "abcdef.yaml";
    write(file, scenario(kScenarios + "worlds/borges15.yaml", 200,
                         "  - {name: sef, extract: {module: sef, params: {variant: points, threshold_m: 0.40}}}\n"
                         "  - {name: lt, extract: {module: line_tracking, params: {threshold_m: 0.10}}}\n"
                         "  - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}\n",
                         "borges2000, segments") +
                    "figures: [environment, scan_overlay]\n");
    against_former("scenarios/abcdef.yaml without raster_truth, whole run", "'" + file.string() + "'", false, 2.5);
  }

  void many_walls_and_segments() {
    write(folder_ / "walls.yaml", many_walls());
    write(folder_ / "two.yaml",
          scenario((folder_ / "walls.yaml").string(), 2, "  - {name: sef, extract: {module: sef}}\n", "segments"));
    against_former("two scans among 100 000 walls, metric segments, whole run",
                   "'" + (folder_ / "two.yaml").string() + "' --no-figures", false, 40);
  }

  void extractors() {
    for (const auto& [name, limit] : {std::pair{"polyline", 6.0}, {"smf", 4.0}, {"optimal", 2.0}}) {
      const fs::path file = folder_ / "extract.yaml";
      write(file, scenario(kScenarios + "worlds/borges15.yaml", 50,
                           "  - {name: p, extract: {module: " + std::string(name) + "}}\n", "segments"));
      against_former("50 scans of 451 beams, 5 cm noise, " + std::string(name), "'" + file.string() + "' --no-figures",
                     true, limit);
    }
  }

 private:
  fs::path out() const { return folder_ / "out"; }
  fs::path new_out() { return folder_ / ("out" + std::to_string(outs_++)); }

  /// Processor time of the whole run, or the cells' own work alone. Without a former program, prints the time.
  void against_former(const std::string& work, const std::string& arguments, bool own_work, double limit) {
    Timed before{"former program"}, now{"program"};
    const auto add = [&](const std::string& program, Timed& timed) {
      const Spent spent = spent_by(program, arguments, out());
      timed.ns.push_back(1e9 * (own_work ? work_in(out()) : spent.cpu_s));
    };
    for (int round = 0; round < rounds_; ++round) {
      if (!former_.empty()) add(former_, before);
      add(program_, now);
    }
    if (!former_.empty()) return print_row(work, before, now, limit);
    std::printf("| %s | former program: not given | program: %s | | | %g |\n", work.c_str(),
                time_text(quantile(now.ns, 0.5)).c_str(), limit);
    std::fflush(stdout);
  }

  std::string program_;
  std::string former_;
  int rounds_;
  fs::path folder_;
  int outs_ = 0;
};

}  // namespace
}  // namespace scanbench::bench

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  if (argc < 2) {
    std::fprintf(stderr, "usage: run_bench PROGRAM [rounds] [FORMER]\n");
    return 2;
  }
  std::string name = (fs::temp_directory_path() / "run_bench.XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    std::perror("run_bench");
    return 1;
  }
  int status = 0;
  try {
    scanbench::bench::WholeRuns runs(fs::absolute(argv[1]).string(), argc > 3 ? argv[3] : "",
                                     argc > 2 ? std::max(1, std::atoi(argv[2])) : 3, name);
    runs.abcdef();
    runs.many_walls_and_segments();
    runs.extractors();
    runs.cells();
    runs.suite();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "run_bench: %s\n", e.what());
    status = 1;
  }
  fs::remove_all(name);
  return status;
}
