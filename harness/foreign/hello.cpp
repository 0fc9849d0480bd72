// Reads and writes the descriptions of foreign modules.
#include "harness/foreign/hello.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/modules.hpp"
#include "core/names.hpp"
#include "harness/foreign/fault.hpp"
#include "harness/foreign/frame.hpp"

namespace scanbench::harness {
namespace {

using nlohmann::json;

constexpr std::array kKinds{LineExtractor::kKind, Aligner::kKind, ScanMatcher::kKind, Mapper::kKind,
                            SegmentMerger::kKind};
constexpr std::array kTypes{ParamType::boolean,     ParamType::integer,     ParamType::number,
                            ParamType::text,        ParamType::choice,      ParamType::number_list,
                            ParamType::number_rows, ParamType::named_points};

[[noreturn]] void refuse(const std::string& what) {
  throw ForeignFault("describes itself wrongly: " + what);
}

std::string text_of(const json& object, const std::string& key, const std::string& owner, bool required) {
  const auto found = object.find(key);
  if (found == object.end()) {
    if (required) refuse(owner + " has no `" + key + "`");
    return "";
  }
  if (!found->is_string()) refuse("`" + key + "` of " + owner + " is no text");
  return found->get<std::string>();
}

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 60 &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

double number_of(const json& object, const std::string& key, double fallback) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return fallback;
  if (!found->is_number()) refuse("`" + key + "` of a parameter is no number");
  return found->get<double>();
}

ParamType type_named(const std::string& name) {
  for (const ParamType type : kTypes)
    if (to_string(type) == name) return type;
  std::vector<std::string> known;
  for (const ParamType type : kTypes) known.emplace_back(to_string(type));
  refuse("a parameter has the type '" + name + "'; allowed: " + join(known));
}

ParamValue value_of(const json& value, ParamType type) {
  switch (type) {
    case ParamType::boolean:
      return value.get<bool>();
    case ParamType::integer:
      if (!value.is_number_integer()) refuse("the default of an integer is no whole number");
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

ParamSpec read_spec(const json& object) {
  if (!object.is_object()) refuse("a parameter is no object");
  ParamSpec spec;
  spec.name = text_of(object, "name", "a parameter", true);
  if (!is_name(spec.name)) refuse("a parameter is called '" + spec.name + "'; allowed: a-z, 0-9 and _");
  spec.type = type_named(text_of(object, "type", spec.name, true));
  spec.unit = text_of(object, "unit", spec.name, false);
  spec.doc = text_of(object, "doc", spec.name, false);
  spec.bounds.min = number_of(object, "min", -kInf);
  spec.bounds.max = number_of(object, "max", kInf);
  spec.bounds.open_min = object.value("open_min", false);
  if (const auto found = object.find("choices"); found != object.end())
    spec.choices = found->get<std::vector<std::string>>();
  if (!object.contains("default")) refuse(spec.name + " has no `default`");
  spec.default_value = value_of(object.at("default"), spec.type);
  try {
    spec.default_value = checked(spec, spec.default_value);
  } catch (const ParamError& error) {
    refuse("the default of " + std::string(error.what()));
  }
  return spec;
}

ForeignModule read_checked(const json& hello) {
  ForeignModule module;
  module.kind = text_of(hello, "kind", "the module", true);
  if (std::ranges::find(kKinds, module.kind) == kKinds.end())
    refuse("its kind is '" + module.kind +
           "'; allowed: " + join(std::vector<std::string>(kKinds.begin(), kKinds.end())));
  module.info.name = text_of(hello, "name", "the module", true);
  if (!is_name(module.info.name)) refuse("its name is '" + module.info.name + "'; allowed: a-z, 0-9 and _");
  module.version = text_of(hello, "version", "the module", true);
  module.info.summary = text_of(hello, "summary", "the module", false);
  module.info.reference = text_of(hello, "reference", "the module", false);
  if (const auto params = hello.find("params"); params != hello.end())
    for (const auto& object : *params) {
      module.params.push_back(read_spec(object));
      if (std::ranges::count(module.params, module.params.back().name, &ParamSpec::name) > 1)
        refuse("two parameters are called " + module.params.back().name);
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
  if (protocol->get<int>() != kProtocolVersion)
    throw ForeignFault("speaks version " + protocol->dump() + " of the protocol; this program speaks version " +
                       std::to_string(kProtocolVersion));
  try {
    return read_checked(hello);
  } catch (const json::exception& error) {
    refuse(error.what());
  }
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

}  // namespace scanbench::harness
