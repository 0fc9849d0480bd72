// Records every row of an algorithm's trace.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/trace.hpp"

namespace scanbench::testing {

class TraceRecorder : public Trace {
 public:
  bool recording() const override { return true; }
  void write(std::string_view name, std::span<const double> row) override {
    rows[std::string(name)].emplace_back(row.begin(), row.end());
  }
  std::map<std::string, std::vector<std::vector<double>>> rows;
};

}  // namespace scanbench::testing
