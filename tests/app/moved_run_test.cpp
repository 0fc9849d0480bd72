// A run folder on another machine: without its log, its published values, its lines and SCANBENCH_DATA.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kPublished = "metric,subject,method,value,unit\nprecision,all,IEPF,0.9,\nrecall,all,IEPF,0.8,\n";

std::string room_with_published() {
  return room_with("threshold_m: 0.10}}}", "threshold_m: 0.10}}, published: IEPF}") + "published: data/paper.csv\n";
}

std::string log_scenario() {
  return R"(schema: 1
recording: {log: "${SCANBENCH_DATA}/robot.csv", format: csv, step_deg: 10}
pipelines: [{name: iepf, extract: {module: iepf}}]
metrics: [siadat1997]
figures: [scan_overlay]
)";
}

std::string lines_scenario() {
  return R"(schema: 1
world: {segments: [[wall, 0, 0, 4, 0]]}
lines: {file: data/mine.csv}
pipelines: [{name: mean_shift, merge: {module: mean_shift}}]
metrics: [map_truth]
figures: [map]
)";
}

/// Runs of "file" in "here/file", and later in "there/file" with all inputs gone.
class MovedRun : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_.write("data/paper.csv", kPublished);
    folder_.write("data/robot.csv", "2,2,2,2,2,2,2,2\n2,2.1,2.2,2.3,2.2,2.1,2,2\n");
    folder_.write("data/mine.csv", "frame,x1_m,y1_m,x2_m,y2_m\n0,0,0,4,0\n1,0.1,0.02,3.9,0.01\n");
    folder_.write("room.yaml", room_with_published());
    folder_.write("log.yaml", log_scenario());
    folder_.write("lines.yaml", lines_scenario());
    folder_.write("cave.yaml", room_with_published());
    folder_.write("suite.yaml", "schema: 1\nscenarios: [room.yaml, cave.yaml]\n");
  }
  Outcome here(const Args& args, const Env& env) const { return run(args, env, folder_.path()); }
  Folder folder_;
};

TEST_P(MovedRun, IsScoredDrawnReportedAndComparedToTheSameBytes) {
  const std::string name = GetParam();
  const auto made = here({"run", name + ".yaml", "--out", "here/" + name, "-q"}, {{"SCANBENCH_DATA", "data"}});
  ASSERT_EQ(made.code, 0) << made.err;
  auto before = files(folder_ / "here" / name);
  fs::rename(folder_ / "here", folder_ / "there");
  for (const char* input : {"data", "room.yaml", "log.yaml", "lines.yaml", "cave.yaml", "suite.yaml"})
    fs::remove_all(folder_ / input);
  const std::string moved = "there/" + name;
  for (const char* output : {"figures", "report.html", "report.md", "summary.csv", "published"})
    fs::remove_all(folder_ / moved / output);

  const Env unset{{"SCANBENCH_DATA", ""}};
  for (const char* verb : {"score", "figures", "report"}) {
    const auto outcome = here({verb, moved}, unset);
    EXPECT_EQ(outcome.code, 0) << verb << ": " << outcome.err;
  }
  const auto compared = here({"compare", moved, moved}, unset);
  EXPECT_EQ(compared.code, 0) << compared.err;
  auto after = files(folder_ / moved);
  for (auto* found : {&before, &after})
    for (const char* file : {"manifest.json", "artefacts.sha256"}) found->erase(file);
  EXPECT_THAT(differences(before, after), IsEmpty());
  EXPECT_TRUE(before.contains(name == "suite" ? "published/cells.csv" : "report.html"));
}

INSTANTIATE_TEST_SUITE_P(Inputs, MovedRun, testing::Values("room", "log", "lines", "suite"),
                         [](const auto& input) { return std::string(input.param); });

using MovedInputs = MovedRun;

TEST_F(MovedInputs, AreNamedInTheReportAsTheUserCalledThem) {
  for (const std::string name : {"log", "lines"})
    ASSERT_EQ(here({"run", name + ".yaml", "--out", name, "-q"}, {{"SCANBENCH_DATA", "data"}}).code, 0);
  EXPECT_THAT(read(folder_ / "log/report.md"), AllOf(HasSubstr("robot.csv"), HasSubstr("SHA-256")));
  EXPECT_THAT(read(folder_ / "lines/report.md"), HasSubstr("mine.csv"));
}

TEST_F(MovedInputs, LetEffectiveYamlRunAgainFromTheMovedFolder) {
  ASSERT_EQ(here({"run", "room.yaml", "--out", "here", "-q"}, {}).code, 0);
  fs::rename(folder_ / "here", folder_ / "there");
  fs::remove_all(folder_ / "data");
  const auto again = here({"run", "there/effective.yaml", "--out", "again", "-q"}, {});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read(folder_ / "again/effective.yaml"), read(folder_ / "there/effective.yaml"));
  EXPECT_THAT(read(folder_ / "again/effective.yaml"), Not(HasSubstr(folder_.path().string())));
  EXPECT_THAT(differences(results(folder_ / "there"), results(folder_ / "again")), IsEmpty());
}

}  // namespace
}  // namespace scanbench::app_test
