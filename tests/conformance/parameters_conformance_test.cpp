// Every registered module of every kind describes itself and enforces what it describes.
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "metrics/metric.hpp"
#include "render/figure.hpp"
#include "sim/trajectory.hpp"

namespace scanbench {
namespace {

struct Described {
  std::string kind;
  ModuleInfo info;
  std::vector<ParamSpec> params;
  std::function<void(const ParamSet&)> make;
};

template <class Interface>
void append(std::vector<Described>& all) {
  for (const auto& [name, entry] : Registry<Interface>::all())
    all.push_back({std::string(Interface::kKind), entry.info, entry.params,
                   [make = entry.make](const ParamSet& set) { make(set); }});
}

std::vector<Described> all_modules() {
  std::vector<Described> all;
  append<LineExtractor>(all);
  append<SegmentMerger>(all);
  append<ScanMatcher>(all);
  append<Aligner>(all);
  append<Mapper>(all);
  append<metrics::MetricFamily>(all);
  append<render::Figure>(all);
  append<sim::TrajectoryKind>(all);
  return all;
}

void PrintTo(const Described& d, std::ostream* out) {
  *out << d.kind << " " << d.info.name;
}

class Parameters : public ::testing::TestWithParam<Described> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Parameters);
INSTANTIATE_TEST_SUITE_P(All, Parameters, ::testing::ValuesIn(all_modules()),
                         [](const auto& test) { return test.param.kind + "_" + test.param.info.name; });

bool is_name(const std::string& text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

TEST_P(Parameters, AreDocumented) {
  EXPECT_TRUE(is_name(GetParam().info.name)) << "names are snake_case";
  EXPECT_GE(GetParam().info.summary.size(), 10u);
  EXPECT_EQ(GetParam().info.summary.find('\n'), std::string::npos) << "a summary is one line";
  // Trajectories and figures need no paper.
  if (GetParam().kind != "trajectory" && GetParam().kind != "figure") {
    EXPECT_GE(GetParam().info.reference.size(), 3u);
  }
  std::vector<std::string> seen;
  for (const ParamSpec& spec : GetParam().params) {
    SCOPED_TRACE(spec.name);
    EXPECT_TRUE(is_name(spec.name));
    EXPECT_GE(spec.doc.size(), 5u);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), spec.name), 0) << "named twice";
    seen.push_back(spec.name);
    const auto ends_with = [&](std::string_view s) { return std::string_view(spec.name).ends_with(s); };
    if (ends_with("_rad")) {
      EXPECT_EQ(spec.unit, "rad");
    }
    if (ends_with("_m") && !ends_with("_per_m")) {
      EXPECT_EQ(spec.unit, "m");
    }
    if (ends_with("_s") && !ends_with("_per_s")) {
      EXPECT_EQ(spec.unit, "s");
    }
    if (spec.type == scanbench::ParamType::choice) {
      EXPECT_GE(spec.choices.size(), 2u);
    }
  }
}

TEST_P(Parameters, HaveDefaultsThatTheyAcceptAndThatRoundTrip) {
  const auto& specs = GetParam().params;
  for (const ParamSpec& spec : specs) EXPECT_EQ(checked(spec, spec.default_value), spec.default_value) << spec.name;
  const ParamSet effective = resolve(specs, {});
  EXPECT_EQ(effective.size(), specs.size());
  EXPECT_EQ(resolve(specs, effective), effective);
}

TEST_P(Parameters, RefuseNumbersBeyondTheirBounds) {
  for (const ParamSpec& spec : GetParam().params) {
    const auto refuse = [&](double number) {
      ParamValue value = number;
      if (spec.type == scanbench::ParamType::integer) value = static_cast<std::int64_t>(number);
      if (spec.type == scanbench::ParamType::number_list) value = std::vector<double>{number};
      if (spec.type == scanbench::ParamType::number_rows) value = NumberRows{{number}};
      if (spec.type == scanbench::ParamType::named_points) value = NamedPoints{{"A", Vec2(number, number)}};
      EXPECT_THROW(GetParam().make({{spec.name, value}}), ParamError) << spec.name << " = " << number;
    };
    const bool numeric = spec.type == scanbench::ParamType::integer || spec.type == scanbench::ParamType::number ||
                         spec.type == scanbench::ParamType::number_list ||
                         spec.type == scanbench::ParamType::number_rows ||
                         spec.type == scanbench::ParamType::named_points;
    if (!numeric) continue;
    const double step = spec.type == scanbench::ParamType::integer ? 1.0 : 1e-9;
    if (std::isfinite(spec.bounds.min))
      refuse(spec.bounds.open_min ? spec.bounds.min
                                  : spec.bounds.min - std::max(step, 1e-9 * std::fabs(spec.bounds.min)));
    if (std::isfinite(spec.bounds.max)) refuse(spec.bounds.max + std::max(step, 1e-9 * std::fabs(spec.bounds.max)));
    if (spec.type == scanbench::ParamType::integer) continue;
    refuse(std::numeric_limits<double>::quiet_NaN());
    refuse(std::numeric_limits<double>::infinity());
    refuse(-std::numeric_limits<double>::infinity());
  }
}

TEST_P(Parameters, RefuseUnknownNamesChoicesAndTypes) {
  EXPECT_THROW(GetParam().make({{"no_such_parameter", 1.0}}), ParamError);
  for (const ParamSpec& spec : GetParam().params) {
    if (spec.type == scanbench::ParamType::choice) {
      EXPECT_THROW(GetParam().make({{spec.name, std::string("no_such_choice")}}), ParamError) << spec.name;
    }
    if (spec.type == scanbench::ParamType::text) {
      EXPECT_THROW(GetParam().make({{spec.name, 1.0}}), ParamError) << spec.name;
    } else {
      EXPECT_THROW(GetParam().make({{spec.name, std::string("text")}}), ParamError) << spec.name;
    }
  }
}

}  // namespace
}  // namespace scanbench
