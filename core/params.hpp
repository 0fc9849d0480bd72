// Parameters described once. A module has an aggregate `Params` with its defaults and one `fields()` list. The list
// supplies typed reading, bounds, errors for unknown keys, the saved effective configuration, `scanbench describe` and
// the tables of docs/modules.md.
//
//   struct Params {
//     double threshold_m = 0.10;
//     Fit fit = Fit::end_points;
//     static auto fields() {
//       return std::tuple{
//           field("threshold_m", &Params::threshold_m, above(0), "m", "largest distance of a point from the chord"),
//           choice("fit", &Params::fit, {{Fit::end_points, "end_points"}, {Fit::tls, "tls"}}, "line of a group")};
//     }
//   };
//
// A struct with a member that fields() does not name does not compile (params_complete).
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/geometry.hpp"
#include "core/special_values.hpp"

namespace scanbench {

using NumberRows = std::vector<std::vector<double>>;
using NamedPoints = std::vector<std::pair<std::string, Vec2>>;  ///< in the order given
using ParamValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, NumberRows, NamedPoints>;
using ParamSet = std::map<std::string, ParamValue, std::less<>>;

/// The allowed values of a number, or of every element of a list.
struct Bounds {
  double min = -kInf;
  double max = kInf;
  bool open_min = false;  ///< min itself is not allowed

  bool contains(double v) const { return (open_min ? v > min : v >= min) && v <= max; }
  std::string describe() const;  ///< "> 0", ">= 0", "0 .. 1", "" for any
};
inline Bounds above(double min) {
  return {.min = min, .open_min = true};
}
inline Bounds at_least(double min) {
  return {.min = min};
}
inline Bounds between(double min, double max) {
  return {.min = min, .max = max};
}
inline Bounds any_number() {
  return {};
}

enum class ParamType { boolean, integer, number, text, choice, number_list, number_rows, named_points };
std::string_view to_string(ParamType type);

/// A parameter as files, documents and error messages show it.
struct ParamSpec {
  std::string name;
  ParamType type = ParamType::number;
  ParamValue default_value;
  Bounds bounds;
  std::string unit;
  std::string doc;
  std::vector<std::string> choices;
};

/// A value as text. Numbers have the shortest form that reads back to the same number.
std::string to_text(const ParamValue& value);

/// What a parameter accepts, in the words of error messages and documents: "a number > 0 m", "end_points, tls", "text".
std::string allowed_text(const ParamSpec& spec);

/// The value in the spec's type (an integer is accepted for a number). Throws ParamError for a wrong
/// type, a number out of bounds or not finite, an unknown choice.
ParamValue checked(const ParamSpec& spec, const ParamValue& value);

/// The given parameters and the defaults of the others. Throws ParamError as checked() does, and for an unknown name;
/// the message lists the known names.
ParamSet resolve(const std::vector<ParamSpec>& specs, const ParamSet& given);

/// One entry of a fields() list: made by field(), degrees_field() or choice() below.
template <class P, class T>
struct Field {
  std::string_view name;
  T P::*member;
  Bounds bounds;
  std::string_view unit;
  std::string_view doc;
  std::vector<std::pair<std::int64_t, std::string_view>> choices{};
  bool in_degrees = false;  ///< of files; the member is in radians
};

template <class P, class T>
Field<P, T> field(std::string_view name, T P::*member, Bounds bounds, std::string_view unit, std::string_view doc) {
  return {name, member, bounds, unit, doc};
}
template <class P, class T>
Field<P, T> field(std::string_view name, T P::*member, std::string_view doc) {
  return {name, member, {}, "", doc};
}
/// A member in radians that files give in degrees: `name` ends in _deg, and the bounds are in degrees. Values pass
/// through degrees * pi / 180, so to_param_set() returns them up to rounding; keep what resolve() gave where the
/// file's own number matters.
template <class P>
Field<P, double> degrees_field(std::string_view name, double P::*member, Bounds bounds, std::string_view doc) {
  return {.name = name, .member = member, .bounds = bounds, .unit = "deg", .doc = doc, .in_degrees = true};
}
template <class P, class E>
Field<P, E> choice(std::string_view name, E P::*member, std::initializer_list<std::pair<E, std::string_view>> names,
                   std::string_view doc) {
  Field<P, E> f{name, member, {}, "", doc};
  for (const auto& [value, text] : names) f.choices.emplace_back(static_cast<std::int64_t>(value), text);
  return f;
}

namespace detail {

/// Converts to any type, to count the members of an aggregate.
struct Anything {
  template <class T>
  operator T() const;
};

template <class P, class... Args>
constexpr std::size_t member_count() {
  if constexpr (requires { P{std::declval<Args>()..., Anything{}}; }) {
    return member_count<P, Args..., Anything>();
  } else {
    return sizeof...(Args);
  }
}

template <class T>
ParamType type_of() {
  if constexpr (std::same_as<T, bool>)
    return ParamType::boolean;
  else if constexpr (std::is_enum_v<T>)
    return ParamType::choice;
  else if constexpr (std::integral<T>)
    return ParamType::integer;
  else if constexpr (std::same_as<T, double>)
    return ParamType::number;
  else if constexpr (std::same_as<T, std::string>)
    return ParamType::text;
  else if constexpr (std::same_as<T, std::vector<double>>)
    return ParamType::number_list;
  else if constexpr (std::same_as<T, NumberRows>)
    return ParamType::number_rows;
  else {
    static_assert(std::same_as<T, NamedPoints>, "a parameter of this type is not supported");
    return ParamType::named_points;
  }
}

template <class P, class T>
ParamValue to_value(const Field<P, T>& f, const P& params) {
  if constexpr (std::is_enum_v<T>) {
    for (const auto& [value, text] : f.choices)
      if (value == static_cast<std::int64_t>(params.*f.member)) return std::string(text);
    throw InternalError("parameter " + std::string(f.name) + " has a value without a name");
  } else if constexpr (std::integral<T> && !std::same_as<T, bool>) {
    return static_cast<std::int64_t>(params.*f.member);
  } else if constexpr (std::same_as<T, double>) {
    return f.in_degrees ? degrees(params.*f.member) : params.*f.member;
  } else {
    return params.*f.member;
  }
}

template <class P, class T>
void from_value(const Field<P, T>& f, const ParamValue& value, P& params) {
  if constexpr (std::is_enum_v<T>) {
    for (const auto& [number, text] : f.choices)
      if (text == std::get<std::string>(value)) params.*f.member = static_cast<T>(number);
  } else if constexpr (std::integral<T> && !std::same_as<T, bool>) {
    params.*f.member = static_cast<T>(std::get<std::int64_t>(value));
  } else if constexpr (std::same_as<T, double>) {
    const double number = std::get<double>(value);
    params.*f.member = f.in_degrees ? radians(number) : number;
  } else {
    params.*f.member = std::get<T>(value);
  }
}

template <class P, class T>
ParamSpec to_spec(const Field<P, T>& f) {
  ParamSpec spec{
      std::string(f.name), type_of<T>(), to_value(f, P{}), f.bounds, std::string(f.unit), std::string(f.doc), {}};
  for (const auto& [value, text] : f.choices) spec.choices.emplace_back(text);
  return spec;
}

}  // namespace detail

/// True if fields() names every member.
template <class P>
constexpr bool params_complete() {
  return detail::member_count<P>() == std::tuple_size_v<decltype(P::fields())>;
}

template <class P>
std::vector<ParamSpec> param_specs() {
  static_assert(params_complete<P>(), "a member of Params is missing from fields()");
  return std::apply([](const auto&... f) { return std::vector<ParamSpec>{detail::to_spec(f)...}; }, P::fields());
}

/// Params from values by name; missing ones keep their default. Throws ParamError as checked() and resolve() do.
template <class P>
P make_params(const ParamSet& given) {
  const ParamSet all = resolve(param_specs<P>(), given);
  P params;
  std::apply([&](const auto&... f) { (detail::from_value(f, all.find(f.name)->second, params), ...); }, P::fields());
  return params;
}

/// Every parameter with its value: the effective configuration.
template <class P>
ParamSet to_param_set(const P& params) {
  ParamSet set;
  std::apply([&](const auto&... f) { (set.emplace(std::string(f.name), detail::to_value(f, params)), ...); },
             P::fields());
  return set;
}

/// The Params of a module without parameters.
struct NoParams {
  static auto fields() { return std::tuple<>{}; }
};

}  // namespace scanbench
