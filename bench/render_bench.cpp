// Time of drawing a figure in one thread. The first PNG of a process includes the creation of the OpenGL context.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/index.hpp"
#include "core/rng.hpp"
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
/// 10 000 segments on 1200 x 900 pixels.
void png_large(benchmark::State& state) {
  Scene scene{.width_in = 6.0, .height_in = 4.5, .title = "segments"};
  scene.panels.push_back({.equal_aspect = false, .items = {segments(10000, 0, kBlue)}});
  for (auto _ : state) benchmark::DoNotOptimize(to_png(scene));
}
BENCHMARK(layout_only)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(tessellate_only)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(png)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(png_large)->Unit(benchmark::kMillisecond);
BENCHMARK(svg)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(pdf)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace scanbench::render
