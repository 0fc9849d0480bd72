// The time of drawing a figure in one thread. The first PNG of a process includes the OpenGL context.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/index.hpp"
#include "core/rng.hpp"
#include "render/layout.hpp"
#include "render/palette.hpp"
#include "render/tessellate.hpp"

namespace scanbench::render {
namespace {

/// `panels` panels with 1654 segments each, about as many as in 200 scans of 15 walls.
Scene segments_scene(std::int64_t panels) {
  Scene scene{.width_in = panels > 1 ? kDoubleColumnIn : kSingleColumnIn, .title = "segments", .share_axes = true};
  for (std::int64_t p = 0; p < panels; ++p) {
    CounterRng rng(1, RngStream::pose, static_cast<std::uint32_t>(p));
    Lines lines{.stroke = {method_style(as_index(p)).color, 0.5, Dash::solid}};
    for (int i = 0; i < 1654; ++i) {
      const Vec2 a(14 * rng.uniform(), 14 * rng.uniform());
      const double angle = kTwoPi * rng.uniform();
      lines.segments.push_back({a, a + Vec2(std::cos(angle), std::sin(angle))});
    }
    scene.panels.push_back({.title = "panel", .items = {std::move(lines)}});
  }
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
BENCHMARK(layout_only)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(tessellate_only)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(png)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(svg)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);
BENCHMARK(pdf)->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace scanbench::render
