// report --scans: the page that plays the scans of a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "tests/app/browser.hpp"
#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Player : public testing::Test {
 protected:
  void SetUp() override {
    // A threshold of half a metre rounds off corners in some scans only.
    folder_.write("room.yaml",
                  room_with("metrics:",
                            "  - {name: coarse, extract: {module: iepf, params: {threshold_m: 0.5, "
                            "min_points: 2}}}\nmetrics:")
                      .replace(room().find("{preset: sick_lms200}"), 21, "{preset: sick_lms200, sigma_m: 0.15}"));
    ASSERT_EQ(here({"run", "room.yaml", "--out", "run", "-q", "--no-figures"}).code, 0);
  }
  Outcome here(const Args& args) const { return run(args, {}, folder_.path()); }
  Folder folder_;
};

/// The scans of scans.csv, lowest F1 first, of equal ones that with most false, missed and split lines, then the first.
std::string from_worst_to_best(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  std::vector<std::tuple<double, int, int>> scans;  // F1, faults as a negative number, scan
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    std::string fields[7];
    for (std::string& field : fields) std::getline(row, field, ',');
    const int faults = std::stoi(fields[2]) + std::stoi(fields[3]) + std::stoi(fields[4]);
    scans.emplace_back(std::stod(fields[6]), -faults, std::stoi(fields[0]));
  }
  std::ranges::sort(scans);
  std::string order;
  for (const auto& [f1, faults, scan] : scans) order += std::to_string(scan) + " ";
  return order;
}

TEST_F(Player, IsAPageOfItsOwnThatTheManifestLists) {
  const auto outcome = here({"report", "run", "--scans"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("run/scans.html"));
  const std::string page = read(folder_ / "run/scans.html");
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(page, HasSubstr("at most 2000 scans"));
  EXPECT_THAT(read(folder_ / "run/artefacts.sha256"), HasSubstr("scans.html"));
  ASSERT_EQ(here({"report", "run", "--scans"}).code, 0);
  EXPECT_EQ(read(folder_ / "run/scans.html"), page);
}

TEST_F(Player, KeysAndTheSliderGoThroughTheScansAndNothingIsRequested) {
  if (!has_browser()) GTEST_SKIP() << "chromium is not installed";
  ASSERT_EQ(here({"report", "run", "--scans"}).code, 0);
  const std::string title = title_after(folder_ / "run/scans.html", R"js(
    const press = key => document.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
    const scan = () => document.getElementById('what').textContent.split(' ')[1];
    const seen = [scan()];
    for (const key of ['ArrowRight', 'ArrowRight', 'ArrowLeft', 'End', 'ArrowRight', 'Home']) { press(key); seen.push(scan()); }
    const slider = document.getElementById('scan');
    slider.value = 3; slider.dispatchEvent(new Event('input')); seen.push(scan());
    const c = document.getElementById('view'), pixels = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
    let drawn = 0; for (let k = 3; k < pixels.length; k += 4) drawn += pixels[k] > 0;
    seen.push('rows', document.querySelectorAll('#facts tbody tr').length);
    document.title = seen.join(' ') + (drawn > 1000 ? ' drawn ' : ' blank ') +
        performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:')).length;
  )js",
                                        folder_);
  EXPECT_EQ(title, "0 1 2 1 4 4 0 3 rows 2 drawn 0");
}

TEST_F(Player, SortsTheScansByTheF1OfAPipeline) {
  if (!has_browser()) GTEST_SKIP() << "chromium is not installed";
  ASSERT_EQ(here({"report", "run", "--scans"}).code, 0);
  const std::string title = title_after(folder_ / "run/scans.html", R"js(
    const order = document.getElementById('order'), seen = [];
    order.value = 'error of coarse'; order.dispatchEvent(new Event('change'));
    for (let k = 0; k < 5; ++k) {
      seen.push(document.getElementById('what').textContent.split(' ')[1] + ' ');
      document.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', bubbles: true}));
    }
    document.title = seen.join('') + '|';
  )js",
                                        folder_);
  const std::string expected = from_worst_to_best(read(folder_ / "run/cells/room/coarse/1/scans.csv"));
  EXPECT_NE(expected, "0 1 2 3 4 ") << "a page that does not sort would pass";
  EXPECT_EQ(title, expected + "|");
}

TEST_F(Player, GoesToTheScanOfItsAddressAndOfItsNumber) {
  if (!has_browser()) GTEST_SKIP() << "chromium is not installed";
  ASSERT_EQ(here({"report", "run", "--scans"}).code, 0);
  const std::string title = title_after(folder_ / "run/scans.html", R"js(
    const what = () => document.getElementById('what').textContent, scan = () => what().split(' ')[1];
    const boxes = () => [...document.querySelectorAll('#methods input')].map(box => +box.checked).join('');
    const open = hash => { location.hash = hash; window.dispatchEvent(new HashChangeEvent('hashchange')); };
    const number = document.getElementById('number'), seen = [scan(), boxes()];
    open('#room/coarse/1/3'); seen.push(scan(), boxes(), location.hash);
    number.value = 2; number.dispatchEvent(new Event('change')); seen.push(scan(), location.hash);
    open('#room/4'); seen.push(scan(), boxes(), location.hash);
    open('#room/iepf/77/1'); seen.push(scan(), what().includes('does not hold seed 77'));
    number.value = 900; number.dispatchEvent(new Event('change')); seen.push(scan(), what().includes('no scan 900'));
    document.title = seen.join(' ');
  )js",
                                        folder_);
  EXPECT_EQ(title, "0 11 3 01 #room/coarse/1/3 2 #room/coarse/1/2 4 11 #room/4 1 true 4 true");
}

TEST_F(Player, DrawsTrueWallsAsALayerAndItsPictureAboveTheControls) {
  if (!has_browser()) GTEST_SKIP() << "chromium is not installed";
  ASSERT_EQ(here({"report", "run", "--scans"}).code, 0);
  const std::string title = title_after(folder_ / "run/scans.html", R"js(
    const canvas = document.getElementById('view'), truth = document.getElementById('truth');
    const drawn = () => { const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
      let count = 0; for (let k = 3; k < pixels.length; k += 4) count += pixels[k] > 0; return count; };
    const all = [truth.checked, drawn()];
    truth.click();
    const above = ['recording', 'order', 'play', 'number', 'methods'].every(id =>
      document.getElementById(id).getBoundingClientRect().top >= canvas.getBoundingClientRect().bottom);
    document.title = [all[0], drawn() < all[1], above, document.getElementById('key').textContent.includes('true wall')].join(' ');
  )js",
                                        folder_);
  EXPECT_EQ(title, "true true true false");
}

TEST_F(Player, HoldsAllSeedsOfARunThatFits) {
  ASSERT_EQ(here({"run", "room.yaml", "--seed", "5,3", "--out", "two", "-q", "--no-figures"}).code, 0);
  ASSERT_EQ(here({"report", "two", "--scans"}).code, 0);
  const std::string page = read(folder_ / "two/scans.html");
  EXPECT_THAT(page, HasSubstr(R"("seed":"5")"));
  EXPECT_THAT(page, HasSubstr(R"("seed":"3")"));
}

TEST_F(Player, OfARunWithoutScansIsRefused) {
  ASSERT_EQ(here({"simulate", "room.yaml", "--out", "recordings"}).code, 0);
  const auto outcome = here({"report", "recordings", "--scans"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no scans with lines to play"));
}

}  // namespace
}  // namespace scanbench::app_test
