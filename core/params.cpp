// Checks values against declared parameters, and writes both as text for messages.
#include "core/params.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/names.hpp"
#include "core/number_text.hpp"

namespace scanbench {
namespace {

// A number as people write it: without an exponent from 0.0001 to below 1e15.
std::string plain_text(double value) {
  const double size = std::fabs(value);
  if (!(size >= 1e-4 && size < 1e15)) return number_text(value);
  std::array<char, 40> buffer{};
  const auto [end, ec] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return {buffer.data(), end};
}

[[noreturn]] void refuse(const ParamSpec& spec, const std::string& found) {
  throw ParamError(spec.name, spec.name + " is " + found + "; allowed: " + allowed_text(spec));
}

std::string allowed_numbers(const ParamSpec& spec) {
  const std::string kind = spec.type == ParamType::integer ? "a whole number" : "a number";
  const std::string bounds = spec.bounds.describe();
  const std::string unit = spec.unit.empty() ? "" : " " + spec.unit;
  return bounds.empty() ? kind + (unit.empty() ? "" : " in" + unit) : kind + " " + bounds + unit;
}

void check_number(const ParamSpec& spec, double v) {
  if (!std::isfinite(v) || !spec.bounds.contains(v)) refuse(spec, plain_text(v));
}

std::string kind_of(const ParamValue& value) {
  static constexpr std::string_view kNames[] = {"a boolean", "a whole number", "a number",    "text",
                                                "a list",    "a list of rows", "named points"};
  return std::string(kNames[value.index()]) + " (" + to_text(value) + ")";
}

}  // namespace

std::string Bounds::describe() const {
  const bool has_min = std::isfinite(min);
  const bool has_max = std::isfinite(max);
  if (has_min && has_max && !open_min) return plain_text(min) + " .. " + plain_text(max);
  std::string text;
  if (has_min) text = (open_min ? "> " : ">= ") + plain_text(min);
  if (has_max) text += (text.empty() ? "<= " : " and <= ") + plain_text(max);
  return text;
}

std::string_view to_string(ParamType type) {
  static constexpr std::string_view kNames[] = {"boolean", "integer",         "number",          "text",
                                                "choice",  "list of numbers", "rows of numbers", "named points"};
  return kNames[static_cast<std::size_t>(type)];
}

std::string to_text(const ParamValue& value) {
  struct Visitor {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return std::to_string(v); }
    std::string operator()(double v) const { return number_text(v); }
    std::string operator()(const std::string& v) const { return v; }
    std::string operator()(const std::vector<double>& v) const {
      std::string text = "[";
      for (std::size_t i = 0; i < v.size(); ++i) text += (i ? ", " : "") + number_text(v[i]);
      return text + "]";
    }
    std::string operator()(const NumberRows& v) const {
      std::string text = "[";
      for (std::size_t i = 0; i < v.size(); ++i) text += (i ? ", " : "") + (*this)(v[i]);
      return text + "]";
    }
    std::string operator()(const NamedPoints& v) const {
      std::string text = "{";
      for (std::size_t i = 0; i < v.size(); ++i)
        text += (i ? ", " : "") + v[i].first + ": [" + number_text(v[i].second.x()) + ", " +
                number_text(v[i].second.y()) + "]";
      return text + "}";
    }
  };
  return std::visit(Visitor{}, value);
}

std::string allowed_text(const ParamSpec& spec) {
  switch (spec.type) {
    case ParamType::boolean:
      return "true, false";
    case ParamType::integer:
    case ParamType::number:
      return allowed_numbers(spec);
    case ParamType::text:
      return "text";
    case ParamType::choice:
      return join(spec.choices);
    case ParamType::number_list:
      return "a list of numbers";
    case ParamType::number_rows:
      return "a list of rows of numbers";
    case ParamType::named_points:
      return "points by name, {A: [x, y], ...}";
  }
  throw InternalError("a parameter type without a description");
}

ParamValue checked(const ParamSpec& spec, const ParamValue& value) {
  switch (spec.type) {
    case ParamType::boolean:
      if (std::holds_alternative<bool>(value)) return value;
      refuse(spec, kind_of(value));
    case ParamType::integer:
      if (!std::holds_alternative<std::int64_t>(value)) refuse(spec, kind_of(value));
      check_number(spec, static_cast<double>(std::get<std::int64_t>(value)));
      return value;
    case ParamType::number: {
      double number = 0.0;
      if (const auto* i = std::get_if<std::int64_t>(&value))
        number = static_cast<double>(*i);
      else if (const auto* d = std::get_if<double>(&value))
        number = *d;
      else
        refuse(spec, kind_of(value));
      check_number(spec, number);
      return number;
    }
    case ParamType::text:
      if (std::holds_alternative<std::string>(value)) return value;
      refuse(spec, kind_of(value));
    case ParamType::choice: {
      const auto* text = std::get_if<std::string>(&value);
      if (text == nullptr || std::ranges::find(spec.choices, *text) == spec.choices.end())
        refuse(spec, text ? "'" + *text + "'" : kind_of(value));
      return value;
    }
    case ParamType::number_list: {
      const auto* list = std::get_if<std::vector<double>>(&value);
      if (list == nullptr) refuse(spec, kind_of(value));
      for (const double v : *list) check_number(spec, v);
      return value;
    }
    case ParamType::number_rows: {
      const auto* rows = std::get_if<NumberRows>(&value);
      if (rows == nullptr) refuse(spec, kind_of(value));
      for (const auto& row : *rows)
        for (const double v : row) check_number(spec, v);
      return value;
    }
    case ParamType::named_points: {
      const auto* points = std::get_if<NamedPoints>(&value);
      if (points == nullptr) refuse(spec, kind_of(value));
      for (const auto& [name, p] : *points) {
        check_number(spec, p.x());
        check_number(spec, p.y());
      }
      return value;
    }
  }
  throw InternalError("a parameter type without a check");
}

ParamSet resolve(const std::vector<ParamSpec>& specs, const ParamSet& given) {
  ParamSet all;
  for (const auto& spec : specs) {
    const auto found = given.find(spec.name);
    all.emplace(spec.name, found == given.end() ? spec.default_value : checked(spec, found->second));
  }
  for (const auto& [name, value] : given) {
    if (all.contains(name)) continue;
    std::vector<std::string> known;
    known.reserve(specs.size());
    for (const auto& spec : specs) known.push_back(spec.name);
    throw ParamError(name, "unknown parameter '" + name + "'" +
                               (known.empty() ? "; there are no parameters here" : known_names(name, known)));
  }
  return all;
}

}  // namespace scanbench
