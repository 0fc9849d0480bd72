// Reads and writes the descriptions of foreign modules.
#include "harness/study/foreign/hello.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/modules.hpp"
#include "core/names.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/study/foreign/fault.hpp"
#include "harness/study/foreign/frame.hpp"

namespace scanbench::study {
namespace {

using nlohmann::json;

constexpr std::array kKinds{LineExtractor::kKind, Aligner::kKind, ScanMatcher::kKind, Mapper::kKind,
                            SegmentMerger::kKind};
constexpr std::array kTypes{ParamType::boolean,     ParamType::integer,     ParamType::number,
                            ParamType::text,        ParamType::choice,      ParamType::number_list,
                            ParamType::number_rows, ParamType::named_points};

constexpr std::uint64_t kLargestInteger = std::numeric_limits<std::int64_t>::max();

[[noreturn]] void refuse(const std::string& what) {
  throw ForeignFault("describes itself wrongly: " + what);
}

[[noreturn]] void refuse_type(const std::string& key, const std::string& owner, const json& found,
                              const std::string& allowed) {
  refuse("`" + key + "` of " + owner + " is of the JSON type " + found.type_name() + "; allowed: " + allowed);
}

std::string text_of(const json& object, const std::string& key, const std::string& owner, bool required) {
  const auto found = object.find(key);
  if (found == object.end()) {
    if (required) refuse(owner + " has no `" + key + "`");
    return "";
  }
  if (!found->is_string()) refuse_type(key, owner, *found, "a text");
  return found->get<std::string>();
}

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 60 &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

/// A value of a parameter; `fallback` if the key is absent or null.
template <class T>
T value_of(const json& object, const std::string& key, const std::string& owner, T fallback,
           const std::string& allowed) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return fallback;
  try {
    return found->get<T>();
  } catch (const json::exception&) {
    refuse_type(key, owner, *found, allowed);
  }
}

ParamType type_named(const std::string& name) {
  for (const ParamType type : kTypes)
    if (to_string(type) == name) return type;
  std::vector<std::string> known;
  known.reserve(kTypes.size());
  for (const ParamType type : kTypes) known.emplace_back(to_string(type));
  refuse("a parameter has the type " + io::quoted_excerpt(name) + "; allowed: " + join(known));
}

/// Throws json::exception for a value of another type.
ParamValue typed(const json& value, ParamType type) {
  switch (type) {
    case ParamType::boolean:
      return value.get<bool>();
    case ParamType::integer:
      if (!value.is_number_integer() || (value.is_number_unsigned() && value.get<std::uint64_t>() > kLargestInteger))
        refuse("the default of an integer is " + io::json_line(value).substr(0, 60) +
               "; allowed: a whole number of 64 bits");
      return value.get<std::int64_t>();
    case ParamType::number:
      return value.get<double>();
    case ParamType::text:
    case ParamType::choice:
      return value.get<std::string>();
    case ParamType::number_list:
      return value.get<std::vector<double>>();
    case ParamType::number_rows:
      return value.get<NumberRows>();
    case ParamType::named_points: {
      NamedPoints points;
      for (const auto& [name, p] : value.items()) points.emplace_back(name, Vec2(p.at(0), p.at(1)));
      return points;
    }
  }
  throw InternalError("a parameter type without a reader");
}

ParamValue default_of(const json& object, const ParamSpec& spec) {
  const auto found = object.find("default");
  if (found == object.end()) refuse(spec.name + " has no `default`");
  try {
    return checked(spec, typed(*found, spec.type));
  } catch (const json::exception&) {
    refuse("`default` of " + spec.name + " is " + io::json_line(*found).substr(0, 60) +
           "; allowed: " + std::string(to_string(spec.type)));
  } catch (const ParamError& error) {
    refuse("the default of " + std::string(error.what()));
  }
}

ParamSpec read_spec(const json& object) {
  if (!object.is_object()) refuse("a parameter is not an object");
  ParamSpec spec;
  spec.name = text_of(object, "name", "a parameter", true);
  if (!is_name(spec.name))
    refuse("a parameter is called " + io::quoted_excerpt(spec.name) + "; allowed: a-z, 0-9 and _");
  spec.type = type_named(text_of(object, "type", spec.name, true));
  spec.unit = text_of(object, "unit", spec.name, false);
  spec.doc = text_of(object, "doc", spec.name, false);
  spec.bounds.min = value_of(object, "min", spec.name, -kInf, "a number");
  spec.bounds.max = value_of(object, "max", spec.name, kInf, "a number");
  spec.bounds.open_min = value_of(object, "open_min", spec.name, false, "true, false");
  spec.choices = value_of(object, "choices", spec.name, std::vector<std::string>(), "a list of texts");
  spec.default_value = default_of(object, spec);
  return spec;
}

ForeignModule read_checked(const json& hello) {
  ForeignModule module;
  module.kind = text_of(hello, "kind", "the module", true);
  if (std::ranges::find(kKinds, module.kind) == kKinds.end())
    refuse("its kind is " + io::quoted_excerpt(module.kind) +
           "; allowed: " + join(std::vector<std::string>(kKinds.begin(), kKinds.end())));
  module.info.name = text_of(hello, "name", "the module", true);
  if (!is_name(module.info.name))
    refuse("its name is " + io::quoted_excerpt(module.info.name) + "; allowed: up to 60 of a-z, 0-9 and _");
  module.version = text_of(hello, "version", "the module", true);
  module.info.summary = text_of(hello, "summary", "the module", false);
  module.info.reference = text_of(hello, "reference", "the module", false);
  if (const auto params = hello.find("params"); params != hello.end() && !params->is_null()) {
    if (!params->is_array()) refuse_type("params", "the module", *params, "a list of parameters");
    for (const auto& object : *params) {
      module.params.push_back(read_spec(object));
      if (std::ranges::count(module.params, module.params.back().name, &ParamSpec::name) > 1)
        refuse("two parameters are called " + module.params.back().name);
    }
  }
  return module;
}

struct ToJson {
  json operator()(const NamedPoints& points) const {
    json object = json::object();
    for (const auto& [name, p] : points) object[name] = {p.x(), p.y()};
    return object;
  }
  template <class T>
  json operator()(const T& other) const {
    return other;
  }
};

json value_json(const ParamValue& value) {
  return std::visit(ToJson{}, value);
}

}  // namespace

ForeignModule read_hello(const json& hello) {
  const auto protocol = hello.find("protocol");
  if (protocol == hello.end() || !protocol->is_number_integer())
    throw ForeignFault("does not say which version of the protocol it speaks (key `protocol`)");
  if (protocol->get<std::int64_t>() != kProtocolVersion)
    throw ForeignFault("speaks version " + io::json_line(*protocol) + " of the protocol; this program speaks version " +
                       std::to_string(kProtocolVersion));
  return read_checked(hello);
}

json to_hello(const ForeignModule& module) {
  json hello{{"protocol", kProtocolVersion},   {"kind", module.kind},
             {"name", module.info.name},       {"version", module.version},
             {"summary", module.info.summary}, {"reference", module.info.reference},
             {"params", json::array()}};
  for (const ParamSpec& spec : module.params) {
    json object{{"name", spec.name},
                {"type", to_string(spec.type)},
                {"default", value_json(spec.default_value)},
                {"unit", spec.unit},
                {"doc", spec.doc},
                {"open_min", spec.bounds.open_min}};
    if (std::isfinite(spec.bounds.min)) object["min"] = spec.bounds.min;
    if (std::isfinite(spec.bounds.max)) object["max"] = spec.bounds.max;
    if (!spec.choices.empty()) object["choices"] = spec.choices;
    hello["params"].push_back(std::move(object));
  }
  return hello;
}

json to_json(const ParamSet& params) {
  json object = json::object();
  for (const auto& [name, value] : params) object[name] = value_json(value);
  return object;
}

}  // namespace scanbench::study
