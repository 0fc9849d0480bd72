// Writes and reads the members of tar archives.
#include "harness/io/files/tar.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/error.hpp"

namespace scanbench::io {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::size_t kLargest = (std::size_t{1} << 33) - 1;  // eleven octal digits
constexpr char kFile = '0';
constexpr char kLongPath = 'L';  // of GNU: its bytes are the path of the next entry

/// Fields of the header: where they begin and their size.
struct Field {
  std::size_t begin, size;
};
constexpr Field kName{0, 100}, kMode{100, 8}, kOwner{108, 8}, kGroup{116, 8}, kSize{124, 12}, kTime{136, 12},
    kSum{148, 8}, kType{156, 1}, kMagicField{257, 8}, kPrefix{345, 155};

using Header = std::array<char, kBlock>;

void put(Header& header, Field field, std::string_view text) {
  std::ranges::copy(text, header.begin() + static_cast<std::ptrdiff_t>(field.begin));
}

/// Octal digits that fill the field but for the zero at its end.
void put_octal(Header& header, Field field, std::size_t value) {
  for (std::size_t i = field.size - 1; i-- > 0; value /= 8)
    header[field.begin + i] = static_cast<char>('0' + value % 8);
}

/// The sum of the bytes of the header, in which the field of the sum counts as blanks.
std::size_t sum_of(Header header) {
  std::fill_n(header.begin() + static_cast<std::ptrdiff_t>(kSum.begin), kSum.size, ' ');
  std::size_t sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  return sum;
}

/// The slash at which a path is divided into prefix and name; npos if there is none that fits both fields.
std::size_t slash_of(std::string_view path) {
  for (std::size_t at = path.find('/'); at != std::string_view::npos; at = path.find('/', at + 1))
    if (at > 0 && at <= kPrefix.size && path.size() - at - 1 <= kName.size) return at;
  return std::string_view::npos;
}

std::string entry(char type, std::string_view prefix, std::string_view name, std::string_view bytes) {
  Header header{};
  put(header, kName, name);
  put_octal(header, kMode, 0644);
  put_octal(header, kOwner, 0);
  put_octal(header, kGroup, 0);
  put_octal(header, kSize, bytes.size());
  put_octal(header, kTime, 0);
  header[kType.begin] = type;
  put(header, kMagicField, {"ustar\00000", 8});
  put(header, kPrefix, prefix);
  put_octal(header, {kSum.begin, kSum.size - 1}, sum_of(header));
  header[kSum.begin + kSum.size - 1] = ' ';
  std::string text(header.data(), kBlock);
  text += bytes;
  text.resize((text.size() + kBlock - 1) / kBlock * kBlock, '\0');
  return text;
}

std::string_view text_of(std::string_view header, Field field) {
  const std::string_view text = header.substr(field.begin, field.size);
  return text.substr(0, text.find('\0'));
}

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw ConfigError(file.string() + ": not an archive that scanbench has written, or it is damaged");
}

std::size_t octal_of(std::string_view header, Field field, const std::filesystem::path& file) {
  const std::string_view digits = header.substr(field.begin, field.size - 1);
  std::size_t value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 8);
  if (error != std::errc() || stop != digits.data() + digits.size()) refuse(file);
  return value;
}

bool has_its_sum(std::string_view text, const std::filesystem::path& file) {
  Header header;
  std::memcpy(header.data(), text.data(), kBlock);
  return octal_of(text, {kSum.begin, kSum.size - 1}, file) == sum_of(header);
}

}  // namespace

std::string tar_member(std::string_view path, std::string_view bytes) {
  if (bytes.size() > kLargest)
    throw ConfigError(std::string(path) + " has " + std::to_string(bytes.size()) +
                      " bytes; an archive holds files of less than 8 GiB");
  if (path.size() <= kName.size) return entry(kFile, "", path, bytes);
  if (const std::size_t slash = slash_of(path); slash != std::string_view::npos)
    return entry(kFile, path.substr(0, slash), path.substr(slash + 1), bytes);
  return entry(kLongPath, "", "././@LongLink", std::string(path) + '\0') +
         entry(kFile, "", path.substr(0, kName.size), bytes);
}

std::string tar_end() {
  std::string end(2 * kBlock, '\0');
  return end;
}

std::vector<TarMember> tar_members(std::string_view archive, const std::filesystem::path& file) {
  std::vector<TarMember> members;
  std::string long_path;
  while (!archive.empty()) {
    if (archive.size() < kBlock) refuse(file);
    const std::string_view header = archive.substr(0, kBlock);
    if (header.find_first_not_of('\0') == std::string_view::npos) break;  // the end
    if (header.substr(kMagicField.begin, 5) != "ustar" || !has_its_sum(header, file)) refuse(file);
    const std::size_t size = octal_of(header, kSize, file);
    const std::size_t blocks = (size + kBlock - 1) / kBlock * kBlock;
    if (blocks > archive.size() - kBlock) refuse(file);
    const std::string_view bytes = archive.substr(kBlock, size);
    archive.remove_prefix(kBlock + blocks);
    const char type = header[kType.begin];
    if (type == kLongPath) {
      long_path = bytes.substr(0, bytes.find('\0'));
      continue;
    }
    if (type != kFile) refuse(file);
    const std::string_view prefix = text_of(header, kPrefix);
    const std::string path = (prefix.empty() ? "" : std::string(prefix) + "/") + std::string(text_of(header, kName));
    members.push_back({long_path.empty() ? path : std::exchange(long_path, {}), bytes});
  }
  if (!long_path.empty()) refuse(file);
  return members;
}

}  // namespace scanbench::io
