// The script ./scanbench, with a Ninja and a CMake that only pretend.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

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
    folder_.write("CMakePresets.json", R"({"buildPresets": [
    {"name": "dev", "configurePreset": "dev"},
    {"name": "release", "configurePreset": "release"}]})");
    folder_.write("build/release/build.ninja", "");
    fs::last_write_time(folder_ / "CMakePresets.json", fs::file_time_type::clock::now() - std::chrono::hours(1));
    program("build/release/scanbench", "echo \"the program: $*\"");
  }
  void program(const std::string& name, const std::string& text) {
    folder_.write(name, "#!/bin/bash\n" + text + "\n");
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  Outcome call(const Args& args, const std::string& preset = "release") {
    Args all{"/bin/bash", (folder_ / "scanbench").string()};
    all.insert(all.end(), args.begin(), args.end());
    const std::string path = (folder_ / "bin").string() + ":" + std::getenv("PATH");
    return Child(all, {{"PATH", path}, {"SCANBENCH_PRESET", preset}}, folder_.path()).wait();
  }
  Folder folder_;
};

TEST_F(Script, SaysWhatItBuildsHowFarItIsAndHowLongItTook) {
  std::string text = read(folder_ / "scanbench");
  const std::string interval = "every=30";
  ASSERT_NE(text.find(interval), std::string::npos);
  folder_.write("scanbench", text.replace(text.find(interval), interval.size(), "every=0"));
  program("bin/ninja", R"(
case " $* " in
  *" build.ninja "*) ;;
  *) for i in {1..40}; do echo "[$i/40] Building CXX object $i.o"; [[ $i != 20 ]] || sleep 1.1; done ;;
esac)");
  const auto outcome = call({"list"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the program: list"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("building (release): 40 steps with "), HasSubstr("built in ")));
  // A second or two for 30 steps: a third of that for the other ten.
  EXPECT_THAT(outcome.err, HasSubstr("built 30 of 40; about 0 s left"));
}

TEST_F(Script, SaysHowLongTheRestTakesIfItIsLikeWhatIsDone) {
  std::string text = read(folder_ / "scanbench");
  const std::size_t begin = text.find("say_progress() {"), end = text.find("\n}\n", begin);
  ASSERT_NE(end, std::string::npos);
  // As if the build had begun 100 s ago.
  folder_.write("progress", "say() { echo \"$*\"; }\nduration() { echo \"$1 s\"; }\n" +
                                text.substr(begin, end - begin + 3) + "SECONDS=100; say_progress 0 2\n");
  const auto outcome =
      Child({"/bin/bash", "-c", "printf '[25/100] Building a.o\\n' | bash progress"}, {}, folder_.path()).wait();
  EXPECT_THAT(outcome.out, HasSubstr("built 25 of 100; about 300 s left")) << outcome.err;
}

TEST_F(Script, NamesThePackagesThatAreMissingAndCannotBeInstalled) {
  folder_.write("cmake/packages.txt", "# a list\ncmake  # builds\nno-such-package\n");
  program("bin/dpkg-query", "echo 'install ok installed cmake'; exit 1");
  program("bin/apt-get", "echo 'Could not resolve host'; exit 100");
  program("bin/sudo", "exec \"$@\"");
  program("bin/ninja", "");
  const auto outcome = call({"list"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("installing packages: no-such-package\n"), HasSubstr("Could not resolve host"),
                    HasSubstr("missing and could not be installed: no-such-package\n")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("the program")));
}

TEST_F(Script, InstallsThePackagesOfTheTestsWithTheTestsOnly) {
  folder_.write("tests/packages.txt", "of-the-tests\n");
  program("bin/dpkg-query", "exit 1");
  program("bin/apt-get", "exit 100");
  program("bin/sudo", "exec \"$@\"");
  program("bin/ninja", "");
  EXPECT_EQ(call({"list"}).code, 0);
  const auto outcome = call({"test"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("could not be installed: of-the-tests"));
}

TEST_F(Script, RefusesAPresetThatDoesNotExist) {
  const auto outcome = call({"list"}, "fast");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("SCANBENCH_PRESET is 'fast'; CMakePresets.json has: dev release"));
}

TEST_F(Script, TakesAPresetForANameAndNotForAPattern) {
  for (const std::string pattern : {"r.*", "rel[e]ase", "release\", \"x"}) {
    const auto outcome = call({"list"}, pattern);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("SCANBENCH_PRESET is '" + pattern + "'"));
  }
}

TEST_F(Script, NoticesAPackageThatWasRemovedAndLeavesOneOnHoldAlone) {
  folder_.write("cmake/packages.txt", "cmake\nninja-build\n");
  program("bin/ninja", "");
  program("bin/sudo", "exec \"$@\"");
  program("bin/apt-get", "echo \"$*\" >>calls");
  program("bin/dpkg-query", "echo 'hold ok installed cmake'; echo 'install ok installed ninja-build'");
  EXPECT_EQ(call({"list"}).err, "");
  program("bin/dpkg-query", "echo 'hold ok installed cmake'; echo 'deinstall ok config-files ninja-build'");
  EXPECT_THAT(call({"list"}).err, HasSubstr("installing packages: ninja-build\n"));
  EXPECT_THAT(read(folder_ / "calls"), HasSubstr("install -y --no-install-recommends ninja-build\n"));
}

TEST_F(Script, BuildsWithAsManyJobsAsTheMemoryAllows) {
  const std::string script = read(folder_ / "scanbench");
  const auto jobs = [&](const std::string& machine_kib, const std::string& container) {
    std::string text = script.substr(script.find("jobs_for_memory() {"));
    text = text.substr(0, text.find("\n}\n") + 3);
    text.replace(text.find("/proc/meminfo"), 13, "meminfo");
    text.replace(text.find("/sys/fs/cgroup"), 14, "groups");
    folder_.write("meminfo", "MemTotal: 99999999 kB\nMemAvailable: " + machine_kib + " kB\n");
    folder_.write("groups/memory.max", container + "\n");
    folder_.write("jobs", "nproc() { echo 64; }\n" + text + "jobs_for_memory\n");
    return Child({"/bin/bash", "jobs"}, {}, folder_.path()).wait().out;
  };
  EXPECT_EQ(jobs("1600000", "max"), "1") << "a machine with 2 GB, of which one compiler takes 1.2";
  EXPECT_EQ(jobs("600000", "max"), "1");
  EXPECT_EQ(jobs("8000000", "max"), "6");
  EXPECT_EQ(jobs("500000000", "max"), "64");
  EXPECT_EQ(jobs("500000000", "4294967296"), "3") << "a container with 4 GiB";
}

TEST_F(Script, SaysThatItCannotBuildWhereItCannotWrite) {
  fs::rename(folder_ / "build", folder_ / "elsewhere");
  folder_.write("build", "a file");  // refused to root, too
  program("bin/ninja", "");
  const auto outcome = call({"list"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("cannot write to " + (folder_ / "build").string()), Not(HasSubstr("line "))));
}

TEST_F(Script, NamesAFullDisk) {
  program("bin/df", "echo Avail; case $* in *target*) echo /full ;; *) echo 12 ;; esac");
  program("bin/ninja", "echo 'a.o: No space left on device'; exit 1");
  EXPECT_THAT(call({"list"}).err, HasSubstr("the disk is full: /full"));
  folder_.write("cmake/packages.txt", "cmake\n");
  program("bin/dpkg-query", "exit 1");
  program("bin/sudo", "exec \"$@\"");
  program("bin/apt-get", "exit 100");
  EXPECT_THAT(call({"list"}).err,
              AllOf(HasSubstr("could not be installed: cmake"), HasSubstr("the disk is full: /full")));
}

TEST_F(Script, AnInterruptWhileItWaitsForAnotherBuildEndsIt) {
  program("bin/ninja", "");
  const std::string lock = (folder_ / "build/lock").string();
  const Child other({"/bin/bash", "-c", "exec 9>" + lock + "; flock 9; touch held; sleep 20"}, {}, folder_.path());
  ASSERT_TRUE(other.wait_until([&] { return fs::exists(folder_ / "held"); }));
  const auto outcome =
      Child({"/usr/bin/env", "timeout", "-s", "INT", "1", "/bin/bash", (folder_ / "scanbench").string(), "list"},
            {{"SCANBENCH_PRESET", ""}}, folder_.path())
          .wait();
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("waiting for it"), HasSubstr("interrupted")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("the program")));
}

TEST_F(Script, WaitsForAnotherBuildInTheSameTree) {
  program("bin/ninja", "");
  const std::string lock = (folder_ / "build/lock").string();
  Child other({"/bin/bash", "-c", "exec 9>" + lock + "; flock 9; touch held; sleep 0.5"}, {}, folder_.path());
  while (!fs::exists(folder_ / "held")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const auto outcome = call({"list"});
  other.wait();
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("another build works in this tree; waiting for it"));
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

TEST_F(Script, AModuleThatDoesNotCompileIsBadInputAndAnythingElseABug) {
  folder_.write("algorithms/extract/mine.cpp", "int mine() { return; }\n");
  folder_.write(".gitignore", "build\nbin\ncalls\n");
  const auto git = [&](const std::string& command) {
    return std::system(
        ("cd " + folder_.path().string() + " && git -c user.name=a -c user.email=a@b " + command).c_str());
  };
  ASSERT_EQ(git("init -q && git add . && git rm -r -q --cached algorithms"), 0);
  ASSERT_EQ(git("commit -q -m first"), 0);
  const std::string failing = R"(
case " $* " in
  *" build.ninja "*) ;;
  *) echo "[1/1] Building CXX object mine.o"; echo "mine.cpp:1:14: error: return-statement with no value"; exit 1 ;;
esac)";
  program("bin/ninja", failing);
  const auto own = call({"list"});
  EXPECT_EQ(own.code, 2);
  EXPECT_THAT(own.err, AllOf(HasSubstr("return-statement with no value"),
                             HasSubstr("not those of the last commit: algorithms/extract/mine.cpp")));
  ASSERT_EQ(git("add algorithms && git -c user.name=a -c user.email=a@b commit -q -m second"), 0);
  EXPECT_EQ(call({"list"}).code, 70);  // the sources are those of the commit
  folder_.write("algorithms/extract/mine.cpp", "int mine() { return 1; }\n");
  program("bin/ninja", "echo 'ninja: fatal: no space left on device'; exit 1");
  EXPECT_EQ(call({"list"}).code, 70);  // not of the compiler
}

TEST_F(Script, AnInterruptWhileItLooksWhetherToBuildIsAnInterrupt) {
  program("bin/ninja", "kill -INT $PPID; sleep 0.2; exit 2");
  const auto outcome = call({"list"});
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("failed")));
}

TEST_F(Script, WritesNewModulesIntoItsOwnTree) {
  program("bin/ninja", "");
  EXPECT_EQ(call({"module", "new", "extract", "mine"}).out,
            "the program: module new extract mine --sources " + folder_.path().string() + "\n");
}

TEST_F(Script, LeavesFormerVerbsToTheProgramWhichSaysTheirNewNames) {
  program("bin/ninja", "");
  EXPECT_EQ(call({"new", "extract", "mine"}).out, "the program: new extract mine\n");
}

}  // namespace
}  // namespace scanbench::app_test
