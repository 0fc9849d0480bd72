// The pictures of a night that show what became worse: the same scans and figures, before and now.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/analysis/comparison.hpp"

namespace scanbench::results {

/// A figure, or one scan with a pipeline's lines, as PNG.
struct PagePicture {
  std::string caption;
  std::string png;
};

/// A scan of a cell.
struct ScanPlace {
  runs::CellKey cell;
  std::size_t frame = 0;
};

/// A scan or a figure that shows a change: as it was before, if that is known, and as it is now.
struct PicturePair {
  std::string title;   ///< "iepf in abcdef, seed 3: f1 of scan 15 fell from 0.92 to 0.55"
  std::string note{};  ///< why this scan is shown, or why there is no picture
  std::optional<PagePicture> before{};
  std::optional<PagePicture> now{};
  std::optional<ScanPlace> scan{};  ///< none for figures
  bool needs_key = false;           ///< its colours are verdicts, and no legend is in the pictures
};

struct NightPictures {
  std::vector<PicturePair> scans;    ///< one for each pipeline with a gate that became worse
  std::vector<PicturePair> figures;  ///< those of scenarios with such a pipeline that changed
};

/// `before`: the folder of an earlier run, which need not exist. The scan of a pipeline is the one on which the gate
/// became worse by most, on the seed with the largest change. Figures that choose the scan that they show are drawn
/// again, in both runs with the scan that changed most on the scenario's first seed. Throws ConfigError for damaged
/// files.
NightPictures night_pictures(const std::filesystem::path& run, const std::filesystem::path& before,
                             const Comparison& comparison);

}  // namespace scanbench::results
