// alignment: errors of poses after the common motion, by hand.
#include "made_up.hpp"

namespace scanbench::test {
namespace {

MadeUpRun run_with(const std::vector<Pose2>& truth, const std::vector<Pose2>& estimated) {
  MadeUpRun run = make_run(ScanGeometry(0, 0.1, 0), {});
  for (const Pose2& p : truth) add_frame(run, p, {}, {});
  run.result.world_from_sensor = estimated;
  return run;
}

const std::vector<Pose2> kTruth{{0, 0, 0}, {2, 0, 1}, {2, 2, 2}, {0, 2, -3}};

TEST(Alignment, OfAMovedCopyHasNoError) {
  std::vector<Pose2> moved;
  for (const Pose2& p : kTruth) moved.push_back(Pose2(7, -3, 2.5) * p);
  const auto rows = evaluate("alignment", run_with(kTruth, moved));
  for (const char* metric : {"position_error", "position_error_max", "heading_error", "heading_error_max"})
    EXPECT_NEAR(row(rows, metric).value, 0.0, 1e-6) << metric;
  EXPECT_EQ(row(rows, "placed").value, 1.0);
  EXPECT_EQ(row(rows, "all_placed").value, 1.0);
}

TEST(Alignment, OfHeadingsThatErrInTurnsIsTheirSize) {
  // The errors cancel in the common motion.
  std::vector<Pose2> turned = kTruth;
  for (std::size_t k = 0; k < 4; ++k) turned[k] = turned[k] * Pose2(0, 0, k % 2 == 0 ? 0.05 : -0.05);
  const auto rows = evaluate("alignment", run_with(kTruth, turned));
  EXPECT_NEAR(row(rows, "position_error").value, 0.0, 1e-9);
  EXPECT_NEAR(row(rows, "heading_error").value, degrees(0.05), 1e-9);
  EXPECT_NEAR(row(rows, "heading_error_max").value, degrees(0.05), 1e-9);
  EXPECT_EQ(row(rows, "placed").value, 0.0) << "beyond 2 degrees";
}

TEST(Alignment, OfASquareStretchedAboutItsMiddleIsHowFarItsCornersWent) {
  std::vector<Pose2> stretched;
  for (const Pose2& p : kTruth) {
    const Vec2 at = Vec2(1, 1) + 1.1 * (p.translation() - Vec2(1, 1));
    stretched.push_back(Pose2::from_unit(at, {p.cos(), p.sin()}));
  }
  const auto rows = evaluate("alignment", run_with(kTruth, stretched));
  EXPECT_NEAR(row(rows, "position_error").value, 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(row(rows, "position_error_max").value, 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(row(rows, "placed").value, 0.0);
  EXPECT_EQ(row(rows, "start_position_error").value, 0.0) << "the recorded poses are the true ones";
  EXPECT_EQ(row(rows, "error_ratio").count, 0) << "nothing to improve";
}

TEST(Alignment, OfScansAtOnePlaceIsDefinedByTheirHeadings) {
  const std::vector<Pose2> truth{{1, 1, 0}, {1, 1, 1.5}, {1, 1, 3}};
  std::vector<Pose2> moved;
  for (const Pose2& p : truth) moved.push_back(Pose2(4, 4, -1) * p);
  EXPECT_NEAR(row(evaluate("alignment", run_with(truth, moved)), "heading_error").value, 0.0, 1e-6);
}

TEST(Alignment, NeedsTruthAndPoses) {
  MadeUpRun run = run_with(kTruth, kTruth);
  EXPECT_TRUE(family("alignment")->applies(run.input()));
  EXPECT_FALSE(family("alignment")->applies(run.input_without_truth()));
  run.result.world_from_sensor.pop_back();
  EXPECT_FALSE(family("alignment")->applies(run.input()));
  EXPECT_FALSE(family("alignment")->applies(MadeUpRun().input()));
}

}  // namespace
}  // namespace scanbench::test
