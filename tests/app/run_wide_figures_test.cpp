// Figures over all scenarios of a run, and rasters of lines: drawn once, and equal for any number of workers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::HasSubstr;

TEST(RunWideFigures, AreDrawnOnceForAllScenariosOfASuite) {
  const Folder folder;
  for (const char* name : {"a.yaml", "b.yaml"}) folder.write(name, room());
  folder.write("both.yaml",
               "schema: 1\nabout: two rooms\nscenarios: [a.yaml, b.yaml]\n"
               "pipelines:\n  - {name: iepf, extract: {module: iepf}}\n  - {name: em, extract: {module: em}}\n"
               "metrics: [segments, raster_truth]\nfigures: [performance_profile, difference]\n");
  ASSERT_EQ(run({"run", "both.yaml", "--out", "one", "-q", "--jobs", "1"}, {}, folder.path()).code, 0);
  const auto all = files(folder / "one");
  int profiles = 0;
  for (const auto& [name, bytes] : all) profiles += name.ends_with("performance_profile.svg") ? 1 : 0;
  EXPECT_EQ(profiles, 1);
  EXPECT_TRUE(all.contains("figures/all_performance_profile.svg"));
  EXPECT_TRUE(all.contains("figures/a_difference.png") && all.contains("figures/b_difference.png"));
  EXPECT_THAT(all.at("figures/index.json"), HasSubstr("seeds of 2 scenarios"));
  EXPECT_THAT(all.at("summary.csv"), HasSubstr(",raster_f1,all,"));

  ASSERT_EQ(run({"run", "both.yaml", "--out", "two", "-q", "--jobs", "2"}, {}, folder.path()).code, 0);
  for (const char* name : {"summary.csv", "figures/a_difference.png", "figures/all_performance_profile.png"})
    EXPECT_EQ(read(folder / "two" / name), all.at(name)) << name;
}

}  // namespace
}  // namespace scanbench::app_test
