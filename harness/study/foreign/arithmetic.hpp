// Floating-point arithmetic of this thread, which a foreign library may change for all that is computed after it.
#pragma once

#include <xmmintrin.h>

#include <cfenv>

namespace scanbench::study {

/// Rounding to nearest, with denormals, as the thread began. A changed mode would change every metric.
class Arithmetic {
 public:
  /// Restores what was in force when this object was made. True if it had been changed.
  bool restore() const {
    const bool changed = (_mm_getcsr() & kModes) != modes_ || std::fegetround() != rounding_;
    if (!changed) return false;
    std::fesetround(rounding_);  // also of the x87 unit
    _mm_setcsr((_mm_getcsr() & ~kModes) | modes_);
    return true;
  }

 private:
  static constexpr unsigned kModes = 0xffc0;  ///< of MXCSR: all but the flags of past exceptions

  unsigned modes_ = _mm_getcsr() & kModes;
  int rounding_ = std::fegetround();
};

}  // namespace scanbench::study
