// Longer steps for iterations that approach their limit slowly along a line: the accelerated ICP of Besl & McKay 1992,
// section IV.C.
#pragma once

#include <Eigen/Core>

namespace scanbench::matching {

/// Watches the steps of an iteration and the errors before them. While three successive steps differ in direction by
/// less than 10 degrees, the errors at their starts are those of a walk along a line: the parabola through the last
/// three errors says where along it the least is.
///
/// Departure: the paper also extrapolates the line through the errors to an error of zero. Noisy scans never get there.
class Extrapolation {
 public:
  /// By how much the step is to be lengthened: 1 .. 25 (the paper's limit). `step` is in metres along all three axes;
  /// `error` is the mean square before it. The caller takes the lengthened step.
  double factor(const Eigen::Vector3d& step, double error);

 private:
  struct Taken {
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    double error = 0.0;
  };
  Taken last_;
  Taken last_but_one_;
};

}  // namespace scanbench::matching
