// Fake modules and helpers of the tests of runs.
#include "tests/support/runs.hpp"

#include <algorithm>
#include <bit>
#include <csignal>
#include <cstdio>
#include <limits>
#include <set>

#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "core/geometry/least_squares.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/study/scenario/effective.hpp"
#include "metrics/metric.hpp"
#include "render/figure.hpp"

namespace scanbench::fixtures {
namespace fs = std::filesystem;
namespace {

struct LineRow {
  static constexpr std::string_view kName = "line";
  double x1_m = 0.0;
  double y1_m = 0.0;
  static constexpr auto columns() { return std::tuple{column("x1_m", &LineRow::x1_m), column("y1_m", &LineRow::y1_m)}; }
};

/// One line through the valid points, without the first `skip` of them.
class LineOfAll final : public LineExtractor {
 public:
  struct Params {
    int skip = 0;
    bool covariance = false;
    static auto fields() {
      return std::tuple{field("skip", &Params::skip, at_least(0), "", "points left out at the start"),
                        field("covariance", &Params::covariance, "whether to state one")};
    }
  };
  explicit LineOfAll(const Params& params) : params_(params) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    ScanLines result;
    result.labels.assign(static_cast<std::size_t>(scan.beams()), -1);
    const ScanPoints points = valid_points(scan);
    const auto skip = static_cast<std::size_t>(params_.skip);
    trace.stage(Stage::segment);
    if (points.size() < skip + 2) return result;
    const std::span<const Vec2> used = std::span(points.points).subspan(skip);
    const LineFit fit = fit_line(used);
    for (std::size_t i = skip; i < points.size(); ++i) result.labels[static_cast<std::size_t>(points.beams[i])] = 0;
    LineFeature line;
    line.segment = {fit.project(used.front()), fit.project(used.back())};
    line.line = fit.polar();
    line.first_beam = points.beams[skip];
    line.last_beam = points.beams.back();
    line.points = static_cast<int>(used.size());
    line.rms_m = fit.rms();
    if (params_.covariance) line.covariance = Eigen::Matrix2d{{0.1, 0.02}, {0.02, 1.0 / 3.0}};
    result.lines.push_back(line);
    trace.row(LineRow{line.segment.a.x(), line.segment.a.y()});
    return result;
  }

 private:
  Params params_;
};

/// Misbehaves on frame 2 of its recordings, whose stamp is 2.
template <class Deed>
class Misbehaving final : public LineExtractor {
 public:
  using Params = NoParams;
  explicit Misbehaving(const Params&) {}
  ScanLines extract(const Scan& scan, Trace&) const override {
    ScanLines result;
    result.labels.assign(static_cast<std::size_t>(scan.beams()), -1);
    if (scan.stamp_s == 2.0) Deed{}(result);
    return result;
  }
};

struct Crash {
  void operator()(ScanLines&) const {
    std::fputs("a last word before the fall\n", stderr);
    std::signal(SIGSEGV, SIG_DFL);  // sanitizers catch it otherwise
    ::raise(SIGSEGV);
  }
};
struct Hang {
  void operator()(ScanLines&) const {
    while (true) ::usleep(1000);
  }
};
/// Hangs on every scan.
class HangAtOnce final : public LineExtractor {
 public:
  using Params = NoParams;
  explicit HangAtOnce(const Params&) {}
  ScanLines extract(const Scan&, Trace&) const override {
    ScanLines none;
    Hang{}(none);
    return none;
  }
};
struct Eat {
  void operator()(ScanLines&) const {
    // Never touched: the limit is on address space, and the machine of the test stays usable.
    static std::vector<std::unique_ptr<char[]>> hoard;
    while (true) hoard.push_back(std::unique_ptr<char[]>(new char[1 << 26]));
  }
};
struct Throw {
  void operator()(ScanLines&) const { throw std::runtime_error("cannot go on"); }
};
struct WrongLabels {
  void operator()(ScanLines& lines) const { lines.labels.pop_back(); }
};
struct Leave {
  void operator()(ScanLines&) const { ::_exit(0); }
};
/// After this the process can write nothing, as on a full disk.
struct FillDisk {
  void operator()(ScanLines&) const {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_FSIZE, &none);
  }
};

struct PointsRow {
  static constexpr std::string_view kName = "points";
  int points = 0;
  static constexpr auto columns() { return std::tuple{column("points", &PointsRow::points)}; }
};

/// All lines become one, from the first's start to the last's end; frame parity is the first clustering.
class MergeAll final : public SegmentMerger {
 public:
  using Params = NoParams;
  explicit MergeAll(const Params&) {}
  MergeResult merge(const MergeInput& input, Trace& trace) const override {
    trace.stage(Stage::phase1);
    trace.row(PointsRow{static_cast<int>(input.points.size())});
    MergeResult result;
    result.labels.assign(input.lines.size(), 0);
    for (std::size_t i = 0; i < input.lines.size(); ++i) result.cluster1.push_back(static_cast<int>(i % 2));
    if (input.lines.empty()) return result;
    MapLine line{.segment = {input.lines.front().segment.a, input.lines.back().segment.b}};
    line.members = static_cast<int>(input.lines.size());
    line.points = static_cast<int>(input.points.size());
    result.map.lines.push_back(line);
    return result;
  }
};

/// Moves every pose by (10, 20).
class ShiftAll final : public Aligner {
 public:
  using Params = NoParams;
  explicit ShiftAll(const Params&) {}
  Alignment align(std::span<const Observation>, std::span<const Pose2> initial, Trace&) const override {
    Alignment result{Status::max_iterations, {}};
    for (const Pose2& pose : initial)
      result.world_from_sensor.push_back(Pose2::from_unit(pose.translation() + Vec2(10, 20), {pose.cos(), pose.sin()}));
    return result;
  }
};

/// One metre ahead for every guess; no match for the scan of time 2.
class OneAhead final : public ScanMatcher {
 public:
  using Params = NoParams;
  explicit OneAhead(const Params&) {}
  Match match(const Observation&, const Observation& current, const Pose2&, Trace&) const override {
    Match result;
    result.reference_from_current = Pose2(1, 0, 0);
    if (current.scan.stamp_s == 2.0) result.status = Status::no_match;
    return result;
  }
};

/// A line of length one at every pose that it gets.
class PoseMapper final : public Mapper {
 public:
  using Params = NoParams;
  explicit PoseMapper(const Params&) {}
  Insertion insert(const Observation&, const Pose2& guess, Trace&) override {
    map_.lines.push_back({.segment = guess * Segment{Vec2(0, 0), Vec2(1, 0)}});
    return {.world_from_sensor = guess, .lines = static_cast<int>(map_.lines.size())};
  }
  LineMap map() const override { return map_; }

 private:
  LineMap map_;
};

/// Beams without a line (fewer is better, tolerance one), lines, and a row that is not defined; lines per frame as a
/// table.
class TestMetrics final : public metrics::MetricFamily {
 public:
  struct Params {
    bool table = false;
    static auto fields() { return std::tuple{field("table", &Params::table, "write test_table.csv")}; }
  };
  explicit TestMetrics(const Params& params) : params_(params) {}
  std::vector<metrics::MetricDescription> describe() const override {
    using metrics::Direction;
    return {{"test_unlabelled", "unlabelled beams", "beams", Direction::lower_is_better, 1.0, "beams without a line",
             false},
            {"test_lines", "lines", "", Direction::neither, 0.0, "lines", false},
            {"test_undefined", "undefined value", "m", Direction::lower_is_better, 0.0, "never defined", false}};
  }
  bool applies(const metrics::MetricInput& input) const override { return input.truth != nullptr; }
  std::vector<metrics::MetricRow> evaluate(const metrics::MetricInput& input) const override {
    std::int64_t unlabelled = 0;
    std::int64_t lines = 0;
    for (const auto& scan : input.result.lines) {
      unlabelled += std::ranges::count(scan.labels, -1);
      lines += static_cast<std::int64_t>(scan.lines.size());
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {{"test_unlabelled", "a, \"b\"", static_cast<double>(unlabelled), "beams", unlabelled, 0.25, {}},
            {"test_lines", "all", static_cast<double>(lines), "", lines, {}, {}},
            {"test_undefined", "all", nan, "m", 0, {}, {}}};
  }
  std::vector<metrics::MetricTable> tables(const metrics::MetricInput& input) const override {
    if (!params_.table) return {};
    metrics::MetricTable table{"test_table", {"lines"}, {}};
    for (const auto& scan : input.result.lines) table.rows.push_back({static_cast<double>(scan.lines.size())});
    return {table};
  }
  std::vector<std::string> table_names() const override { return {"test_table"}; }

 private:
  Params params_;
};

class NeedsAMap final : public metrics::MetricFamily {
 public:
  using Params = NoParams;
  explicit NeedsAMap(const Params&) {}
  std::vector<metrics::MetricDescription> describe() const override { return {}; }
  bool applies(const metrics::MetricInput& input) const override { return !input.result.map.lines.empty(); }
  std::vector<metrics::MetricRow> evaluate(const metrics::MetricInput&) const override {
    return {{"test_map", "all", 1.0, "", 1, {}, {}}};
  }
};

/// States in its caption the rows of the trace that it got.
class Traced final : public render::Figure {
 public:
  using Params = NoParams;
  explicit Traced(const Params&) {}
  std::vector<std::string> trace_rows(std::string_view) const override { return {"extract.line"}; }
  std::vector<render::NamedScene> draw(const render::FigureInput& input) const override {
    const render::NamedResult& first = input.results.at(0);
    return {{"traced", std::to_string(first.trace->at("extract.line").size()) + " rows of " + first.pipeline, {}}};
  }
};

template <class Interface, class Impl>
bool add(const std::string& name) {
  return Registry<Interface>::template add<Impl>({.name = name, .summary = "of the tests", .reference = "none"});
}

const bool registered =
    add<LineExtractor, LineOfAll>("test_line") && add<LineExtractor, Misbehaving<Crash>>("test_crash") &&
    add<LineExtractor, Misbehaving<Hang>>("test_hang") && add<LineExtractor, HangAtOnce>("test_hang_at_once") &&
    add<LineExtractor, Misbehaving<Eat>>("test_eat") && add<LineExtractor, Misbehaving<Throw>>("test_throw") &&
    add<LineExtractor, Misbehaving<WrongLabels>>("test_wrong_labels") &&
    add<LineExtractor, Misbehaving<Leave>>("test_leave") &&
    add<LineExtractor, Misbehaving<FillDisk>>("test_full_disk") && add<SegmentMerger, MergeAll>("test_merge") &&
    add<Aligner, ShiftAll>("test_shift") && add<ScanMatcher, OneAhead>("test_ahead") &&
    add<Mapper, PoseMapper>("test_mapper") && add<metrics::MetricFamily, TestMetrics>("test_metrics") &&
    add<metrics::MetricFamily, NeedsAMap>("test_needs_map") && add<render::Figure, Traced>("test_traced");

}  // namespace

Recording random_recording(std::uint64_t seed, int frames, int beams, bool with_truth) {
  CounterRng rng(seed, RngStream::range);
  const double inf = std::numeric_limits<double>::infinity();
  const double special[] = {inf, -inf, std::numeric_limits<double>::quiet_NaN(), -0.0};
  const auto pose = [&] {
    return Pose2(rng.normal(), rng.normal(), 6 * rng.uniform() - 3) * Pose2(1, 0, rng.normal());
  };
  Recording recording;
  SensorModel& sensor = recording.observed.sensor;
  sensor.name = "test, \"laser\"";
  sensor.geometry = ScanGeometry(-1.0 / 3.0, 0.1 + 0.2, beams);
  sensor.range_max_m = inf;
  sensor.noise.sigma_m = 0.1 + 0.2;  // not the double nearest to 0.3
  Truth truth;
  truth.walls = {{"a, \"quoted\"\nwall", {Vec2(rng.normal(), -0.0), Vec2(rng.normal(), 1e-300)}},
                 {"", {Vec2(0, 0), Vec2(1, 1)}}};
  for (int k = 0; k < frames; ++k) {
    Frame frame{static_cast<double>(k), {}, pose()};
    for (int i = 0; i < beams; ++i) {
      const std::uint32_t dice = rng.bits() % 16;
      frame.ranges.push_back(dice < 4 ? special[dice] : 10 * rng.uniform());
      truth.ranges.push_back(dice == 5 ? inf : 10 * rng.uniform());
      truth.wall_ids.push_back(static_cast<std::int32_t>(rng.bits() % 3) - 1);
    }
    recording.observed.frames.push_back(std::move(frame));
    truth.world_from_sensor.push_back(pose());
  }
  if (with_truth) recording.truth = std::move(truth);
  return recording;
}

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> result;
  for (const double v : values) result.push_back(std::bit_cast<std::uint64_t>(v));
  return result;
}

study::PipelineSpec extract_with(const std::string& name, const std::string& module, const ParamSet& params) {
  study::PipelineSpec pipeline;
  pipeline.name = name;
  pipeline.slots = {{"extract", module, params}};
  return pipeline;
}

study::Scenario scenario_with(const std::string& name, std::vector<study::PipelineSpec> pipelines,
                              std::vector<std::uint64_t> seeds) {
  study::Scenario scenario;
  scenario.name = name;
  scenario.text = "about: " + name + "\n";
  scenario.input = study::SimulatedInput{};
  scenario.seeds = std::move(seeds);
  scenario.pipelines = std::move(pipelines);
  scenario.metrics = {{"metrics", "test_metrics", {}}, {"metrics", "test_needs_map", {}}};
  scenario.limits = {.seconds = 60, .memory_bytes = 1e9};
  return scenario;
}

runs::RunServices services() {
  return {
      .recording = [](const study::Scenario&, std::uint64_t seed, int) { return random_recording(seed, 5, 16, true); },
      .effective_yaml = [](const study::Scenario& s,
                           const study::StoredInputs&) { return s.text + "effective: true\n"; }};
}

runs::RunResult run_here(const std::vector<study::Scenario>& scenarios, const runs::RunOptions& options) {
  return runs::run_with(scenarios, options, services());
}

std::map<std::string, std::string> artefacts(const fs::path& run) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file()) continue;
    if (name == "manifest.json" || name == "artefacts.sha256" || name == "timing.csv") continue;
    std::string bytes = io::read_file(entry.path());
    if (name == "status.json") {
      auto json = nlohmann::json::parse(bytes);
      for (const char* key : {"wall_seconds", "cpu_seconds", "peak_memory_bytes"}) json.erase(key);
      bytes = json.dump();
    }
    files[entry.path().lexically_relative(run).string()] = bytes;
  }
  return files;
}

const runs::CellResult& cell_of(const runs::RunResult& result, const std::string& key) {
  for (const auto& cell : result.cells)
    if (runs::to_string(cell.key) == key) return cell;
  throw std::runtime_error("no cell " + key);
}

std::vector<std::string> listing(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(entry.path().lexically_relative(folder).string());
  return {names.begin(), names.end()};
}

}  // namespace scanbench::fixtures
