// Names of statuses in files.
#include "core/match.hpp"

namespace scanbench {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::max_iterations:
      return "max_iterations";
    case Status::degenerate:
      return "degenerate";
    case Status::no_match:
      return "no_match";
  }
  return "unknown";
}

}  // namespace scanbench
