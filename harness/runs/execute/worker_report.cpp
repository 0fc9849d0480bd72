// Runs a task, and writes and reads the report of its outcome: a line of numbers, then the texts.
#include "harness/runs/execute/worker_report.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/study/foreign/fault.hpp"

namespace scanbench::runs {
namespace {

constexpr std::size_t kLongestLine = 240;                      // bytes of the line of numbers
constexpr std::size_t kMessageLimit = std::size_t{16} * 1024;  // bytes kept of an exception's message

/// Cuts an exception's message, because a module may write one of any length.
std::string shortened(std::string text) {
  if (text.size() <= kMessageLimit) return text;
  const std::string rest = std::to_string(text.size() - kMessageLimit);
  text.resize(kMessageLimit);
  return text + " [" + rest + " more bytes]";
}

WorkerReport failure(CellStatus status, const std::string& message) {
  return {{.status = status, .message = shortened(message)}};
}

CellStatus status_of(study::ForeignFault::Kind kind) {
  switch (kind) {
    case study::ForeignFault::Kind::ended:
      return CellStatus::crashed;
    case study::ForeignFault::Kind::timeout:
      return CellStatus::timeout;
    case study::ForeignFault::Kind::memory:
      return CellStatus::out_of_memory;
    default:
      return CellStatus::failed;
  }
}

}  // namespace

WorkerReport perform(const std::function<TaskOutput()>& task) {
  try {
    TaskOutput output = task();
    WorkerOutcome outcome{.status = CellStatus::ok, .message = std::exchange(output.message, "")};
    return {std::move(outcome), std::move(output)};
  } catch (const std::bad_alloc&) {
    return {{.status = CellStatus::out_of_memory, .message = ""}};
  } catch (const InvalidResult& e) {
    return failure(CellStatus::invalid, e.what());
  } catch (const io::SystemError& e) {
    return {{.message = shortened(e.what()), .system_error = true}};
  } catch (const std::filesystem::filesystem_error& e) {
    return {{.message = shortened(e.what()), .system_error = true}};
  } catch (const ConfigError& e) {
    return {{.message = shortened(e.what()), .bad_input = true}};
  } catch (const study::ForeignFault& e) {
    return failure(status_of(e.kind()), e.what());
  } catch (const InternalError& e) {
    return failure(CellStatus::failed, std::string("internal error: ") + e.what());
  } catch (const std::exception& e) {
    return failure(CellStatus::failed, e.what());
  } catch (...) {
    return failure(CellStatus::failed, "an exception that is not a std::exception");
  }
}

std::string report_bytes(const WorkerReport& report) {
  const WorkerOutcome& outcome = report.outcome;
  const TaskOutput& output = report.output;
  std::array<char, kLongestLine> numbers{};
  const int size = std::snprintf(numbers.data(), numbers.size(), "%d %d %d %.9g %.9g %zu %zu %zu %zu\n",
                                 static_cast<int>(outcome.status), static_cast<int>(outcome.bad_input),
                                 static_cast<int>(outcome.system_error), outcome.cpu_seconds, outcome.peak_memory_bytes,
                                 outcome.message.size(), output.content_hash.size(), output.summary.size(),
                                 output.file_hashes.size());
  return std::string(numbers.data(), static_cast<std::size_t>(size)) + outcome.message + output.content_hash +
         output.summary + output.file_hashes;
}

std::optional<WorkerReport> take_report(std::string& bytes) {
  std::array<double, 9> numbers{};
  const std::string_view line = std::string_view(bytes).substr(0, kLongestLine);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t end = line.find(i + 1 < numbers.size() ? ' ' : '\n', begin);
    if (end == std::string_view::npos) return std::nullopt;
    const auto number = parse_number(line.substr(begin, end - begin));
    if (!number || !(*number >= 0.0)) return std::nullopt;
    numbers[i] = *number;
    begin = end + 1;
  }
  const auto [status, bad_input, system_error, cpu_seconds, peak_bytes, message, content_hash, summary, file_hashes] =
      numbers;
  if (status > static_cast<double>(CellStatus::out_of_memory)) return std::nullopt;
  if (static_cast<double>(bytes.size() - begin) < message + content_hash + summary + file_hashes) return std::nullopt;
  const auto take = [&](double size) {
    std::string text = bytes.substr(begin, static_cast<std::size_t>(size));
    begin += text.size();
    return text;
  };
  WorkerReport report{{.status = static_cast<CellStatus>(static_cast<int>(status)),
                       .message = take(message),
                       .cpu_seconds = cpu_seconds,
                       .peak_memory_bytes = peak_bytes,
                       .bad_input = bad_input != 0.0,
                       .system_error = system_error != 0.0}};
  report.output.content_hash = take(content_hash);
  report.output.summary = take(summary);
  report.output.file_hashes = take(file_hashes);
  bytes.erase(0, begin);
  return report;
}

}  // namespace scanbench::runs
