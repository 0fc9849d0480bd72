// Starts ffmpeg with a pipe as its standard input and a file for its messages.
#include "harness/film/ffmpeg.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"

extern char** environ;  // NOLINT: the name that POSIX gives it

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;

/// A pipe whose reader has ended must be an error of write(), not the end of this program.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignore, &before_);
  }
  ~WithoutSigpipe() { sigaction(SIGPIPE, &before_, nullptr); }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  struct sigaction before_ {};
};

/// H.264 with equal bytes for equal frames: one thread, and nothing of the version or the time in the file. Sides are
/// made even, as the format demands.
std::vector<std::string> arguments(const fs::path& ffmpeg, const fs::path& out, int width, int height, int fps) {
  return {ffmpeg.string(),
          "-hide_banner",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          fmt::format("{}x{}", width, height),
          "-r",
          std::to_string(fps),
          "-i",
          "pipe:0",
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
          "-c:v",
          "libx264",
          "-preset",
          "veryfast",
          "-crf",
          "18",
          "-pix_fmt",
          "yuv420p",
          "-threads",
          "1",
          "-map_metadata",
          "-1",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-movflags",
          "+faststart",
          "-f",
          "mp4",
          out.string()};
}

std::string last_line(const fs::path& log) {
  std::error_code error;
  if (!fs::exists(log, error)) return "";
  std::istringstream lines(read_file(log));
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return last;
}

}  // namespace

fs::path find_ffmpeg() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "ffmpeg";
    if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
  }
  throw ConfigError("MP4 films need the program ffmpeg: install ffmpeg, or write --format apng, which needs nothing");
}

FfmpegPipe::FfmpegPipe(const fs::path& ffmpeg, fs::path target, int width, int height, int fps)
    : target_(std::move(target)) {
  const std::string name = fmt::format(".{}.tmp-{}", target_.filename().string(), getpid());
  staged_ = target_.parent_path() / name;
  log_ = target_.parent_path() / (name + ".log");
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw ConfigError("cannot open a pipe to ffmpeg: " + std::generic_category().message(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  std::vector<std::string> words = arguments(ffmpeg, staged_, width, height, fps);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int error = posix_spawn(&child_, ffmpeg.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (error == 0) return;
  child_ = -1;
  close_pipe();
  throw ConfigError(ffmpeg.string() + ": cannot be started: " + std::generic_category().message(error));
}

FfmpegPipe::~FfmpegPipe() {
  close_pipe();
  if (child_ > 0) {
    kill(child_, SIGTERM);
    wait();
  }
  std::error_code ignored;
  fs::remove(staged_, ignored);
  fs::remove(log_, ignored);
}

void FfmpegPipe::add(std::span<const std::uint8_t> rgb) {
  const WithoutSigpipe guard;
  while (!rgb.empty()) {
    const ssize_t n = write(pipe_, rgb.data(), rgb.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail();
    rgb = rgb.subspan(static_cast<std::size_t>(n));
  }
}

void FfmpegPipe::finish() {
  close_pipe();
  if (wait() != 0 || !fs::exists(staged_)) fail();
  std::error_code error;
  fs::rename(staged_, target_, error);
  if (error) throw ConfigError(target_.string() + ": cannot write: " + error.message());
}

void FfmpegPipe::fail() {
  close_pipe();
  wait();
  const std::string said = last_line(log_);
  throw ConfigError(target_.string() + ": ffmpeg failed, and there is no film" + (said.empty() ? "" : ": " + said));
}

void FfmpegPipe::close_pipe() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
}

int FfmpegPipe::wait() {
  int status = 0;
  if (child_ > 0)
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) continue;
  child_ = -1;
  return status;
}

}  // namespace scanbench::harness
