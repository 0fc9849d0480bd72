// The script ./scanbench, with a Ninja and a CMake that only pretend.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A tree with the script and a build folder, where `ninja` is the given script.
class Script : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(places::source_dir() / "scanbench", folder_ / "scanbench");
    folder_.write("cmake/packages.txt", "");
    folder_.write("CMakePresets.json", "{}");
    folder_.write("build/release/build.ninja", "");
    folder_.write("build/packages.stamp", "");
    fs::last_write_time(folder_ / "cmake/packages.txt", fs::file_time_type::clock::now() - std::chrono::hours(1));
    fs::last_write_time(folder_ / "CMakePresets.json", fs::file_time_type::clock::now() - std::chrono::hours(1));
    program("build/release/scanbench", "echo \"the program: $*\"");
  }
  void program(const std::string& name, const std::string& text) {
    folder_.write(name, "#!/bin/bash\n" + text + "\n");
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  Outcome call(const Args& args) {
    Args all{"/bin/bash", (folder_ / "scanbench").string()};
    all.insert(all.end(), args.begin(), args.end());
    const std::string path = (folder_ / "bin").string() + ":" + std::getenv("PATH");
    return Child(all, {{"PATH", path}, {"SCANBENCH_PRESET", "release"}}, folder_.path()).wait();
  }
  Folder folder_;
};

TEST_F(Script, SaysWhatItBuildsHowFarItIsAndHowLongItTook) {
  program("bin/ninja", R"(
case " $* " in
  *" build.ninja "*) ;;
  *" -n "*) echo "[1/2] Re-running CMake..." ;;  # a dry run sees no further
  *) for i in {1..40}; do echo "[$i/40] Building CXX object $i.o"; done ;;
esac)");
  const auto outcome = call({"list"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the program: list"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("building (release): 40 steps"), HasSubstr("built 20 of 40 after"),
                                 HasSubstr("built in ")));
  const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
  EXPECT_GE(lines, 10) << outcome.err;
  EXPECT_LE(lines, 12) << outcome.err;
}

TEST_F(Script, IsSilentWhereNothingIsOutOfDate) {
  program("bin/ninja", "echo 'ninja: no work to do.'");
  const auto outcome = call({"list", "extract"});
  EXPECT_EQ(outcome.out, "the program: list extract\n");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Script, BuildsThePeersWithThePackageOfTheProgram) {
  folder_.write("peers/packages.txt", "# none\n");
  program("bin/ninja", "echo \"ninja $*\" >>calls; echo 'ninja: no work to do.'");
  program("bin/cmake", "echo \"cmake $*\" >>calls");
  const auto outcome = call({"peers"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the peers are in "));
  const std::string build = (folder_ / "build").string();
  EXPECT_THAT(read(folder_ / "calls"),
              AllOf(HasSubstr("cmake --install " + build + "/release --component modules --prefix " + build +
                              "/peers/package\ncmake -S " + (folder_ / "peers").string() + " -B " + build + "/peers"),
                    HasSubstr("-DCMAKE_PREFIX_PATH=" + build + "/peers/package\nninja -C " + build + "/peers")));
  program("bin/cmake", "echo 'find_package: no such package'; exit 1");
  const auto failed = call({"peers"});
  EXPECT_EQ(failed.code, 70);
  EXPECT_THAT(failed.err, HasSubstr("find_package: no such package"));
}

TEST_F(Script, ShowsTheEndOfTheLogOfABuildThatFails) {
  program("bin/ninja", R"(
case " $* " in
  *" build.ninja "*) ;;
  *" -n "*) echo "[1/1] Building CXX object a.o" ;;
  *) echo "[1/1] Building CXX object a.o"; echo "a.cpp:1:1: error: this is no C++"; exit 1 ;;
esac)");
  const auto outcome = call({"list"});
  EXPECT_EQ(outcome.code, 70);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("this is no C++"), HasSubstr("the build failed; the whole log is")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("the program")));
}

TEST_F(Script, AnInterruptWhileItLooksWhetherToBuildIsAnInterrupt) {
  program("bin/ninja", "kill -INT $PPID; sleep 0.2; exit 2");
  const auto outcome = call({"list"});
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("failed")));
}

TEST_F(Script, WritesNewModulesIntoItsOwnTree) {
  program("bin/ninja", "");
  EXPECT_EQ(call({"new", "extract", "mine"}).out,
            "the program: new extract mine --sources " + folder_.path().string() + "\n");
}

}  // namespace
}  // namespace scanbench::app_test
