// Time of drawing a figure, and of comparing lines as pixels, in one thread. The first PNG of a process includes the
// creation of the OpenGL context.
#include <benchmark/benchmark.h>

#include <cmath>

#ifdef SCANBENCH_WITH_OPENCV
#include <GL/osmesa.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#endif

#include "core/contracts/line_raster.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"
#include "metrics/metric.hpp"
#include "render/backends/cairo.hpp"
#include "render/backends/gl.hpp"
#include "render/backends/tessellate.hpp"
#include "render/layout/layout.hpp"
#include "render/palette.hpp"

namespace scanbench::render {
namespace {

/// Segments of 1 m in 14 m x 14 m.
Lines segments(int count, std::uint32_t stream, Color color) {
  CounterRng rng(1, RngStream::pose, stream);
  Lines lines{.stroke = {color, 0.5, Dash::solid}};
  for (int i = 0; i < count; ++i) {
    const Vec2 a(14 * rng.uniform(), 14 * rng.uniform());
    const double angle = kTwoPi * rng.uniform();
    lines.segments.push_back({a, a + Vec2(std::cos(angle), std::sin(angle))});
  }
  return lines;
}

/// `panels` panels with 1654 segments each, about as many as 200 scans of 15 walls give.
Scene segments_scene(std::int64_t panels) {
  Scene scene{.width_in = panels > 1 ? kDoubleColumnIn : kSingleColumnIn, .title = "segments", .share_axes = true};
  for (std::int64_t p = 0; p < panels; ++p)
    scene.panels.push_back(
        {.title = "panel",
         .items = {segments(1654, static_cast<std::uint32_t>(p), method_style(std::to_string(p)).color)}});
  return scene;
}

void layout_only(benchmark::State& state) {
  const Scene scene = segments_scene(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(layout(scene));
}
void tessellate_only(benchmark::State& state) {
  const Layout placed = layout(segments_scene(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(tessellate(placed.shapes, 11.0));
}
void png(benchmark::State& state) {
  const Scene scene = segments_scene(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(to_png(scene));
}
void svg(benchmark::State& state) {
  const Scene scene = segments_scene(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(to_svg(scene));
}
void pdf(benchmark::State& state) {
  const Scene scene = segments_scene(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(to_pdf(scene));
}
/// The segments on 1200 x 900 pixels.
void png_large(benchmark::State& state) {
  Scene scene{.width_in = 6.0, .height_in = 4.5, .title = "segments"};
  scene.panels.push_back({.equal_aspect = false, .items = {segments(static_cast<int>(state.range(0)), 0, kBlue)}});
  for (auto _ : state) benchmark::DoNotOptimize(to_png(scene));
}

#ifdef SCANBENCH_WITH_OPENCV
/// The alternative for the same segments and pixels, without axes and texts: lines that OpenGL smooths, encoded by
/// OpenCV. Such lines depend on the number of threads.
void smooth_lines_imencode(benchmark::State& state) {
  constexpr int kWidth = 1200, kHeight = 900;
  const Lines lines = segments(static_cast<int>(state.range(0)), 0, kBlue);
  std::vector<float> ends;
  for (const Segment& s : lines.segments)
    for (const Vec2& p : {s.a, s.b}) ends.insert(ends.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
  setenv("LP_NUM_THREADS", "0", 1);
  OSMesaContext context = OSMesaCreateContextExt(OSMESA_BGRA, 0, 0, 0, nullptr);
  cv::Mat image(kHeight, kWidth, CV_8UC4);
  OSMesaMakeCurrent(context, image.data, GL_UNSIGNED_BYTE, kWidth, kHeight);
  OSMesaPixelStore(OSMESA_Y_UP, 0);
  for (auto _ : state) {
    glViewport(0, 0, kWidth, kHeight);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(-1, 15, -1, 15, -1, 1);
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_LINE_SMOOTH);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glLineWidth(1.4F);  // 0.5 pt
    glColor4ub(kBlue.r, kBlue.g, kBlue.b, 255);
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(2, GL_FLOAT, 0, ends.data());
    glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(ends.size() / 2));
    glFinish();
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes);
    benchmark::DoNotOptimize(bytes);
  }
  OSMesaDestroyContext(context);
}
BENCHMARK(smooth_lines_imencode)->Arg(1654)->Arg(10000)->Unit(benchmark::kMillisecond);
#endif

/// A map of 1000 lines in 20 m x 20 m, up to 5 cm beside 1000 walls.
struct MapOfLines {
  ScanSet observed;
  Truth truth;
  PipelineResult result;

  MapOfLines() {
    CounterRng rng(1, RngStream::pose, 0);
    const auto beside = [&](const Vec2& p) { return Vec2(p + 0.05 * Vec2(rng.normal(), rng.normal())); };
    result.has_map = true;
    for (int i = 0; i < 1000; ++i) {
      const Vec2 a(20 * rng.uniform(), 20 * rng.uniform());
      const double angle = kTwoPi * rng.uniform();
      const Segment wall{a, a + Vec2(std::cos(angle), std::sin(angle))};
      truth.walls.push_back({"", wall});
      result.map.lines.push_back({.segment = {beside(wall.a), beside(wall.b)}});
    }
  }
};

/// The pixels of both sets, at 1 cm.
void raster_draw(benchmark::State& state) {
  const MapOfLines map;
  std::vector<std::vector<Segment>> layers(3);
  for (const MapLine& line : map.result.map.lines) layers[0].push_back(line.segment);
  for (const Wall& wall : map.truth.walls) layers[1].push_back(wall.segment);
  layers[2] = layers[1];
  const auto raster = Registry<LineRaster>::make(LineRaster::kDefault);
  for (auto _ : state) benchmark::DoNotOptimize(raster->draw(layers, 0.01));
}
void raster_truth(benchmark::State& state) {
  const MapOfLines map;
  const auto family = Registry<metrics::MetricFamily>::make("raster_truth");
  for (auto _ : state) benchmark::DoNotOptimize(family->evaluate({map.observed, &map.truth, map.result}));
}
BENCHMARK(raster_draw)->Unit(benchmark::kMillisecond);
BENCHMARK(raster_truth)->Unit(benchmark::kMillisecond);
BENCHMARK(layout_only)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(tessellate_only)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(png)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(png_large)->Arg(1654)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(svg)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(pdf)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace scanbench::render
