// Keeps lines of summary.csv in a file of the memory file system, which fork() does not copy.
#include "harness/runs/execute/summary_rows.hpp"

#include <cerrno>
#include <cstring>

#include <sys/mman.h>
#include <unistd.h>

#include "harness/io/files/system_error.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::runs {
namespace {

[[noreturn]] void refuse() {
  throw io::SystemError(std::string("cannot keep the rows of the summary: ") + std::strerror(errno));
}

}  // namespace

SummaryRows::SummaryRows(std::size_t cells) : file_(::memfd_create("summary", MFD_CLOEXEC)), places_(cells) {
  if (file_ < 0) refuse();
}

SummaryRows::~SummaryRows() {
  ::close(file_);
}

void SummaryRows::set(std::size_t cell, std::string_view lines) {
  places_[cell] = {end_, lines.size()};
  while (!lines.empty()) {
    const ssize_t n = ::pwrite(file_, lines.data(), lines.size(), static_cast<off_t>(end_));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) refuse();
    end_ += static_cast<std::uint64_t>(n);
    lines.remove_prefix(static_cast<std::size_t>(n));
  }
}

std::string SummaryRows::text() const {
  std::string all(end_, '\0');
  for (std::size_t filled = 0; filled < all.size();) {
    const ssize_t n = ::pread(file_, all.data() + filled, all.size() - filled, static_cast<off_t>(filled));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) refuse();
    filled += static_cast<std::size_t>(n);
  }
  std::string text = summary_header();
  text.reserve(text.size() + all.size());
  for (const Place& place : places_) text.append(all, place.begin, place.size);
  return text;
}

}  // namespace scanbench::runs
