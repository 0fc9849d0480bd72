// film: a result in motion, as an animated PNG or an MP4 film.
#include "app/verbs/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/inputs.hpp"
#include "app/options.hpp"
#include "app/terminal/progress.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/results/film/film_file.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_lock.hpp"
#include "render/film.hpp"
#include "render/output_style.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct FilmVerbOptions {
  std::string run, style = "paper";
  results::FilmOptions film;
  bool quiet = false;
  bool format_given = false;
};

/// The ending of --out chooses the format; --format and an ending must agree.
void choose_format(results::FilmOptions& film, bool format_given) {
  const std::string ending = film.out.extension().string();
  constexpr std::array<std::string_view, 6> kOthers{".avi", ".gif", ".mkv", ".mov", ".png", ".webm"};
  if (std::ranges::count(kOthers, ending) > 0)
    throw ConfigError(fmt::format("--out {}: films are .apng or .mp4", film.out.string()));
  if (fs::is_directory(film.out))
    throw ConfigError(fmt::format("--out {}: a folder; allowed: the name of a file", film.out.string()));
  if (ending != ".apng" && ending != ".mp4") return;
  const std::string named = ending.substr(1);
  if (!format_given) film.formats = {named};
  if (std::ranges::count(film.formats, named) == 0)
    throw ConfigError(fmt::format("--out {} names another format than --format {}; leave out the ending, or --format",
                                  film.out.string(), join(film.formats)));
}

int film(const FilmVerbOptions& given) {
  const fs::path run = given.run;
  check_run_exists(run);
  results::FilmOptions options = given.film;
  options.theme = render::theme_from(given.style);
  choose_format(options, given.format_given);
  // A film beside the figures of the run is one of its files: the folder is locked, and the manifest lists it.
  const bool is_in_run = options.out.empty();
  std::optional<runs::RunLock> lock;
  if (is_in_run) {
    lock.emplace(run);
    runs::refuse_linked_folders(run);
  }
  const InterruptGuard guard;
  Progress progress(progress_style(given.quiet));
  const auto made =
      results::make_film(run, options, [&](double share, const std::string& what) { progress.update(share, what); });
  progress.finish();
  if (is_in_run) runs::refresh_manifest(run);
  if (given.quiet) return kGood;
  fmt::print("{} {} frames.\n", made.caption, made.frames);
  for (const auto& file : made.files) fmt::print("{}\n", file.string());
  return kGood;
}

}  // namespace

void add_film(CommandLine& line) {
  auto options = std::make_shared<FilmVerbOptions>();
  results::FilmOptions& film_options = options->film;
  Verb verb = line.add_verb("film", "Makes a film of a run: a drive, a growing map, mean shift, an alignment");
  verb.option("RUN", options->run, "a run folder").required();
  verb.option("--of", film_options.of,
              "drive: the robot and its scans; map: a map that grows; mean_shift: points that climb to their "
              "modes; alignment: scans that are moved, with hypotheses (the last two need a run with --trace, or "
              "figures that keep these rows)")
      .one_of("film", Registry<render::FilmKind>::names())
      .shows_default();
  verb.option("--scenario", film_options.scenario, "of which scenario (not needed if the run has one)");
  verb.option("--pipeline", film_options.pipeline, "of which pipeline (default: the first that has such a film)");
  const Option format =
      verb.option("--format", film_options.formats, "files to write, separated by commas; mp4 needs the program ffmpeg")
          .separated_by_commas()
          .one_of("format", {"apng", "mp4"})
          .shows_default();
  verb.option("--fps", film_options.fps, "frames per second (default: 10, fewer for a film of few frames)")
      .whole_number("number of frames per second", 1, 60);
  verb.option("--frames", film_options.frames, "most frames; of more steps an even selection is shown")
      .whole_number("number of frames", 2, 5000)
      .shows_default();
  verb.option("--width-px", film_options.width_px, "width in pixels")
      .whole_number("width in pixels", 160, 3840)
      .shows_default();
  verb.option("--style", options->style, "paper, or dark").one_of("style", {"paper", "dark"}).shows_default();
  verb.option("-o,--out", film_options.out,
              "the file; without an ending --format adds its own (default: "
              "RUN/figures/<scenario>_<pipeline>_<of>)");
  verb.flag("-q,--quiet", options->quiet, "print only errors");
  verb.runs([options, format] {
    options->format_given = format.given();
    return film(*options);
  });
}

}  // namespace scanbench::app
