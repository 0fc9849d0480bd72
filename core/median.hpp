// The median of values, and the upper one of an even number.
#pragma once

#include <vector>

namespace scanbench {

/// The middle value, or the mean of the two middle ones. NaN for no values; values must not be NaN.
double median(std::vector<double> values);

/// The middle value, or the larger of the two middle ones: always one of the values. NaN for no values.
double upper_median(std::vector<double> values);

}  // namespace scanbench
