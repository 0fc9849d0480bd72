// Films of a run as files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/output_style.hpp"

namespace scanbench::results {

struct FilmOptions {
  std::string of = "drive";                  ///< a name of Registry<render::FilmKind>
  std::string scenario{};                    ///< empty: the run's only one
  std::string pipeline{};                    ///< empty: the first that ended well and has such a film
  std::vector<std::string> formats{"apng"};  ///< apng, mp4
  std::optional<std::uint16_t> fps{};        ///< none: 10, or fewer if the film has few frames (frames_per_second)
  std::size_t frames = 200;                  ///< at most
  int width_px = 640;
  render::Theme theme = render::Theme::paper;
  std::filesystem::path out{};  ///< with or without ending; empty: RUN/figures/<scenario>_<pipeline>_<of>
};

struct FilmFiles {
  std::vector<std::filesystem::path> files;
  std::string caption;
  std::size_t frames = 0;
};

/// Draws a film of the first seed and writes it in every format; each file appears whole or not at all. Throws
/// ConfigError for a scenario, pipeline or kind that the run does not have, for a trace that it has not kept, and if
/// ffmpeg is needed and missing or fails.
FilmFiles make_film(const std::filesystem::path& run, const FilmOptions& options,
                    const std::function<void(double, const std::string&)>& progress = {});

}  // namespace scanbench::results
