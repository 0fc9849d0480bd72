// Starts ffmpeg with a pipe as its standard input and a file for its messages.
#include "harness/results/film/ffmpeg.hpp"

#include <fcntl.h>
#include <fmt/format.h>
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
#include "harness/io/files/atomic_file.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

constexpr double kFfmpegSeconds = 60.0;  // to end after SIGTERM

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
  std::istringstream lines(io::read_file(log));
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return last;
}

/// Writes a finished file to the disk before it gets its name.
void flush(const fs::path& file) {
  const io::FileDescriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!descriptor.is_open() || ::fsync(descriptor.number()) != 0)
    throw ConfigError(file.string() + ": cannot write: " + std::generic_category().message(errno));
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
  try {
    io::Pipe frames = io::make_pipe();
    const io::FileDescriptor log(::open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!log.is_open()) throw std::system_error(errno, std::generic_category());
    child_ = io::start_program(arguments(ffmpeg, staged_, width, height, fps), {.input = frames.read_end.number(),
                                                                                .output = io::kNullDevice,
                                                                                .errors = log.number(),
                                                                                .dies_with_parent = false});
    frames_ = std::move(frames.write_end);
  } catch (const std::system_error& error) {
    std::error_code ignored;
    fs::remove(log_, ignored);
    throw ConfigError(ffmpeg.string() + ": cannot be started: " + error.code().message());
  }
}

FfmpegPipe::~FfmpegPipe() {
  frames_.close();
  child_.stop(kFfmpegSeconds);
  std::error_code ignored;
  fs::remove(staged_, ignored);
  fs::remove(log_, ignored);
}

void FfmpegPipe::add(std::span<const std::uint8_t> rgb) {
  const WithoutSigpipe guard;
  if (!io::write_all(frames_.number(), std::as_bytes(rgb))) fail();
}

void FfmpegPipe::finish() {
  frames_.close();
  if (!child_.reap().is_success() || !fs::exists(staged_)) fail();
  flush(staged_);
  std::error_code error;
  fs::rename(staged_, target_, error);
  if (error) throw ConfigError(target_.string() + ": cannot write: " + error.message());
  io::flush_folder(fs::absolute(target_).parent_path());
}

void FfmpegPipe::fail() {
  frames_.close();
  child_.reap();
  const std::string said = last_line(log_);
  throw ConfigError(target_.string() + ": ffmpeg failed, and there is no film" + (said.empty() ? "" : ": " + said));
}

}  // namespace scanbench::results
