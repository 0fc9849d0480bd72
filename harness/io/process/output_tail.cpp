// Shortens the output of a process for a message.
#include "harness/io/process/output_tail.hpp"

namespace scanbench::io {
namespace {

/// True within a character of UTF-8 of several bytes.
bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

std::string shortened_line(std::string_view line) {
  if (line.size() <= kTailLineBytes) return std::string(line);
  std::size_t head = kTailLineBytes / 2;
  std::size_t tail = line.size() - kTailLineBytes / 2;
  while (head > 0 && is_continuation(line[head])) --head;
  while (tail < line.size() && is_continuation(line[tail])) ++tail;
  return std::string(line.substr(0, head)) + " [" + std::to_string(tail - head) + " bytes left out] " +
         std::string(line.substr(tail));
}

}  // namespace

std::string output_tail(std::string_view output) {
  const bool ends_line = output.ends_with('\n');
  if (ends_line) output.remove_suffix(1);
  std::size_t begin = output.size();
  for (std::size_t lines = 0; begin > 0; --begin)
    if (output[begin - 1] == '\n' && ++lines == kTailLines) break;
  std::string text;
  for (std::string_view rest = output.substr(begin);;) {
    const std::size_t end = rest.find('\n');
    text += shortened_line(rest.substr(0, end));
    if (end == std::string_view::npos) break;
    text += '\n';
    rest.remove_prefix(end + 1);
  }
  return text + (ends_line ? "\n" : "");
}

}  // namespace scanbench::io
