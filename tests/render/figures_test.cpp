// Every registered figure on a simulated recording, on a log without truth, and on nothing. With SCANBENCH_FIGURE_DIR
// set, the files are left there to be looked at.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "abcdef.hpp"
#include "core/registry.hpp"
#include "render/figure.hpp"

namespace scanbench::render {
namespace {

void keep(const std::string& name, const std::string& bytes) {
  if (const char* dir = std::getenv("SCANBENCH_FIGURE_DIR"); dir != nullptr)
    std::ofstream(std::string(dir) + "/" + name, std::ios::binary) << bytes;
}

struct Case {
  Recording recording;
  std::vector<PipelineResult> results;
  FigureInput input(const NamedPoints& waypoints) const {
    FigureInput in{.title = "abcdef", .recording = recording, .waypoints = waypoints, .results = {}};
    const std::vector<std::string> names{"iepf", "line_tracking", "smf", "ransac", "hough"};
    for (std::size_t i = 0; i < results.size(); ++i) in.results.push_back({names[i], &results[i]});
    return in;
  }
};

Case simulated(int frames) {
  Case c{test::abcdef_recording(frames), {}};
  for (const double jitter : {0.01, 0.03, 0.06})
    c.results.push_back(test::lines_by_wall_id(c.recording, jitter, jitter != 0.03));
  return c;
}

TEST(Figures, AllAreDrawnForASimulatedRecordingAndTheSvgStaysBelowAMegabyte) {
  const Case c = simulated(200);
  for (const std::string& name : Registry<Figure>::names()) {
    const std::vector<NamedScene> scenes = Registry<Figure>::make(name)->draw(c.input(test::abcdef_waypoints()));
    ASSERT_EQ(scenes.size(), 1u) << name;
    EXPECT_EQ(scenes[0].name, name);
    EXPECT_FALSE(scenes[0].caption.empty());
    const std::string svg = to_svg(scenes[0].scene);
    EXPECT_LT(svg.size(), 1'000'000u) << name;
    keep(name + ".svg", svg);
    keep(name + ".png", to_png(scenes[0].scene));
    keep(name + ".pdf", to_pdf(scenes[0].scene));
  }
}

}  // namespace
}  // namespace scanbench::render
