// Facet charts: the items of each panel.
#include "render/charts/facets.hpp"
#include "render/backends/cairo.hpp"
#include "render/layout/layout.hpp"

#include <gtest/gtest.h>

namespace scanbench::render {
namespace {

template <class T>
std::vector<T> items_of(const Panel& panel) {
  std::vector<T> found;
  for (const Item& item : panel.items)
    if (const T* t = std::get_if<T>(&item)) found.push_back(*t);
  return found;
}

const std::vector<Vec2> kOne{Vec2(1, 2), Vec2(2, 3)};
const std::vector<Vec2> kTwo{Vec2(1, 5), Vec2(2, 6)};
const std::vector<Vec2> kBound{Vec2(1, 1), Vec2(2, 2)};

FacetChart chart() {
  const FacetCurve one{.points = kOne, .intervals = {{1.0, 1.0, 3.0}, {2.0, 2.0, 4.0}}};
  const FacetCurve two{.points = kTwo};
  const FacetCurve second{.points = {Vec2(1, 7)}};
  FacetChart chart{.title = "errors",
                   .x = {.label = "range [m]", .log = true},
                   .y = {.label = "error [cm]", .log = true},
                   .curve_names = {"offset", "angle"},
                   .reference_name = "bound",
                   .others_name = "the others"};
  chart.facets.push_back({.title = "one", .curves = {one}, .reference = kBound});
  chart.facets.push_back({.title = "two", .curves = {two, second}});
  chart.facets.push_back({.title = "none"});
  return chart;
}

TEST(FacetScene, HasOnePanelAFacetWithTheOthersBehind) {
  const Scene scene = facet_scene(chart());
  ASSERT_EQ(scene.panels.size(), 3u);
  EXPECT_TRUE(scene.share_axes);
  EXPECT_EQ(scene.panels[0].title, "one");
  EXPECT_TRUE(scene.panels[0].x.log);
  // Panel one: curve of two, reference, own curve; in this order, so that its own is on top.
  const auto lines = items_of<Polyline>(scene.panels[0]);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].points, kTwo);
  EXPECT_EQ(lines[1].points, kBound);
  EXPECT_EQ(lines[2].points, kOne);
  EXPECT_EQ(items_of<ErrorBars>(scene.panels[0]).at(0).intervals.size(), 2u);
  // A facet without points still shows the others.
  EXPECT_EQ(items_of<Polyline>(scene.panels[2]).size(), 2u);
}

TEST(FacetScene, LeavesRoomBetweenAPointAndTheArrowOfItsBar) {
  for (const double highest : {3.0, 130.0, 1e5}) {
    FacetChart four = chart();
    four.facets = {
        {.title = "one",
         .curves = {{.points = {Vec2(1, 1), Vec2(2, highest)}, .intervals = {{1.0, 1e-9, 2.0}, {2.0, 1.0, 1e9}}}}}};
    four.facets.resize(4, four.facets[0]);
    four.y.range = log_range(four.facets, 1);
    const Scene scene = facet_scene(four);
    const Layout placed = layout(scene);
    const PanelLayout& panel = placed.panels[0];
    const double size = items_of<Points>(scene.panels[0]).front().size_pt;
    const double arrow = items_of<ErrorBars>(scene.panels[0]).front().cap_pt;  // as long as it is wide
    EXPECT_GT(panel.to_device({2.0, highest}).y() - panel.box.y0, 0.5 * size + 0.5 + arrow) << highest;
    EXPECT_GT(panel.box.y1 - panel.to_device({1.0, 1.0}).y(), 0.5 * size + 0.5 + arrow) << highest;
  }
}

TEST(FacetScene, DrawsTwoCurvesThatDifferWithoutColour) {
  const auto points = items_of<Points>(facet_scene(chart()).panels[1]);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NE(points[0].marker, points[1].marker);
  EXPECT_NE(points[0].filled, points[1].filled);
}

TEST(FacetScene, LegendNamesWhatIsDrawnAndNothingElse) {
  EXPECT_EQ(facet_scene(chart()).legend.size(), 4u);
  FacetChart plain = chart();
  plain.others_name.clear();
  plain.reference_name.clear();
  const Scene scene = facet_scene(plain);
  EXPECT_EQ(scene.legend.size(), 2u);
  EXPECT_TRUE(items_of<Polyline>(scene.panels[2]).empty());
  EXPECT_FALSE(to_svg(scene).empty());
}

}  // namespace
}  // namespace scanbench::render
