// Calls of a program: the values of the interfaces of modules as named arrays of numbers.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"
#include "harness/study/foreign/frame.hpp"
#include "harness/study/foreign/program.hpp"
#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// Numbers per row of the arrays.
inline constexpr std::size_t kLineColumns = 10;       ///< ax ay bx by rho alpha first_beam last_beam points rms_m
inline constexpr std::size_t kCovarianceColumns = 3;  ///< of a line: var(offset) cov var(angle); NaN: not estimated
inline constexpr std::size_t kPoseColumns = 4;        ///< x y cos sin
inline constexpr std::size_t kMapColumns = 9;         ///< ax ay bx by var(offset) cov var(angle) members points

/// A call under construction.
class Call {
 public:
  explicit Call(std::string_view name);
  /// `numbers` must outlive the call.
  Call& view(std::string_view name, std::span<const double> numbers);
  Call& own(std::string_view name, std::vector<double> numbers);
  Call& key(std::string_view name, const nlohmann::json& value);
  /// The scan's ranges and time, and its lines: `<prefix>ranges`, `<prefix>lines`, `<prefix>covariances`,
  /// `<prefix>labels`.
  Call& scan(std::string_view prefix, const Scan& scan);
  Call& lines(std::string_view prefix, const ScanLines& lines);

  std::string header() const;  ///< without the closing brace
  std::span<const std::span<const double>> parts() const { return parts_; }

 private:
  std::string header_;
  std::string arrays_;
  std::vector<std::span<const double>> parts_;
  std::deque<std::vector<double>> owned_;
};

// Values to rows and back. Results throw InvalidResult for wrong lengths and numbers that must be whole.
std::vector<double> to_rows(std::span<const LineFeature> lines);
std::vector<double> covariance_rows(std::span<const LineFeature> lines);
std::vector<double> to_rows(std::span<const Pose2> poses);
std::vector<double> to_rows(std::span<const MapLine> lines);
ScanLines scan_lines_of(const Answer& answer);
std::vector<Pose2> poses_of(const Answer& answer, const std::string& name);
LineMap map_of(const Answer& answer);
Status status_of(const Answer& answer);

/// A program that has been told its parameters. It gets the sensor's data sheet whenever that differs from the one
/// before.
class Session {
 public:
  /// Throws ForeignFault, also for parameters that the program refuses.
  Session(const ForeignSource& source, const ParamSet& params, const ForeignSetting& setting);
  /// `scans`: how many scans the call is about; 0 for a call that only the limit of the cell ends.
  Answer send(Call call, const SensorModel* sensor, int scans);

 private:
  Program program_;
  double scan_seconds_;
  std::optional<SensorModel> told_;
};

}  // namespace scanbench::study
