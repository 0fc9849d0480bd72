// Schemas of trace rows: a struct per kind of row, with one list of its columns that writer and reader share.
//
//   struct RoundRow {
//     static constexpr std::string_view kName = "round";
//     int round = 0;
//     double gate_m = 0.0;
//     static constexpr auto columns() {
//       return std::tuple{column("round", &RoundRow::round), column("gate_m", &RoundRow::gate_m)};
//     }
//   };
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/params.hpp"

namespace scanbench {

template <class Row, class T>
struct TraceColumn {
  std::string_view name;
  T Row::*member;
};

/// An index or a count (int), or a measured value (double; the name ends in its unit).
template <class Row, class T>
requires(std::same_as<T, int> || std::same_as<T, double>) constexpr TraceColumn<Row, T> column(std::string_view name,
                                                                                               T Row::*member) {
  return {name, member};
}

/// A struct with a name and a list of all its members as columns.
template <class Row>
concept TraceRowType = requires {
  { Row::kName } -> std::convertible_to<std::string_view>;
  Row::columns();
};

/// The name and the columns of a kind of row, for listeners.
struct TraceSchema {
  std::string_view name;
  std::vector<std::string_view> columns;
};

template <TraceRowType Row>
inline constexpr std::size_t kColumns = std::tuple_size_v<decltype(Row::columns())>;

template <TraceRowType Row>
const TraceSchema& schema_of() {
  static_assert(detail::member_count<Row>() == kColumns<Row>, "a member of the row is missing from columns()");
  static const TraceSchema schema{
      Row::kName,
      std::apply([](const auto&... c) { return std::vector<std::string_view>{c.name...}; }, Row::columns())};
  return schema;
}

template <TraceRowType Row>
std::array<double, kColumns<Row>> values_of(const Row& row) {
  return std::apply(
      [&](const auto&... c) { return std::array<double, kColumns<Row>>{static_cast<double>(row.*c.member)...}; },
      Row::columns());
}

namespace detail {

inline bool read_value(double value, double& member) {
  member = value;
  return true;
}
inline bool read_value(double value, int& member) {
  if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::floor(value)) return false;
  member = static_cast<int>(value);
  return true;
}

}  // namespace detail

/// nullopt if the values do not fit the schema: another number of them, or an index that is not a whole number.
template <TraceRowType Row>
std::optional<Row> row_from(std::span<const double> values) {
  if (values.size() != kColumns<Row>) return std::nullopt;
  Row row;
  std::size_t i = 0;
  const bool fits = std::apply(
      [&](const auto&... c) { return (detail::read_value(values[i++], row.*c.member) && ...); }, Row::columns());
  return fits ? std::optional(row) : std::nullopt;
}

}  // namespace scanbench
