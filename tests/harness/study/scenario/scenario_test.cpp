// Scenario and suite files: every rule broken once, the shipped files, the effective form, overrides.
#include "harness/study/scenario/scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/reader.hpp"
#include "harness/runs/execute/cell_address.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/study/catalog/find_module.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/suite.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::study {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<fs::path> yaml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// First line: `# expect: <part of the message>`.
TEST(WrongFiles, EachIsRefusedWithItsPlaceAndWhatIsAllowed) {
  const auto files = yaml_files(support::source_dir() / "tests/harness/data/wrong");
  ASSERT_GT(files.size(), 50U);
  for (const auto& file : files) {
    std::string_view text;
    const std::string bytes = io::read_text_file(file, io::kMaxYamlBytes);
    text = bytes;
    std::string_view expected = io::take_line(text);
    constexpr std::string_view kHead = "# expect: ";
    ASSERT_TRUE(expected.starts_with(kHead)) << file;
    expected.remove_prefix(kHead.size());
    const bool suite = file.filename().string().starts_with("suite_");
    const std::string message = support::config_refusal([&] {
      if (suite)
        load_suite(file);
      else
        load_scenario(file);
    });
    EXPECT_THAT(message, HasSubstr(std::string(expected))) << file;
    EXPECT_THAT(message, HasSubstr(".yaml:")) << file;
  }
}

constexpr const char* kSmall = R"(schema: 1
world: {segments: [[a, 0, 0, 4, 0], [b, 0, 4, 4, 4], [c, 0, 0, 0, 4]]}
sensor: {preset: ladar_2d30, sigma_m: 0.02}
trajectory: {kind: waypoints, points_m: {B: [1, 1], A: [3, 1]}, scans: 4, odometry: {rotation_per_m_deg: 1}}
seeds: {first: 5, count: 3}
pipelines:
  - {name: one, extract: {module: iepf, params: {threshold_m: 0.2}}}
  - {name: two, extract: {module: sef}}
metrics: [segments]
figures: [{name: environment}]
limits: {memory_mib: 100}
)";

TEST(Scenario, FillsInDefaultsAndKeepsWhatWasGiven) {
  const Scenario s = parse_scenario(kSmall, "some/rooms.yaml");
  EXPECT_EQ(s.name, "rooms");
  EXPECT_EQ(s.seeds, (std::vector<std::uint64_t>{5, 6, 7}));
  const auto& input = std::get<SimulatedInput>(s.input);
  EXPECT_EQ(input.sensor.noise.sigma_m, 0.02);
  EXPECT_EQ(input.sensor.geometry.beams(), 451);
  EXPECT_DOUBLE_EQ(input.odometry.rotation_per_m_rad, kPi / 180.0);
  EXPECT_FALSE(input.sweep);
  EXPECT_EQ(std::get<NamedPoints>(input.trajectory.params.at("points_m"))[0].first, "B");
  EXPECT_EQ(std::get<double>(s.pipelines[0].slots[0].params.at("threshold_m")), 0.2);
  EXPECT_EQ(s.pipelines[1].slots[0].params.size(), find_module("extract", "sef").params.size());
  EXPECT_EQ(s.limits.seconds, 600.0);
  EXPECT_EQ(s.limits.memory_bytes, 100.0 * 1024 * 1024);
}

TEST(Scenario, ReadsTiltInDegreesAndPassesItOn) {
  EXPECT_TRUE(simulation_input(parse_scenario(kSmall, "x.yaml"), 1).tilt.level());
  const Scenario s =
      parse_scenario(kSmall, "x.yaml", {"trajectory.tilt={roll_sigma_deg: 2, pitch_sigma_deg: 3, height_m: 1.2}"});
  const sim::Tilt tilt = simulation_input(s, 1).tilt;
  EXPECT_DOUBLE_EQ(tilt.roll_sigma_rad, kPi / 90.0);
  EXPECT_DOUBLE_EQ(tilt.pitch_sigma_rad, kPi / 60.0);
  EXPECT_EQ(tilt.height_m, 1.2);
  EXPECT_THAT(effective_yaml(s), HasSubstr("roll_sigma_deg: 2"));
  EXPECT_EQ(parse_scenario(kSmall, "x.yaml", {"trajectory.tilt={}"}).seeds, s.seeds);
}

TEST(Scenario, TheCasterIsExactUnlessTheReferenceIsRequested) {
  const Scenario s = parse_scenario(kSmall, "x.yaml");
  EXPECT_EQ(simulation_input(s, 1).caster, sim::CasterKind::exact);
  EXPECT_THAT(effective_yaml(s), testing::Not(HasSubstr("caster")));
  const Scenario reference = parse_scenario(kSmall, "x.yaml", {"caster=box2d"});
  EXPECT_EQ(simulation_input(reference, 1).caster, sim::CasterKind::box2d);
  EXPECT_EQ(simulation_input(parse_scenario(effective_yaml(reference), "x.yaml"), 1).caster, sim::CasterKind::box2d);
  EXPECT_EQ(runs::input_address(reference), runs::input_address(s));
  EXPECT_THAT(support::config_refusal([] { parse_scenario(kSmall, "x.yaml", {"caster=fast"}); }),
              HasSubstr("caster is 'fast'; allowed: exact, box2d"));
}

TEST(Scenario, OneSeedIsTheDefault) {
  std::string text = kSmall;
  text.erase(text.find("seeds"), text.find("pipelines") - text.find("seeds"));
  EXPECT_EQ(parse_scenario(text, "x.yaml").seeds, std::vector<std::uint64_t>{1});
}

TEST(Scenario, OverridesReachEveryPartAndAreCheckedLikeTheFile) {
  const auto with = [](const std::string& set) { return parse_scenario(kSmall, "x.yaml", {set}); };
  EXPECT_EQ(std::get<double>(
                with("pipelines.one.extract.params.threshold_m=0.3").pipelines[0].slots[0].params.at("threshold_m")),
            0.3);
  EXPECT_EQ(std::get<double>(
                with("pipelines.1.extract.params.threshold_m=0.4").pipelines[1].slots[0].params.at("threshold_m")),
            0.4);
  EXPECT_EQ(with("limits.seconds=7").limits.seconds, 7.0);
  EXPECT_EQ(with("seeds=[9]").seeds, std::vector<std::uint64_t>{9});
  EXPECT_EQ(with("metrics=[]").metrics.size(), 0U);
  const auto refusal = [&](const std::string& set) { return support::config_refusal([&] { with(set); }); };
  EXPECT_EQ(refusal("pipelines.one.extract.params.threshold_m=-1"),
            "--set pipelines.one.extract.params.threshold_m=-1: threshold_m is -1; allowed: a number >= 0 m");
  EXPECT_THAT(refusal("pipelines.three.extract=x"), HasSubstr("pipelines has no element 'three'"));
  EXPECT_THAT(refusal("sensor.sigma=1"), HasSubstr("--set sensor.sigma=1: unknown key 'sigma' in sensor"));
  EXPECT_THAT(refusal("limit.seconds=1"), HasSubstr("unknown key 'limit' in the scenario; did you mean 'limits'?"));
}

// The same content, independent of the folder it was read from.
void expect_stable(const Scenario& scenario) {
  const std::string effective = effective_yaml(scenario);
  Scenario again;
  ASSERT_NO_THROW(again = parse_scenario(effective, "/elsewhere/effective.yaml")) << effective;
  EXPECT_EQ(effective_yaml(again), effective);
  EXPECT_EQ(again.name, scenario.name);
  EXPECT_EQ(again.seeds, scenario.seeds);
  EXPECT_EQ(again.limits.memory_bytes, scenario.limits.memory_bytes);
  ASSERT_EQ(again.pipelines.size(), scenario.pipelines.size());
  for (std::size_t i = 0; i < again.pipelines.size(); ++i) {
    EXPECT_EQ(again.pipelines[i].name, scenario.pipelines[i].name);
    ASSERT_EQ(again.pipelines[i].slots.size(), scenario.pipelines[i].slots.size());
    for (std::size_t k = 0; k < again.pipelines[i].slots.size(); ++k) {
      EXPECT_EQ(again.pipelines[i].slots[k].kind, scenario.pipelines[i].slots[k].kind);
      EXPECT_EQ(again.pipelines[i].slots[k].module, scenario.pipelines[i].slots[k].module);
      EXPECT_EQ(again.pipelines[i].slots[k].params, scenario.pipelines[i].slots[k].params);
    }
  }
  ASSERT_EQ(again.input.index(), scenario.input.index());
  if (const auto* a = std::get_if<SimulatedInput>(&again.input)) {
    const auto& b = std::get<SimulatedInput>(scenario.input);
    EXPECT_EQ(a->sensor_params, b.sensor_params);
    EXPECT_EQ(a->trajectory.params, b.trajectory.params);
    EXPECT_EQ(a->odometry_params, b.odometry_params);
    EXPECT_EQ(a->tilt_params, b.tilt_params);
    ASSERT_EQ(a->world.walls.size(), b.world.walls.size());
    for (std::size_t i = 0; i < a->world.walls.size(); ++i)
      EXPECT_EQ(a->world.walls[i].segment, b.world.walls[i].segment);
  }
}

TEST(EffectiveScenario, IsAFixedPoint) {
  expect_stable(parse_scenario(kSmall, "rooms.yaml"));
  expect_stable(parse_scenario(kSmall, "rooms.yaml", {"trajectory.tilt={roll_sigma_deg: 2, height_m: 1}"}));
}

TEST(EffectiveScenario, NamesEveryParameterOfEveryModule) {
  const std::string text = effective_yaml(parse_scenario(kSmall, "rooms.yaml"));
  for (const auto& spec : find_module("extract", "sef").params) EXPECT_THAT(text, HasSubstr(spec.name + ":"));
}

TEST(ShippedScenarios, LoadRunClearOfWallsAndHaveAStableEffectiveForm) {
  auto files = yaml_files(support::source_dir() / "scenarios");
  std::erase_if(files, [](const fs::path& file) { return file.filename() == "figures.yaml"; });  // a catalogue
  EXPECT_GE(files.size(), 5U);
  for (const auto& file : files) {
    SCOPED_TRACE(file);
    Scenario scenario;
    ASSERT_NO_THROW(scenario = load_scenario(file));
    EXPECT_EQ(support::config_refusal([&] { runs::check_scenario(scenario); }), "");
    expect_stable(scenario);
  }
}

TEST(ShippedScenarios, AbcdefIsTheScenePrintedInThePaper) {
  const Scenario s = load_scenario(support::source_dir() / "scenarios/abcdef.yaml");
  const auto& input = std::get<SimulatedInput>(s.input);
  EXPECT_EQ(input.world.walls.size(), 15U);
  EXPECT_EQ(input.sensor.geometry.beams(), 451);
  EXPECT_EQ(simulation_input(s, 1).trajectory.poses.size(), 200U);
}

TEST(ShippedScenarios, ArenaIsTenMetresWideAndItsNoiseShrinksWithIt) {
  const Scenario s = load_scenario(support::source_dir() / "scenarios/four_rooms.yaml");
  const auto& input = std::get<SimulatedInput>(s.input);
  EXPECT_EQ(input.sensor.noise.sigma_m, 0.5 / 40.0);
  EXPECT_EQ(input.odometry.pose_position_sigma_m, 8.0 / 40.0);
}

TEST(ShippedSuites, LoadWithTheirSeeds) {
  for (const auto& file : yaml_files(support::source_dir() / "scenarios/suites")) {
    SCOPED_TRACE(file);
    EXPECT_TRUE(is_suite(file));
    if (io::read_file(file).find("../logs/") != std::string::npos && std::getenv("SCANBENCH_DATA") == nullptr) {
      std::cout << "SCANBENCH_DATA is not set: " << file << " is not read\n";
      continue;
    }
    if (file.filename().string().starts_with("peers")) {
      std::cout << "libraries are loaded by the program only: Peers.SuitesAreAccepted checks " << file << "\n";
      continue;
    }
    EXPECT_FALSE(load_suite(file).scenarios.empty());
  }
  EXPECT_FALSE(is_suite(support::source_dir() / "scenarios/abcdef.yaml"));
}

TEST(ShippedSuites, RunClearOfWalls) {
  for (const auto& file : yaml_files(support::source_dir() / "scenarios/scenes"))
    EXPECT_EQ(support::config_refusal([&] { runs::check_scenario(load_scenario(file)); }), "") << file;
}

TEST(ShippedSuites, ExtractorsAreComparedOnEveryWorldSensorAndNoise) {
  const Suite suite = load_suite(support::source_dir() / "scenarios/suites/extractors.yaml");
  ASSERT_EQ(suite.scenarios.size(), 6U * 3U * 3U * 2U);
  ASSERT_TRUE(suite.rules.benchmark.has_value());
  EXPECT_EQ(suite.rules.benchmark->about, suite.about);
  EXPECT_EQ(suite.rules.benchmark->levels.size(), 6U + 3U + 3U + 2U);
  EXPECT_EQ(suite.rules.benchmark->levels.back().factor, "returns");
  EXPECT_EQ(suite.rules.benchmark->levels.back().scenarios.size(), 6U * 3U * 3U);
  for (const auto& scenario : suite.scenarios) {
    const SensorNoise& noise = std::get<SimulatedInput>(scenario.input).sensor.noise;
    EXPECT_GT(noise.sigma_m, 0.0) << scenario.name;
    for (const double range_m : {0.5, 2.0, 4.0, 20.0})
      EXPECT_EQ(noise.range_sigma(range_m), noise.sigma_m) << scenario.name << " at " << range_m;
    EXPECT_EQ(noise.quantum_m, 0.0) << scenario.name;
    // Thresholds are multiples of the noise.
    const auto iepf = std::ranges::find(scenario.pipelines, "iepf", &PipelineSpec::name);
    ASSERT_NE(iepf, scenario.pipelines.end());
    EXPECT_NEAR(std::get<double>(iepf->slots.at(0).params.at("threshold_m")), 6.0 * noise.sigma_m, 1e-12);
  }
}

TEST(Suite, ReplacesPipelinesMetricsAndPublishedValues) {
  const support::TemporaryFolder folder;
  folder.write("one.yaml", kSmall);
  const auto file = folder.write("s.yaml",
                                 "schema: 1\nscenarios: [one.yaml]\nseeds: [4]\nmetrics: []\n"
                                 "pipelines: [{name: lt, extract: {module: line_tracking}}]\n");
  const Suite suite = load_suite(file, {"limits.seconds=3"});
  ASSERT_EQ(suite.scenarios.size(), 1U);
  EXPECT_EQ(suite.scenarios[0].name, "one");
  EXPECT_EQ(suite.scenarios[0].seeds, std::vector<std::uint64_t>{4});
  EXPECT_EQ(suite.scenarios[0].pipelines[0].name, "lt");
  EXPECT_TRUE(suite.scenarios[0].metrics.empty());
  EXPECT_EQ(suite.scenarios[0].limits.seconds, 3.0);
  folder.write("paper.csv", "metric,subject,method,value,unit\nn_lines,a,LT,1,\n");
  const auto paper = folder.write("p.yaml", "schema: 1\nscenarios: [one.yaml]\npublished: paper.csv\n");
  EXPECT_EQ(load_suite(paper).scenarios[0].published_file.filename(), "paper.csv");
  const auto twice = folder.write("t.yaml", "schema: 1\nscenarios: [one.yaml, one.yaml]\n");
  EXPECT_THAT(support::config_refusal([&] { load_suite(twice); }),
              HasSubstr("t.yaml:2:23: a second scenario is called one"));
}

TEST(MakeRecording, OneScanPerPoseWithTheTruth) {
  const Recording r = runs::make_recording(parse_scenario(kSmall, "x.yaml"), 5, 1);
  ASSERT_EQ(r.observed.frames.size(), 4U);
  EXPECT_EQ(r.observed.frames[0].ranges.size(), 451U);
  ASSERT_TRUE(r.truth.has_value());
  EXPECT_EQ(r.truth->walls.size(), 3U);
}

TEST(CheckScenario, FindsASensorThatIsOutOfRangeOfEveryWall) {
  const auto refusal = [](const std::string& range) {
    return support::config_refusal(
        [&] { runs::check_scenario(parse_scenario(kSmall, "x.yaml", {"sensor.range_max_m=" + range})); });
  };
  EXPECT_EQ(refusal("2"), "");  // walls are 1 m away
  EXPECT_THAT(refusal("0.9"), HasSubstr("x.yaml:4:41: "));
}

TEST(CheckScenario, NamesTheWaypointsOfAPathThatCrossesAWall) {
  std::string text = kSmall;
  text.replace(text.find("A: [3, 1]"), 9, "A: [3, 5]");
  const std::string refusal = support::config_refusal([&] { runs::check_scenario(parse_scenario(text, "x.yaml")); });
  EXPECT_THAT(refusal, testing::AllOf(testing::StartsWith("x.yaml:4:41: "), HasSubstr("crosses wall 'b'")));
  EXPECT_EQ(support::config_refusal([&] { runs::make_recording(parse_scenario(text, "x.yaml"), 1, 1); }), refusal);
}

TEST(Scenario, WithoutPipelinesItsEffectiveFormHasNoneEither) {
  std::string text = kSmall;
  text.erase(text.find("pipelines"), text.find("metrics") - text.find("pipelines"));
  const Scenario s = parse_scenario(text, "x.yaml");
  EXPECT_TRUE(s.pipelines.empty());
  expect_stable(s);
}

TEST(Suite, KeepsThePathOfPublishedValuesAsWritten) {
  const support::TemporaryFolder folder;
  folder.write("one.yaml", kSmall);
  folder.write("paper.csv", "metric,subject,method,value,unit\nn_lines,a,LT,1,\n");
  const auto file = folder.write("p.yaml", "schema: 1\nscenarios: [one.yaml]\npublished: paper.csv\n");
  EXPECT_EQ(load_suite(file).scenarios[0].published_as_written, "paper.csv");
}

TEST(MakeRecording, StatesTheCalculationBeforeItTakesTheMemory) {
  const Scenario s = parse_scenario(
      kSmall, "x.yaml",
      {"trajectory.scans=1000000", "sensor.beams=2000", "sensor.angle_step_deg=0.1", "sensor.time_per_beam_s=0"});
  const std::string message = support::config_refusal([&] { runs::make_recording(s, 1, 1); });
  EXPECT_THAT(message, HasSubstr("1000000 frames x 2000 beams x 20 B"));
  EXPECT_THAT(message, HasSubstr("limits.memory_mib = 100 MiB"));
}

TEST(Modules, EveryKindListsAndFindsItsModules) {
  for (const auto& kind : module_kinds())
    for (const auto& name : module_names(kind)) EXPECT_EQ(find_module(kind, name).info.name, name);
  EXPECT_THAT(support::config_refusal([] { find_module("extract", "iep"); }), HasSubstr("did you mean 'iepf'?"));
  EXPECT_THAT(support::config_refusal([] { module_names("extractor"); }), HasSubstr("did you mean 'extract'?"));
}

TEST(Suite, TakesEveryScenarioAtEveryCombinationOfLevels) {
  const support::TemporaryFolder folder;
  folder.write("one.yaml", kSmall);
  const auto file = folder.write("s.yaml", R"(schema: 1
scenarios: [one.yaml]
factors:
  beams: {few: {sensor.beams: 91, sensor.angle_step_deg: 3}, many: {sensor.preset: urg_04lx}}
  noise: {1cm: {sensor.sigma_m: 0.01, pipelines.lt.extract.params.threshold_m: 0.03}, 5cm: {sensor.sigma_m: 0.05}}
pipelines: [{name: lt, extract: {module: line_tracking, params: {threshold_m: 0.2}}}]
)");
  const Suite suite = load_suite(file, {"pipelines.lt.extract.params.min_points=7"});
  ASSERT_EQ(suite.scenarios.size(), 4U);
  const std::vector<std::string> names{"one-few-1cm", "one-few-5cm", "one-many-1cm", "one-many-5cm"};
  for (std::size_t i = 0; i < 4; ++i) {
    const Scenario& s = suite.scenarios[i];
    EXPECT_EQ(s.name, names[i]);
    const SensorModel& sensor = std::get<SimulatedInput>(s.input).sensor;
    EXPECT_EQ(sensor.geometry.beams(), i < 2 ? 91 : 682);
    EXPECT_EQ(sensor.noise.sigma_m, i % 2 == 0 ? 0.01 : 0.05);
    const ParamSet& params = s.pipelines.at(0).slots.at(0).params;
    EXPECT_EQ(std::get<double>(params.at("threshold_m")), i % 2 == 0 ? 0.03 : 0.2);
    EXPECT_EQ(std::get<std::int64_t>(params.at("min_points")), 7);
  }
  EXPECT_FALSE(suite.rules.benchmark.has_value());
}

TEST(Suite, RefusesOverridesOfWhatAFactorSets) {
  const support::TemporaryFolder folder;
  folder.write("one.yaml", kSmall);
  const auto file = folder.write("suite.yaml", R"(schema: 1
scenarios: [one.yaml]
pipelines: [{name: lt, extract: {module: line_tracking, params: {threshold_m: 0.2}}}]
factors:
  noise: {lo: {sensor.sigma_m: 0.01}, hi: {sensor.sigma_m: 0.05}}
  corner: {round: {pipelines.lt.extract.params.threshold_m: 0.3}}
)");
  const auto refusal = [&](const std::string& set) {
    return support::config_refusal([&] { load_suite(file, {"limits.seconds=60", set}); });
  };
  EXPECT_THAT(
      refusal("sensor.sigma_m=0.02"),
      HasSubstr("suite.yaml:5:16: the factor noise sets sensor.sigma_m, and --set sensor.sigma_m=0.02 would give "
                "all of its levels one value"));
  EXPECT_THAT(refusal("sensor={preset: urg_04lx}"), HasSubstr("suite.yaml:5:16: "));
  for (const std::string set : {"pipelines.lt.extract.params.threshold_m=0.1",
                                "pipelines.0.extract.params.threshold_m=1", "pipelines.lt.extract={module: iepf}"})
    EXPECT_THAT(refusal(set), HasSubstr("suite.yaml:6:20: the factor corner sets")) << set;
  EXPECT_EQ(load_suite(file, {"sensor.quantum_m=0", "pipelines.lt.extract.params.min_points=7"}).scenarios.size(), 2U);
}

}  // namespace
}  // namespace scanbench::study
