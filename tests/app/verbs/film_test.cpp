// The verb film.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// The number of frames that an animated PNG announces; 0 for another file.
unsigned frames_of(const std::string& bytes) {
  const auto at = bytes.find("acTL");
  if (at == std::string::npos) return 0;
  unsigned frames = 0;
  for (std::size_t i = 4; i < 8; ++i) frames = 256 * frames + static_cast<unsigned char>(bytes.at(at + i));
  return frames;
}

class Film : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("room.yaml", room());
    ASSERT_EQ(here({"run", "room.yaml", "--out", "run", "-q", "--no-figures"}).code, 0);
  }
  Outcome here(const Args& args, const Env& env = {}) const { return run(args, env, folder_.path()); }

  /// A program called ffmpeg that is the only one in PATH beside those of the system.
  Env with_ffmpeg(const std::string& script) const {
    const fs::path program = folder_.write("bin/ffmpeg", "#!/bin/bash\n" + script);
    fs::permissions(program, fs::perms::owner_all);
    return {{"PATH", (folder_ / "bin").string() + ":/usr/bin:/bin"}};
  }
  Folder folder_;
};

TEST_F(Film, OfADriveHasAFrameForEachScanAndTheSameBytesEachTime) {
  const auto outcome = here({"film", "run"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string first = read(folder_ / "run/figures/room_iepf_drive.apng");
  EXPECT_EQ(frames_of(first), 5U);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Simulated with seed 1"), HasSubstr("room_iepf_drive.apng")));
  EXPECT_THAT(read(folder_ / "run/artefacts.sha256"), HasSubstr("room_iepf_drive.apng"));
  ASSERT_EQ(here({"film", "run", "-q"}).code, 0);
  EXPECT_EQ(read(folder_ / "run/figures/room_iepf_drive.apng"), first);
  ASSERT_EQ(here({"film", "run", "--frames", "3", "--out", "short"}).code, 0);
  EXPECT_EQ(frames_of(read(folder_ / "short.apng")), 3U);
}

TEST_F(Film, OfAMapShowsTheLinesOfAllScansSoFar) {
  ASSERT_EQ(here({"film", "run", "--of", "map", "--style", "dark", "--width-px", "320", "--out", "map"}).code, 0);
  EXPECT_EQ(frames_of(read(folder_ / "map.apng")), 5U);
}

TEST_F(Film, OfAnAlignmentAndOfMeanShiftComeFromTheTracesThatFiguresKeep) {
  const std::string scenarios = (places::source_dir() / "scenarios").string() + "/";
  ASSERT_EQ(here({"run", scenarios + "lakaemper2010_two_robots.yaml", "--only", "virtual_scans", "--seed", "14", "-q",
                  "--no-figures", "--out", "robots"})
                .code,
            0);
  ASSERT_EQ(here({"film", "robots", "--of", "alignment", "--out", "alignment"}).code, 0);
  EXPECT_GT(frames_of(read(folder_ / "alignment.apng")), 10U);
  ASSERT_EQ(here({"run", scenarios + "lakaemper2009_spiral.yaml", "--only", "mean_shift_020", "--seed", "1", "-q",
                  "--no-figures", "--out", "spiral"})
                .code,
            0);
  const auto climb = here({"film", "spiral", "--of", "mean_shift", "--out", "climb"});
  ASSERT_EQ(climb.code, 0) << climb.err;
  EXPECT_GT(frames_of(read(folder_ / "climb.apng")), 5U);
}

TEST_F(Film, WithoutItsTraceSaysHowToKeepIt) {
  const auto outcome = here({"film", "run", "--of", "mean_shift"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("`scanbench run run/effective.yaml --trace --out room_trace`"));
  EXPECT_THAT(here({"film", "run", "--of", "map", "--pipeline", "iefp"}).err, HasSubstr("did you mean 'iepf'?"));
  EXPECT_THAT(here({"film", "run", "--of", "drvie"}).err, HasSubstr("did you mean 'drive'?"));
  EXPECT_THAT(here({"film", "run", "--fps", "0"}).err, HasSubstr("allowed: a whole number 1 .. 60"));
}

TEST_F(Film, WithoutFfmpegSaysWhatToInstallAndWritesNothing) {
  const auto outcome = here({"film", "run", "--format", "apng,mp4", "--out", "drive"}, {{"PATH", "/nowhere"}});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("install ffmpeg"), HasSubstr("--format apng")));
  EXPECT_FALSE(fs::exists(folder_ / "drive.apng"));
}

TEST_F(Film, GivesFfmpegEveryPixelOfEveryFrame) {
  const Env env = with_ffmpeg("for out; do :; done\ncat > \"$out\"\n");  // the film is what it reads
  const auto outcome = here({"film", "run", "--format", "mp4", "--width-px", "320", "--out", "drive"}, env);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(fs::file_size(folder_ / "drive.mp4"), 5U * 320U * 240U * 3U);
  EXPECT_THAT(half_written(folder_.path()), IsEmpty());
}

TEST_F(Film, HasTheFormatThatTheEndingOfItsFileNames) {
  const Env env = with_ffmpeg("for out; do :; done\ncat > \"$out\"\n");
  ASSERT_EQ(here({"film", "run", "--width-px", "320", "--out", "a.mp4"}, env).code, 0);
  ASSERT_EQ(here({"film", "run", "--width-px", "320", "--out", "b.apng"}, env).code, 0);
  ASSERT_EQ(here({"film", "run", "--width-px", "320", "--format", "apng,mp4", "--out", "c.mp4"}, env).code, 0);
  for (const char* file : {"a.mp4", "b.apng", "c.mp4", "c.apng"}) EXPECT_TRUE(fs::exists(folder_ / file)) << file;
  for (const char* file : {"a.apng", "a.mp4.apng", "b.mp4"}) EXPECT_FALSE(fs::exists(folder_ / file)) << file;
  const auto outcome = here({"film", "run", "--format", "mp4", "--out", "d.apng"}, env);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("d.apng names another format than --format mp4"));
}

TEST_F(Film, RefusesOtherFormatsFoldersAndScenarioFiles) {
  EXPECT_THAT(here({"film", "run", "--out", "a.gif"}).err, HasSubstr("a.gif: films are .apng or .mp4"));
  EXPECT_THAT(here({"film", "run", "--out", "run"}).err, HasSubstr("--out run: a folder"));
  folder_.write("scene.yaml", room());
  EXPECT_THAT(here({"film", "scene.yaml"}).err, HasSubstr("scene.yaml: a file, not a run folder"));
}

TEST_F(Film, ThatFfmpegBreaksOffLeavesNoFile) {
  const std::string half = "for out; do :; done\nhead -c 300000 > \"$out\"\necho 'the encoder broke' >&2\nexit 1\n";
  const std::string end = "for out; do :; done\ncat > \"$out\"\necho 'no space left' >&2\nexit 1\n";
  for (const auto& [script, words] : {std::pair(half, "the encoder broke"), std::pair(end, "no space left")}) {
    const auto outcome = here({"film", "run", "--format", "mp4", "--out", "drive"}, with_ffmpeg(script));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("drive.mp4: ffmpeg failed"), HasSubstr(words)));
    EXPECT_FALSE(fs::exists(folder_ / "drive.mp4"));
    EXPECT_THAT(half_written(folder_.path()), IsEmpty());
  }
}

}  // namespace
}  // namespace scanbench::app_test
