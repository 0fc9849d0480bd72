// Checks of what a module says of itself.
#include "harness/study/conform/description_checks.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench::study::conform {
namespace {

bool is_name(const std::string& text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

bool has_its_unit(const ParamSpec& spec) {
  const auto ends = [&](std::string_view end) { return std::string_view(spec.name).ends_with(end); };
  if (ends("_rad")) return spec.unit == "rad";
  if (ends("_m") && !ends("_per_m")) return spec.unit == "m";
  if (ends("_s") && !ends("_per_s")) return spec.unit == "s";
  return true;
}

}  // namespace

void check_description(const ModuleInfo& info, const std::vector<ParamSpec>& params, Findings& findings) {
  findings.expect(is_name(info.name), "the name '" + info.name + "' is not in snake_case");
  findings.expect(info.summary.size() >= 10, "the summary '" + info.summary + "' is too short");
  findings.expect(info.summary.find('\n') == std::string::npos, "the summary is more than one line");
  findings.expect(info.reference.size() >= 3, "there is no reference; `none` is one");
  for (const ParamSpec& spec : params) {
    findings.expect(is_name(spec.name), "the parameter '" + spec.name + "' is not in snake_case");
    findings.expect(spec.doc.size() >= 5, spec.name + " is not documented");
    findings.expect(has_its_unit(spec), spec.name + " has the unit '" + spec.unit + "', and its name says another");
    findings.expect(std::ranges::count(params, spec.name, &ParamSpec::name) == 1, spec.name + " is named twice");
    findings.expect(spec.type != ParamType::choice || spec.choices.size() >= 2, spec.name + " leaves no choice");
  }
}

}  // namespace scanbench::study::conform
