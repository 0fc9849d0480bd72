// MP4 films through the program ffmpeg, if it is installed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "harness/io/files/descriptor.hpp"
#include "harness/io/process/child.hpp"

namespace scanbench::results {

/// The program in PATH. Throws ConfigError, which names the package to install, if there is none.
std::filesystem::path find_ffmpeg();

/// Frames go through a pipe to ffmpeg, which writes a temporary file beside the target. finish() renames it; without
/// finish(), or if ffmpeg fails, it is removed.
class FfmpegPipe {
 public:
  FfmpegPipe(const std::filesystem::path& ffmpeg, std::filesystem::path target, int width, int height, int fps);
  ~FfmpegPipe();
  FfmpegPipe(const FfmpegPipe&) = delete;
  FfmpegPipe& operator=(const FfmpegPipe&) = delete;

  /// One frame of width x height x 3 bytes. Throws ConfigError, with what ffmpeg said last, if it has ended.
  void add(std::span<const std::uint8_t> rgb);
  /// Throws ConfigError if ffmpeg fails.
  void finish();

 private:
  [[noreturn]] void fail();

  std::filesystem::path target_, staged_, log_;
  io::Child child_;
  io::FileDescriptor frames_;
};

}  // namespace scanbench::results
