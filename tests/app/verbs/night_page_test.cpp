// The page of a night: its first sentence, and the pictures of what became worse.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Column f1 of a cell's scans.csv.
std::vector<double> f1_by_scan(const fs::path& cell) {
  std::istringstream lines(read(cell / "scans.csv"));
  std::string line;
  std::getline(lines, line);
  std::vector<double> values;
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    std::string field;
    for (int column = 0; column < 7; ++column) std::getline(row, field, ',');
    values.push_back(std::stod(field));
  }
  return values;
}

/// The scan whose F1 fell by most; of several the first.
std::size_t most_fallen(const std::vector<double>& before, const std::vector<double>& now) {
  std::size_t most = 0;
  for (std::size_t f = 0; f < before.size(); ++f)
    if (before[f] - now[f] > before[most] - now[most]) most = f;
  return most;
}

/// A night with one pipeline on four seeds.
class NightPage : public testing::Test {
 protected:
  void SetUp() override {
    // Noise of 15 cm makes the scans unlike each other. With the worse threshold all have an F1 of zero, so the lowest
    // F1 does not say which of them changed.
    std::string noisy = room_with("figures: [environment]", "figures: [scan_overlay]");
    folder_.write("room.yaml",
                  noisy.replace(noisy.find("{preset: sick_lms200}"), 21, "{preset: sick_lms200, sigma_m: 0.15}"));
    folder_.write("suite.yaml", "schema: 1\nscenarios: [room.yaml]\nseeds: {first: 1, count: 4}\n");
    ASSERT_EQ(night().code, 0);
  }
  Outcome night(const Args& more = {}) const {
    Args args{"night", "run", "suite.yaml", "--store", "nights.sqlite"};
    args.insert(args.end(), more.begin(), more.end());
    return run(args, {}, folder_.path());
  }
  std::string page() const { return read(folder_ / "out/nightly/suite/nightly.html"); }
  fs::path cell(const char* run, const std::string& seed) const {
    return folder_ / ("out/nightly/suite" + std::string(run) + "/cells/room/iepf/" + seed);
  }

  const Args worsened_ = {"--set", "pipelines.iepf.extract.params.threshold_m=0.02"};
  Folder folder_;
};

TEST_F(NightPage, ShowsTheScanThatFellByMostWithBothValues) {
  ASSERT_EQ(night(worsened_).code, 1);
  const std::string html = page(), before = "iepf in room, seed ";
  const auto at = html.find(before);
  ASSERT_NE(at, std::string::npos);
  const std::string seed = html.substr(at + before.size(), 1);
  const std::vector<double> earlier = f1_by_scan(cell(".last_good", seed)), now = f1_by_scan(cell("", seed));
  const std::size_t scan = most_fallen(earlier, now);
  EXPECT_THAT(html, HasSubstr(fmt::format("seed {}: f1 of scan {} fell from {:.4g} to {:.4g}", seed, scan,
                                          earlier[scan], now[scan])));
  EXPECT_THAT(html, AllOf(HasSubstr(fmt::format(" UTC): f1 {:.4g}; ", earlier[scan])),
                          HasSubstr(fmt::format("now: f1 {:.4g}; ", now[scan]))));
  EXPECT_THAT(html, HasSubstr(fmt::format("scans.html#room/iepf/{}/{}", seed, scan)));
  EXPECT_TRUE(fs::exists(folder_ / "out/nightly/suite/scans.html"));
}

TEST_F(NightPage, DrawsAFigureThatChoosesItsScanOfTheSameScanTwice) {
  ASSERT_EQ(night(worsened_).code, 1);
  const std::string html = page();
  const std::size_t scan = most_fallen(f1_by_scan(cell(".last_good", "1")), f1_by_scan(cell("", "1")));
  const std::string caption = fmt::format("Room: the points of scan {}, and the lines", scan);
  EXPECT_THAT(html, AllOf(HasSubstr(" UTC): " + caption), HasSubstr("now: " + caption)));
  EXPECT_THAT(html, Not(HasSubstr("the median scan")));
}

TEST_F(NightPage, AnswersInItsFirstSentenceAndShowsFailedCellsOncePerPipelineBeforeAnythingElse) {
  Args stopped = worsened_;  // else nothing would be run again
  stopped.insert(stopped.end(), {"--set", "limits.seconds=0.000001"});
  ASSERT_EQ(night(stopped).code, 1);
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("verdict bad\">FAIL: 4 cells are no longer ok.</p>"));
  EXPECT_LT(html.find("id=\"cells-section\""), html.find("id=\"worse-section\""));
  EXPECT_THAT(html, HasSubstr("4 seeds, first 1"));
  EXPECT_THAT(html, Not(HasSubstr(">Nothing.<")));
}

}  // namespace
}  // namespace scanbench::app_test
