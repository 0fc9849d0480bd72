// show: the scan that broke is found and drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

struct ScanRow {
  int frame;
  double f1;
  int faults;  ///< false, missed and split lines
};

std::vector<ScanRow> scan_rows(const fs::path& file) {
  std::istringstream in(read(file));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "frame,true,false,missed,split,merged,f1,residual_m,small");
  std::vector<ScanRow> rows;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::vector<std::string> words;
    for (std::string word; std::getline(fields, word, ',');) words.push_back(word);
    rows.push_back({std::stoi(words.at(0)), std::stod(words.at(6)),
                    std::stoi(words.at(2)) + std::stoi(words.at(3)) + std::stoi(words.at(4))});
  }
  return rows;
}

class Show : public testing::Test {
 protected:
  void SetUp() override {
    // Two metres of threshold cut every corner off: walls are missed.
    folder_.write("room.yaml", room());
    ASSERT_EQ(here({"run", "room.yaml", "--out", "run", "-q", "--no-figures", "--set",
                    "pipelines.iepf.extract.params.threshold_m=2"})
                  .code,
              0);
  }
  Outcome here(const Args& args) const { return run(args, {}, folder_.path()); }
  Folder folder_;
};

TEST_F(Show, DrawsTheScanWithTheLowestF1AndPrintsThePath) {
  const auto rows = scan_rows(folder_ / "run/cells/room/iepf/1/scans.csv");
  ASSERT_EQ(rows.size(), 5U);
  ScanRow worst{-1, std::numeric_limits<double>::infinity(), 0};
  for (const ScanRow& row : rows)
    if (row.f1 < worst.f1 || (row.f1 == worst.f1 && row.faults > worst.faults)) worst = row;
  ASSERT_LT(worst.f1, 1.0);
  const auto outcome = here({"show", "run", "--pipeline", "iepf", "--frame", "worst"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string path = "run/figures/room_iepf_1_scan_" + std::to_string(worst.frame) + ".png";
  EXPECT_THAT(outcome.out, AllOf(HasSubstr(path + "\n"), HasSubstr("missed"), HasSubstr("F1")));
  EXPECT_THAT(read(folder_ / path), StartsWith("\x89PNG"));
  EXPECT_THAT(read(folder_ / "run/artefacts.sha256"), HasSubstr(path.substr(4)));
}

TEST_F(Show, DrawsANumberedScanToAChosenFileAndLeavesTheRunAsItIs) {
  const auto before = files(folder_ / "run");
  for (const std::string file : {"one.png", "one.svg", "one.pdf"}) {
    const auto outcome = here({"show", "run", "--frame", "3", "--out", file});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(read(folder_ / file).empty());
  }
  EXPECT_THAT(read(folder_ / "one.svg"), HasSubstr("<svg"));
  EXPECT_EQ(files(folder_ / "run"), before);
}

TEST_F(Show, HasTheLookOfFigures) {
  const auto drawn = [&](const std::string& file, const Args& more) {
    Args args{"show", "run", "--frame", "3", "--out", file};
    args.insert(args.end(), more.begin(), more.end());
    const auto outcome = here(args);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read(folder_ / file);
  };
  const std::string narrow = drawn("narrow.png", {"--width-mm", "84", "--dpi", "300"});
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(narrow.at(i)); };
  EXPECT_EQ(byte(18) * 256 + byte(19), 992);  // the width in IHDR: 84 / 25.4 * 300 = 992.1
  const std::string plain = drawn("plain.svg", {});
  EXPECT_EQ(drawn("paper.svg", {"--style", "paper"}), plain);
  EXPECT_NE(drawn("dark.svg", {"--style", "dark"}), plain);
}

TEST_F(Show, RefusesWhatTheRunDoesNotHave) {
  const auto refused = [&](const Args& more, const std::string& message) {
    Args args{"show", "run"};
    args.insert(args.end(), more.begin(), more.end());
    const auto outcome = here(args);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(message));
  };
  refused({"--pipeline", "iefp"}, "did you mean 'iepf'?");
  refused({"--frame", "5"}, "allowed: 0 to 4, or worst");
  refused({"--frame", "-1"}, "allowed: 0 to 4, or worst");
  refused({"--frame", "1e1"}, "allowed: 0 to 4, or worst");
  refused({"--seed", "9"}, "room/iepf/9 is missing");
  refused({"--seed", "1-2"}, "show draws one scan of one seed, and 2 are given");
  refused({"--scenario", "rom"}, "did you mean 'room'?");
  refused({"--out", "x.jpg"}, "ends in .png, .svg or .pdf");
  fs::remove(folder_ / "run/cells/room/iepf/1/scans.csv");
  refused({"--frame", "worst"}, "`segments` writes it");
}

TEST_F(Show, AsksForAPipelineIfTheRunHasTwo) {
  folder_.write("two.yaml", room_with("metrics:", "  - {name: other, extract: {module: sef}}\nmetrics:"));
  ASSERT_EQ(here({"run", "two.yaml", "--out", "two", "-q", "--no-figures"}).code, 0);
  const auto outcome = here({"show", "two"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("two has 2 pipelines; --pipeline must name one of them: iepf, other"));
  EXPECT_EQ(here({"show", "two", "--pipeline", "other"}).code, 0);
}

}  // namespace
}  // namespace scanbench::app_test
