// The verb figures: sizes, styles, captions, equal bytes, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <regex>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string two_pipelines() {
  return room_with("metrics:", "  - {name: lt, extract: {module: line_tracking, params: {}}}\nmetrics:");
}

class Figures : public testing::Test {
 protected:
  void SetUp() override {
    std::string text = two_pipelines();
    folder_.write("room.yaml", text.replace(text.find("[environment]"), 13, "[environment, scan_overlay]"));
  }
  Outcome here(const Args& args, const Env& env = {}) const { return run(args, env, folder_.path()); }
  Outcome figures(Args more, const Env& env = {}) const {
    more.insert(more.begin(), {"figures", "run"});
    return here(more, env);
  }
  void make_run() const { ASSERT_EQ(here({"run", "room.yaml", "--out", "run", "-q", "--no-figures"}).code, 0); }
  Folder folder_;
};

/// Width and height in the header of a PNG file.
std::pair<int, int> png_size(const std::string& bytes) {
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes.at(at + i));
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(Figures, OfTwoRunsOfOneAndTwoJobsAndOfAResumedRunHaveEqualBytes) {
  const Args seeds{"--seed", "1,2", "-q", "--no-figures"};
  const auto make = [&](const std::string& out, const Args& more) {
    Args args{"run", "room.yaml", "--out", out};
    args.insert(args.end(), seeds.begin(), seeds.end());
    args.insert(args.end(), more.begin(), more.end());
    return here(args).code;
  };
  ASSERT_EQ(make("one", {"--jobs", "1"}), 0);
  ASSERT_EQ(make("again", {"--jobs", "1"}), 0);
  ASSERT_EQ(make("two", {"--jobs", "2"}), 0);
  ASSERT_EQ(make("resumed", {"--jobs", "1"}), 0);
  fs::remove_all(folder_ / "resumed/cells/room/lt/1");
  ASSERT_EQ(make("resumed", {"--resume"}), 0);
  for (const std::string name : {"one", "again", "two", "resumed"})
    ASSERT_EQ(here({"figures", name, "--format", "png,svg,pdf", "--out", "figures of " + name, "-q"}).code, 0);
  const auto expected = files(folder_ / "figures of one");
  EXPECT_EQ(expected.size(), 2U * 4U + 1U);  // three pictures and a caption each, and the index
  for (const std::string name : {"again", "two", "resumed"})
    EXPECT_THAT(differences(expected, files(folder_ / ("figures of " + name))), IsEmpty()) << name;
}

TEST_F(Figures, HaveTheWidthAndResolutionThatAJournalAsksFor) {
  make_run();
  ASSERT_EQ(figures({"--format", "png,pdf", "--width-mm", "84", "--dpi", "300", "--out", "narrow"}).code, 0);
  EXPECT_EQ(png_size(read(folder_ / "narrow/room_environment.png")).first, 992);  // 84 / 25.4 * 300 = 992.1
  const std::string pdf = read(folder_ / "narrow/room_environment.pdf");
  std::smatch box;
  ASSERT_TRUE(std::regex_search(pdf, box, std::regex(R"(/MediaBox \[ 0 0 ([0-9.]+) )")));
  EXPECT_NEAR(std::stod(box[1]), 84 / 25.4 * 72, 0.01);
  EXPECT_FALSE(fs::exists(folder_ / "narrow/room_environment.svg"));
}

TEST_F(Figures, PdfHasAFixedDateAndCarriesItsFonts) {
  make_run();
  ASSERT_EQ(figures({"--format", "pdf", "--out", "pdf"}).code, 0);
  const std::string pdf = read(folder_ / "pdf/room_environment.pdf");
  EXPECT_THAT(pdf, HasSubstr("/CreationDate (D:200001010000"));
  const auto count = [&](const std::string& what) {
    std::size_t n = 0;
    for (auto at = pdf.find(what); at != std::string::npos; at = pdf.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_GE(count("/Type /FontDescriptor"), 1U);
  EXPECT_EQ(count("/Type /FontDescriptor"), count("/FontFile2"));
  EXPECT_EQ(count("/Subtype /Type3"), 0U) << "letters as pictures";
}

TEST_F(Figures, ShowOnlyTheNamedPipelinesAndTheNamedScanWithoutATitle) {
  make_run();
  const auto outcome = figures({"--format", "svg", "--pipeline", "lt", "--frame", "3", "--no-title", "--out", "lt"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(read(folder_ / "lt/room_scan_overlay.caption.txt"), HasSubstr("the points of scan 3, "));
  ASSERT_EQ(figures({"--format", "svg", "--frame", "3", "--out", "both"}).code, 0);
  // A panel less, and no title: the picture is smaller.
  EXPECT_LT(fs::file_size(folder_ / "lt/room_scan_overlay.svg"), fs::file_size(folder_ / "both/room_scan_overlay.svg"));
}

TEST_F(Figures, StylesDifferAndOnlyADarkOneHasADarkGround) {
  make_run();
  for (const std::string style : {"paper", "slides", "dark"})
    ASSERT_EQ(figures({"--format", "svg", "--style", style, "--out", style, "-q"}).code, 0);
  const auto picture = [&](const std::string& style) { return read(folder_ / style / "room_environment.svg"); };
  const std::string ground = "rgb(9.4";  // 24 / 255 = 9.41 %
  EXPECT_THAT(picture("dark"), HasSubstr(ground));
  EXPECT_THAT(picture("paper"), Not(HasSubstr(ground)));
  EXPECT_NE(picture("paper"), picture("slides"));
}

TEST_F(Figures, CaptionsSayTheSeedAndThatTheSensorIsTilted) {
  folder_.write("tilted.yaml", room_with("scans: 5}",
                                         "scans: 5, tilt: {pitch_sigma_deg: 2}, "
                                         "odometry: {translation_per_m: 0.05}}"));
  ASSERT_EQ(here({"run", "tilted.yaml", "--seed", "7", "--out", "run", "-q"}).code, 0);
  const std::string caption = read(folder_ / "run/figures/tilted_environment.caption.txt");
  EXPECT_THAT(caption, AllOf(HasSubstr("seed 7"), HasSubstr("tilted"), HasSubstr("0 deg of roll, 2 deg of pitch"),
                             HasSubstr("odometry with errors")));
  EXPECT_THAT(read(folder_ / "run/report.md"), HasSubstr("odometry with errors"));
}

TEST_F(Figures, RefuseSizesThatNoFigureHas) {
  make_run();
  const auto refusal = [&](const Args& args) {
    const auto outcome = figures(args);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    return outcome.err;
  };
  EXPECT_THAT(refusal({"--dpi", "0"}), HasSubstr("'0' is not a resolution in dpi; allowed: 36 .. 1200"));
  EXPECT_THAT(refusal({"--dpi", "1e9"}), HasSubstr("allowed: 36 .. 1200"));
  EXPECT_THAT(refusal({"--dpi", "nan"}), HasSubstr("allowed: 36 .. 1200"));
  EXPECT_THAT(refusal({"--width-mm", "5"}), HasSubstr("'5' is not a width in mm; allowed: 30 .. 1000"));
  EXPECT_THAT(refusal({"--width-mm", "1000", "--dpi", "1200"}),
              AllOf(HasSubstr("47244 pixels"), HasSubstr("allowed: up to 20000"), HasSubstr("508 dpi")));
  EXPECT_THAT(refusal({"--font-pt", "99"}), HasSubstr("allowed: 4 .. 36"));
  EXPECT_THAT(refusal({"--format", "png,gif"}), HasSubstr("'gif' is not a format"));
  EXPECT_THAT(refusal({"--style", "drak"}), HasSubstr("did you mean 'dark'?"));
  EXPECT_THAT(refusal({"--pipeline", "iefp"}), HasSubstr("did you mean 'iepf'?"));
  EXPECT_THAT(refusal({"--frame", "5"}), HasSubstr("room has no scan 5; allowed: 0 to 4"));
  EXPECT_FALSE(fs::exists(folder_ / "run/figures"));
}

TEST_F(Figures, AreDrawnByNameThoughTheScenarioDoesNotListThem) {
  make_run();
  ASSERT_EQ(figures({"-q"}).code, 0);
  const auto before = files(folder_ / "run/figures");
  const auto outcome = figures({"--figure", "accuracy_time,seeds"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("room_accuracy_time.svg"), HasSubstr("room_seeds.svg"), Not(HasSubstr("environment"))));
  EXPECT_THAT(read(folder_ / "run/figures/room_accuracy_time.svg"), HasSubstr("CPU time of one scan"));
  auto after = files(folder_ / "run/figures");
  for (const auto& [name, bytes] : before)
    if (name != "index.json") {
      EXPECT_EQ(after[name], bytes) << name;
    }
  const std::string index = read(folder_ / "run/figures/index.json");
  EXPECT_THAT(index, AllOf(HasSubstr("room_environment"), HasSubstr("room_accuracy_time"), HasSubstr("room_seeds")));
}

TEST_F(Figures, ThatTheRunCannotGiveSayWhatIsMissing) {
  make_run();
  const auto refusal = [&](const Args& args) {
    const auto outcome = figures(args);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    return outcome.err;
  };
  EXPECT_THAT(refusal({"--figure", "joint_space"}),
              AllOf(HasSubstr("joint_space is not drawn: no pipeline has the trace rows merge."),
                    HasSubstr("scanbench run --trace")));
  EXPECT_THAT(refusal({"--figure", "map"}), HasSubstr("map is not drawn: no pipeline has lines in a map"));
  EXPECT_THAT(refusal({"--figure", "sweep"}), HasSubstr("no two pipelines differ in one parameter alone"));
  EXPECT_THAT(refusal({"--figure", "enviroment"}), HasSubstr("did you mean 'environment'?"));
  EXPECT_THAT(refusal({"--only", "environment"}), HasSubstr("--figure"));
}

TEST_F(Figures, HaveThreeHundredDotsPerInchIfNoneAreNamed) {
  make_run();
  ASSERT_EQ(figures({"--format", "png", "--width-mm", "84", "--out", "narrow"}).code, 0);
  EXPECT_EQ(png_size(read(folder_ / "narrow/room_environment.png")).first, 992);  // 84 / 25.4 * 300 = 992.1
}

TEST_F(Figures, RefuseAFolderWithOtherFilesAndKeepThem) {
  make_run();
  folder_.write("thesis/chapter.txt", "years of work");
  folder_.write("other/index.json", "{\"pages\": 3}");
  for (const std::string name : {"thesis", "other"}) {
    const auto before = files(folder_ / name);
    const auto outcome = figures({"--out", name});
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr(name));
    EXPECT_THAT(differences(before, files(folder_ / name)), IsEmpty());
  }
  ASSERT_EQ(figures({"--out", "new", "-q"}).code, 0);
  EXPECT_EQ(figures({"--out", "new", "-q"}).code, 0);  // our own, again
}

TEST_F(Figures, WithoutTheFontSayWhatToInstall) {
  make_run();
  const auto outcome = figures({"-q"}, {{"SCANBENCH_FONT", "/nowhere/font.ttf"}});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("SCANBENCH_FONT names '/nowhere/font.ttf', which does not exist"));
}

}  // namespace
}  // namespace scanbench::app_test
