// What a foreign module says of itself, as JSON: the answer of a program to `hello`, and of a library in a child
// process.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// Reads {"protocol": 1, "kind": "extract", "name": ..., "version": ..., "summary": ..., "reference": ..., "params":
/// [{"name": ..., "type": "number", "default": 0.1, "min": 0, "open_min": true, "max": 1, "unit": "m", "doc": ...}]}.
/// Throws ForeignFault for another protocol, a missing key, a default that the parameter itself refuses.
ForeignModule read_hello(const nlohmann::json& hello);

/// The reverse of read_hello().
nlohmann::json to_hello(const ForeignModule& module);

/// Parameters as a JSON object.
nlohmann::json to_json(const ParamSet& params);

}  // namespace scanbench::study
