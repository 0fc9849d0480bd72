// Faults of a foreign module.
#pragma once

#include <stdexcept>
#include <string>

namespace scanbench::study {

/// A program broke the protocol, ended, did not answer in time or could not be started; a library could not be loaded.
class ForeignFault : public std::runtime_error {
 public:
  enum class Kind { other, ended, timeout, memory };
  explicit ForeignFault(const std::string& what, Kind kind = Kind::other) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace scanbench::study
