// Reading files through zlib, which passes plain files on as they are.
#include "harness/files/text_file.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <algorithm>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <system_error>

#include "core/error.hpp"

namespace scanbench::harness {
namespace {

struct CloseGz {
  void operator()(gzFile_s* file) const { gzclose_r(file); }
};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

}  // namespace

std::string size_text(double bytes) {
  static constexpr std::array<const char*, 6> kUnits = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  while (bytes >= 1024.0 && unit + 1 < kUnits.size()) {
    bytes /= 1024.0;
    ++unit;
  }
  return bytes == std::floor(bytes) ? fmt::format("{:.0f} {}", bytes, kUnits[unit])
                                    : fmt::format("{:.1f} {}", bytes, kUnits[unit]);
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
  const std::string name = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw ConfigError(name + ": no such file");
  if (!std::filesystem::is_regular_file(status))
    throw ConfigError(name + ": not a regular file; allowed: a file, plain or gzip");

  const std::unique_ptr<gzFile_s, CloseGz> file(gzopen(name.c_str(), "rb"));
  if (file == nullptr) throw ConfigError(name + ": cannot be opened: " + std::strerror(errno));
  gzbuffer(file.get(), 256 * 1024);

  std::string text;
  std::vector<char> block(1 << 20);
  while (true) {
    const int n = gzread(file.get(), block.data(), static_cast<unsigned>(block.size()));
    int code = Z_OK;
    const char* message = gzerror(file.get(), &code);
    // A gzip file that ends early still hands out what it has; zlib says Z_BUF_ERROR then.
    if (n < 0 || code == Z_BUF_ERROR)
      throw ConfigError(fmt::format("{}: {} after {} unpacked bytes; allowed: a whole gzip file", name,
                                    code == Z_BUF_ERROR ? "the gzip data ends early"
                                    : code == Z_ERRNO   ? std::strerror(errno)
                                                        : message,
                                    text.size() + static_cast<std::size_t>(std::max(n, 0))));
    if (n == 0) break;
    text.append(block.data(), static_cast<std::size_t>(n));
    if (text.size() > max_bytes)
      throw ConfigError(fmt::format("{}: larger than {}; allowed: up to {}", name,
                                    size_text(static_cast<double>(max_bytes)),
                                    size_text(static_cast<double>(max_bytes))));
  }
  return text;
}

std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t i = 0;
  while (true) {
    while (i < line.size() && is_blank(line[i])) ++i;
    if (i == line.size()) return;
    const std::size_t begin = i;
    while (i < line.size() && !is_blank(line[i])) ++i;
    words.push_back(line.substr(begin, i - begin));
  }
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t i = 0;
  const auto skip_blanks = [&] {
    while (i < line.size() && is_blank(line[i])) ++i;
  };
  skip_blanks();
  bool after_comma = false;
  while (i < line.size() || after_comma) {
    const std::size_t begin = i;
    while (i < line.size() && !is_blank(line[i]) && line[i] != ',') ++i;
    fields.push_back(line.substr(begin, i - begin));
    skip_blanks();
    after_comma = i < line.size() && line[i] == ',';
    if (after_comma) ++i;
    skip_blanks();
  }
}

int column_of(std::string_view line, std::string_view word) {
  return static_cast<int>(word.data() - line.data()) + 1;
}

std::string quoted_excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  for (const char c : text.substr(0, kLongest)) result += (c >= 0 && c < ' ') || c == 127 ? '?' : c;
  return result + (text.size() > kLongest ? "...'" : "'");
}

}  // namespace scanbench::harness
