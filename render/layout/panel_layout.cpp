// Maps data to paper, and computes the extent of a panel's data.
#include "render/layout/panel_layout.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::render {
namespace {

constexpr double kHuge = 1e9;

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

}  // namespace

bool drawable(const Vec2& p) {
  return std::abs(p.x()) < kHuge && std::abs(p.y()) < kHuge;  // false for NaN
}

Vec2 PanelLayout::to_device(const Vec2& data) const {
  const auto share = [](double v, double low, double high, bool log) {
    return log ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
  };
  return {box.x0 + share(data.x(), x_min, x_max, x_log) * box.width(),
          box.y1 - share(data.y(), y_min, y_max, y_log) * box.height()};
}

Rect data_bounds(const Panel& panel) {
  Rect r{INFINITY, INFINITY, -INFINITY, -INFINITY};
  const auto add = [&](const Vec2& p) {
    if (!drawable(p) || (panel.x.log && !(p.x() > 0)) || (panel.y.log && !(p.y() > 0))) return;
    r = {std::min(r.x0, p.x()), std::min(r.y0, p.y()), std::max(r.x1, p.x()), std::max(r.y1, p.y())};
  };
  const auto add_all = [&](const std::vector<Vec2>& points) { std::for_each(points.begin(), points.end(), add); };
  for (const Item& item : panel.items)
    std::visit(Overloaded{[&](const Lines& i) {
                            for (const Segment& s : i.segments)
                              if (drawable(s.a) && drawable(s.b)) add(s.a), add(s.b);
                          },
                          [&](const Polyline& i) { add_all(i.points); }, [&](const Points& i) { add_all(i.points); },
                          [&](const Polygon& i) { add_all(i.points); },
                          [&](const Ellipse& i) {
                            const double m = i.semi_axes.cwiseAbs().maxCoeff();
                            add(i.center + Vec2(m, m)), add(i.center - Vec2(m, m));
                          },
                          [&](const Text& i) { add(i.at); }, [&](const Arrow& i) { add(i.pose.translation()); },
                          [&](const Bars& i) {
                            for (const Vec2& t : i.tops) {
                              add(t - Vec2(0.5 * i.width, 0)), add(t + Vec2(0.5 * i.width, 0));
                              add({t.x(), i.base});
                            }
                          },
                          [&](const ErrorBars& i) {
                            for (const auto& [x, low, high] : i.intervals) add({x, low}), add({x, high});
                          }},
               item);
  return r;
}

}  // namespace scanbench::render
