// Lines over the truth: the right, the split, the false and the missed ones look different.
#pragma once

#include <array>
#include <vector>

#include "render/figure.hpp"

namespace scanbench::render {

/// The lines that one pipeline found in one scan or in many, sorted by verdict.
class JudgedLines {
 public:
  /// Adds the lines of a frame, and the true lines that were missed. `verdicts`: of all frames, may be empty.
  void add(const ScanLines& lines, const std::vector<ScanVerdict>& verdicts, std::size_t frame, const Pose2& pose);

  /// All found lines, without the missed ones.
  std::vector<Segment> found() const;

  /// Colour and dash show the verdict; lines without one have `own`. `ends`: markers at the ends, of another shape for
  /// each verdict.
  void draw(const Stroke& own, bool ends, Panel& panel) const;

  bool operator==(const JudgedLines&) const = default;

 private:
  static constexpr std::size_t kKinds = 7;
  std::array<std::vector<Segment>, kKinds> lines_{};
};

/// An entry for each verdict that a panel of the scene shows, drawn with this width.
void add_verdict_legend(double width_pt, Scene& scene);

}  // namespace scanbench::render
