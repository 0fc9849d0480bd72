// Checks that every module of a kind must pass. The conformance tests and `scanbench module conform` run them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/params.hpp"

namespace scanbench::study::conform {

/// What a check found wrong; the first few faults are kept.
class Findings {
 public:
  /// Adds `fault` unless the condition holds.
  void expect(bool condition, const std::string& fault) {
    if (!condition && faults_.size() < kMost) faults_.push_back(fault);
  }
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  static constexpr std::size_t kMost = 3;
  std::vector<std::string> faults_;
};

/// A module under test: its parameters, and a maker of instances.
template <class Interface>
struct Subject {
  std::vector<ParamSpec> params;
  std::function<std::unique_ptr<Interface>(const ParamSet&)> make;
};

template <class Interface>
struct Check {
  std::string name;  ///< a sentence in CamelCase, as the tests are named
  std::function<void(const Subject<Interface>&, Findings&)> run;
};

}  // namespace scanbench::study::conform
