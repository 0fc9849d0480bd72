// Reads metrics of pipelines, and finds pipelines that differ in one parameter.
#include "render/figures/parts/measured.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <variant>

#include <fmt/format.h>

namespace scanbench::render {
namespace {

/// The value of "slot.parameter", and all other settings as a text, equal for pipelines of one kind.
struct Setting {
  std::optional<double> value;
  std::string others;
};

Setting setting_of(const MeasuredPipeline& measured, const std::string& parameter) {
  Setting setting;
  for (const auto& [slot, params] : measured.slots) {
    setting.others += slot + ";";
    const std::string kind = slot.substr(0, slot.find(' '));
    for (const auto& [name, value] : params) {
      const bool varied = kind + "." + name == parameter;
      if (const auto* number = std::get_if<double>(&value); varied && number != nullptr)
        setting.value = *number;
      else if (const auto* whole = std::get_if<std::int64_t>(&value); varied && whole != nullptr)
        setting.value = static_cast<double>(*whole);
      else
        setting.others += name + "=" + to_text(value) + ";";
    }
  }
  return setting;
}

/// The common beginning of two names, without the separators and digits with which the values begin.
std::string common_name(const std::string& a, const std::string& b) {
  std::string name = a.substr(0, static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin()));
  const auto end = name.find_last_not_of("_-.0123456789");
  return end == std::string::npos ? a : name.substr(0, end + 1);
}

std::string unit_of(const std::string& parameter, const std::vector<MeasuredPipeline>& all) {
  for (const MeasuredPipeline& measured : all)
    if (const auto unit = measured.units.find(parameter); unit != measured.units.end() && !unit->second.empty())
      return unit->second;
  return "";
}

bool has_value(const MeasuredPipeline& measured, const std::string& metric) {
  const auto found = measured.metrics.find(metric);
  return found != measured.metrics.end() && !found->second.empty();
}

}  // namespace

std::string chosen_metric(const FigureInput& input, const std::string& wanted) {
  return wanted.empty() ? input.quality : wanted;
}

std::string metric_words(const FigureInput& input, const std::string& metric) {
  const auto look = input.looks.find(metric);
  return look == input.looks.end() || look->second.label.empty() ? metric : look->second.label;
}

Axis metric_axis(const FigureInput& input, const std::string& metric) {
  const auto look = input.looks.find(metric);
  return {.label = metric_words(input, metric), .unit = look == input.looks.end() ? "" : look->second.unit};
}

std::optional<MeanBand> band_of(const MeasuredPipeline& measured, const std::string& metric) {
  const auto found = measured.bands.find(metric);
  if (found == measured.bands.end() || !std::isfinite(found->second.mean)) return std::nullopt;
  return found->second;
}

std::optional<double> cost_of(const FigureInput& input, const std::string& metric, double value) {
  const auto look = input.looks.find(metric);
  if (look == input.looks.end()) return std::nullopt;
  switch (look->second.best) {
    case MetricLook::Best::lowest:
      return value;
    case MetricLook::Best::highest:
      return -value;
    case MetricLook::Best::target:
      return std::abs(value - look->second.target);
    default:
      return std::nullopt;
  }
}

std::string no_value_of(const std::string& metric) {
  if (metric.empty())
    return "no pipeline has a value of a metric by which reports rank; the figure's parameters name one";
  return fmt::format("no pipeline has a value of the metric {}", metric);
}

std::size_t most_seeds(const FigureInput& input, const std::string& metric) {
  std::size_t most = 0;
  for (const MeasuredPipeline& measured : input.measured)
    if (has_value(measured, metric)) most = std::max(most, measured.metrics.at(metric).size());
  return most;
}

std::vector<VariedPipelines> varied_pipelines(const std::string& parameter, const std::vector<MeasuredPipeline>& all,
                                              const std::vector<std::string>& metrics) {
  std::vector<VariedPipelines> groups;
  std::vector<std::string> kinds;
  for (const MeasuredPipeline& measured : all) {
    const Setting setting = setting_of(measured, parameter);
    const auto has = [&](const std::string& metric) { return has_value(measured, metric); };
    if (!setting.value || !std::ranges::all_of(metrics, has)) continue;
    const auto at = static_cast<std::size_t>(std::ranges::find(kinds, setting.others) - kinds.begin());
    if (at == kinds.size()) {
      kinds.push_back(setting.others);
      groups.push_back({measured.pipeline, {}});
    }
    groups[at].name = common_name(groups[at].name, measured.pipeline);
    groups[at].members.emplace_back(*setting.value, &measured);
  }
  std::erase_if(groups, [](const VariedPipelines& group) { return group.members.size() < 2; });
  for (VariedPipelines& group : groups) std::ranges::sort(group.members, {}, [](const auto& m) { return m.first; });
  return groups;
}

std::vector<std::string> varied_parameters(const std::vector<MeasuredPipeline>& all,
                                           const std::vector<std::string>& metrics) {
  std::set<std::string> names;
  for (const MeasuredPipeline& measured : all)
    for (const auto& [slot, params] : measured.slots)
      for (const auto& [name, value] : params) names.insert(slot.substr(0, slot.find(' ')) + "." + name);
  std::vector<std::string> varied;
  for (const std::string& name : names)
    if (!varied_pipelines(name, all, metrics).empty()) varied.push_back(name);
  return varied;
}

std::string parameter_words(const std::string& parameter, const std::vector<MeasuredPipeline>& all) {
  std::string words = parameter.substr(parameter.find('.') + 1);  // all of it without a slot
  std::string suffix = "_" + unit_of(parameter, all);
  if (const auto per = suffix.find('/'); per != std::string::npos) suffix.replace(per, 1, "_per_");
  if (suffix.size() > 1 && words.size() > suffix.size() && words.ends_with(suffix))
    words.resize(words.size() - suffix.size());
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string parameter_with_unit(const std::string& parameter, const std::vector<MeasuredPipeline>& all) {
  const std::string unit = unit_of(parameter, all), words = parameter_words(parameter, all);
  return unit.empty() ? words : fmt::format("{} [{}]", words, unit);
}

Axis parameter_axis(const std::string& parameter, const std::vector<MeasuredPipeline>& all) {
  return {.label = parameter_words(parameter, all), .unit = unit_of(parameter, all)};
}

}  // namespace scanbench::render
