// Reads text files through zlib, which returns plain files unchanged.
#include "harness/io/files/text_file.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "harness/io/files/input_file.hpp"

namespace scanbench::io {
namespace {

struct CloseGz {
  void operator()(gzFile_s* file) const { gzclose_r(file); }
};

/// Line and column of the next character, both from 1.
struct TextPlace {
  std::uint64_t line = 1;
  std::uint64_t column = 1;
  void advance(std::string_view text) {
    const std::size_t last_break = text.rfind('\n');
    line += static_cast<std::uint64_t>(std::ranges::count(text, '\n'));
    column = last_break == std::string_view::npos ? column + text.size() : text.size() - last_break;
  }
};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

}  // namespace

struct TextBlocks::Reader {
  explicit Reader(const std::filesystem::path& path) : input(path) {}

  InputFile input;
  std::unique_ptr<gzFile_s, CloseGz> file;
  std::vector<char> block = std::vector<char>(1 << 20);
  std::uint64_t bytes = 0;
  TextPlace place;
};

TextBlocks::TextBlocks(const std::filesystem::path& path, std::uint64_t max_bytes, std::string_view allowed)
    : max_bytes_(max_bytes), allowed_(allowed), reader_(std::make_unique<Reader>(path)) {
  reader_->input.require_at_most(max_bytes);
  const int descriptor = reader_->input.duplicate();
  reader_->file.reset(gzdopen(descriptor, "rb"));
  if (reader_->file == nullptr) {
    ::close(descriptor);
    throw ConfigError(path.string() + ": cannot be opened: out of memory");
  }
  gzbuffer(reader_->file.get(), 256 * 1024);
}

TextBlocks::~TextBlocks() = default;

std::string_view TextBlocks::next() {
  Reader& reader = *reader_;
  const std::string name = reader.input.path().string();
  const int n = gzread(reader.file.get(), reader.block.data(), static_cast<unsigned>(reader.block.size()));
  int code = Z_OK;
  const char* message = gzerror(reader.file.get(), &code);
  // zlib returns the data of a gzip file that ends early, with the code Z_BUF_ERROR.
  if (n < 0 || code == Z_BUF_ERROR)
    throw ConfigError(fmt::format("{}: {} after {} unpacked bytes; allowed: a whole gzip file", name,
                                  code == Z_BUF_ERROR ? "the gzip data ends early"
                                  : code == Z_ERRNO   ? std::strerror(errno)
                                                      : message,
                                  reader.bytes + static_cast<std::uint64_t>(std::max(n, 0))));
  const std::string_view text(reader.block.data(), static_cast<std::size_t>(n));
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    reader.place.advance(text.substr(0, nul));
    throw ConfigError(
        fmt::format("{}:{}:{}: a byte 0; allowed: {}", name, reader.place.line, reader.place.column, allowed_));
  }
  reader.place.advance(text);
  reader.bytes += text.size();
  if (reader.bytes > max_bytes_)
    throw ConfigError(fmt::format("{}: larger than {}{}", name, size_text(static_cast<double>(max_bytes_)),
                                  reader.bytes > reader.input.size() ? " when unpacked" : ""));
  return text;
}

void for_each_text_block(const std::filesystem::path& path, std::uint64_t max_bytes, std::string_view allowed,
                         const std::function<void(std::string_view)>& use) {
  TextBlocks blocks(path, max_bytes, allowed);
  for (std::string_view text = blocks.next(); !text.empty(); text = blocks.next()) use(text);
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes, std::string_view allowed) {
  std::string text;
  std::error_code error;
  if (const auto size = std::filesystem::file_size(path, error); !error) text.reserve(std::min(size, max_bytes));
  for_each_text_block(path, max_bytes, allowed, [&](std::string_view block) { text += block; });
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

}  // namespace scanbench::io
