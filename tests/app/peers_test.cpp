// The modules of peers/, where `./scanbench peers` has built them: walls of a room, the motion between two scans of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The numbers of a table without its header; text and empty fields are NaN.
std::vector<std::vector<double>> table(const fs::path& file) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(read(file));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    auto& row = rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) {
      char* end = nullptr;
      const double value = std::strtod(field.c_str(), &end);
      row.push_back(end == field.c_str() ? std::numeric_limits<double>::quiet_NaN() : value);
    }
  }
  return rows;
}

struct Point {
  double x, y;
};

/// A point of the sensor frame in the world; the pose is x, y, yaw.
Point placed(const double* pose, double x, double y) {
  return {pose[0] + std::cos(pose[2]) * x - std::sin(pose[2]) * y,
          pose[1] + std::sin(pose[2]) * x + std::cos(pose[2]) * y};
}

class Peers : public testing::Test {
 protected:
  /// Skips the test unless this library was built for this program.
  static void need_library(const std::string& name) {
    const fs::path library = library_of(name);
    if (kSanitized) GTEST_SKIP() << "the peers are built without sanitizers";
    if (!fs::exists(library)) GTEST_SKIP() << library << " is not built; ./scanbench peers builds it";
    const auto outcome = run({"describe", "--plugin", library});
    if (outcome.err.find("was built for another scanbench") != std::string::npos) GTEST_SKIP() << outcome.err;
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  static fs::path library_of(const std::string& name) {
    return places::source_dir() / "build/peers" / ("lib" + name + ".so");
  }
  static fs::path sk_ransac() { return places::source_dir() / "peers/sklearn/sk_ransac.py"; }

  /// Six scans in a room of 10 m by 8 m, of a scanner without noise that sees at least three of its walls.
  fs::path room(const std::string& slots, const std::string& odometry, const std::string& plugin) const {
    return folder_.write("room.yaml",
                         "schema: 1\nworld:\n  segments:\n    - [a, 0, 0, 10, 0]\n    - [b, 10, 0, 10, 8]\n"
                         "    - [c, 10, 8, 0, 8]\n    - [d, 0, 8, 0, 0]\n"
                         "sensor: {preset: ladar_2d30, sigma_m: 0}\n"
                         "trajectory: {kind: waypoints, points_m: {A: [3, 3], B: [4, 4]}, scans: 6" +
                             odometry + "}\npipelines: [{name: peer, " + slots + "}]\n" +
                             (plugin.empty() ? "" : "plugins: ['" + library_of(plugin).string() + "']\n") +
                             "figures: []\n");
  }

  void expect_walls(const fs::path& scenario) const {
    const auto outcome = run({"run", scenario, "--out", folder_ / "out", "--quiet", "--no-figures"});
    ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
    const auto frames = table(folder_ / "out/recordings/room/1/frames.csv");
    ASSERT_EQ(frames.size(), 6U);
    std::set<std::pair<int, int>> seen;  // frame and wall
    for (const auto& line : table(folder_ / "out/cells/room/peer/1/lines.csv")) {
      const auto frame = static_cast<std::size_t>(line.at(0));
      const Point a = placed(&frames.at(frame).at(2), line.at(2), line.at(3));
      const Point b = placed(&frames.at(frame).at(2), line.at(4), line.at(5));
      const std::array<double, 4> off{
          std::max(std::fabs(a.y), std::fabs(b.y)), std::max(std::fabs(a.x - 10), std::fabs(b.x - 10)),
          std::max(std::fabs(a.y - 8), std::fabs(b.y - 8)), std::max(std::fabs(a.x), std::fabs(b.x))};
      const auto wall = std::ranges::min_element(off) - off.begin();
      EXPECT_LT(off.at(static_cast<std::size_t>(wall)), 0.01) << "line " << line.at(1) << " of frame " << frame;
      seen.emplace(static_cast<int>(frame), static_cast<int>(wall));
    }
    for (int frame = 0; frame < 6; ++frame)
      EXPECT_GE(std::ranges::count(seen, frame, &std::pair<int, int>::first), 3) << "walls of frame " << frame;
  }

  /// The guesses are wrong by 10 cm and 3 degrees (standard deviations). Neighbouring returns are 6 cm apart.
  void expect_motion(const std::string& module, const std::string& params) const {
    const auto scenario = room("extract: {module: iepf}, match: {module: " + module + ", params: {" + params + "}}",
                               ", odometry: {pose_position_sigma_m: 0.0707, pose_heading_sigma_deg: 2.12}", module);
    const auto outcome = run({"run", scenario, "--out", folder_ / "out", "--quiet", "--no-figures"});
    ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
    const auto frames = table(folder_ / "out/recordings/room/1/frames.csv");
    const auto poses = table(folder_ / "out/cells/room/peer/1/poses.csv");
    ASSERT_EQ(poses.size(), 6U);
    ASSERT_EQ(frames.size(), 6U);
    for (std::size_t k = 1; k < poses.size(); ++k) {
      const double* found[] = {&poses[k - 1].at(1), &poses[k].at(1)};
      const double* truth[] = {&frames[k - 1].at(2), &frames[k].at(2)};
      const double yaw = (found[1][2] - found[0][2]) - (truth[1][2] - truth[0][2]);
      EXPECT_LT(std::fabs(std::remainder(yaw, 2 * 3.14159265358979)), 0.01) << "frame " << k;
      const auto step = [](const double* const pose[2]) {  // in the frame of the first
        const double dx = pose[1][0] - pose[0][0], dy = pose[1][1] - pose[0][1], c = std::cos(pose[0][2]),
                     s = std::sin(pose[0][2]);
        return Point{c * dx + s * dy, c * dy - s * dx};
      };
      const Point f = step(found), t = step(truth);
      EXPECT_LT(std::hypot(f.x - t.x, f.y - t.y), 0.03) << "frame " << k;
    }
  }

  Folder folder_;
};

TEST_F(Peers, OpenCvFindsTheWallsOfARoom) {
  need_library("cv_hough");
  if (!IsSkipped()) expect_walls(room("extract: {module: cv_hough}", "", "cv_hough"));
}

TEST_F(Peers, ScikitLearnFindsTheWallsOfARoom) {
  const auto described = run({"describe", "--program", "/usr/bin/python3", sk_ransac()});
  if (described.err.find("./scanbench peers") != std::string::npos) GTEST_SKIP() << described.err;
  ASSERT_EQ(described.code, 0) << described.err;
  expect_walls(room("extract: {program: [/usr/bin/python3, '" + sk_ransac().string() + "']}", "", ""));
}

TEST_F(Peers, MrptFindsTheMotionBetweenScans) {
  need_library("mrpt_icp");
  if (!IsSkipped()) expect_motion("mrpt_icp", "decimation: 1");
}

TEST_F(Peers, LevenbergAndMarquardtOfMrptFindTheMotionBetweenScans) {
  need_library("mrpt_icp");
  if (!IsSkipped()) expect_motion("mrpt_icp", "algorithm: levenberg_marquardt, decimation: 1");
}

TEST_F(Peers, IcpOfPclFindsTheMotionBetweenScans) {
  need_library("pcl_icp");
  if (!IsSkipped()) expect_motion("pcl_icp", "gate_m: 0.5, max_iterations: 100, epsilon_m2: 1.0e-10");
}

TEST_F(Peers, NdtOfPclFindsTheMotionBetweenScans) {
  need_library("pcl_ndt");
  if (!IsSkipped()) expect_motion("pcl_ndt", "epsilon_m2: 1.0e-8");
}

TEST_F(Peers, SuitesAreAccepted) {
  for (const char* library : {"cv_hough", "mrpt_icp", "pcl_icp", "pcl_ndt"}) {
    need_library(library);
    if (IsSkipped()) return;
  }
  for (const char* name : {"peers.yaml", "peers_matchers.yaml"}) {
    const auto outcome = run({"check", places::source_dir() / "scenarios/suites" / name});
    if (outcome.err.find("./scanbench peers") != std::string::npos) GTEST_SKIP() << outcome.err;
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
}

TEST_F(Peers, SuitesNameTheCommandThatBuildsWhatIsMissing) {
  for (const std::string name : {"peers", "peers_matchers"}) {
    const std::string text = read(places::source_dir() / "scenarios/suites" / (name + ".yaml"));
    const auto file = folder_.write("scenarios/suites/" + name + ".yaml", text);
    for (const std::string verb : {"run", "check"}) {
      const auto outcome = run({verb, file}, {}, folder_.path());
      EXPECT_EQ(outcome.code, 2);
      EXPECT_THAT(outcome.err, AllOf(HasSubstr(name + ".yaml:"), HasSubstr("no such file: ../../build/peers/lib"),
                                     HasSubstr("; `./scanbench peers` builds it")));
    }
  }
}

}  // namespace
}  // namespace scanbench::app_test
