// Damages files at random: the same seed gives the same damage.
#pragma once

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace scanbench::app_test {

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// 0 .. n - 1
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  /// The bytes with one to three faults.
  std::string mutated(std::string bytes) {
    for (std::size_t i = 0, n = 1 + below(3); i < n; ++i) mutate(bytes);
    return bytes;
  }

  /// Damages one file below the folder, or its name. Returns what was done.
  std::string mutate_one(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.symlink_status().type() == fs::file_type::regular) files.push_back(entry.path());
    if (files.empty()) return "nothing is left";
    std::ranges::sort(files);
    const fs::path file = files.at(below(files.size()));
    const std::string name = file.lexically_relative(folder).string();
    switch (below(10)) {
      case 0:
        return replace_by_something_else(file) + " " + name;
      case 1: {
        const fs::path other = files.at(below(files.size()));
        if (other != file) fs::copy_file(other, file, fs::copy_options::overwrite_existing);
        return "copied " + other.lexically_relative(folder).string() + " to " + name;
      }
      default:
        write(file, mutated(read(file)));
        return "changed " + name;
    }
  }

 private:
  static void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

  std::string replace_by_something_else(const fs::path& file) {
    fs::remove(file);
    switch (below(4)) {
      case 0:
        return "removed";
      case 1:
        fs::create_directory(file);
        return "made a folder of";
      case 2:
        fs::create_symlink(file.filename(), file);
        return "made a link to itself of";
      default:
        mkfifo(file.c_str(), 0600);
        return "made a FIFO of";
    }
  }

  void mutate(std::string& bytes) {
    const std::size_t at = below(bytes.size() + 1), length = below(std::min<std::size_t>(bytes.size() - at, 64) + 1);
    switch (below(7)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        for (std::size_t i = 0; i < length; ++i) bytes[at + i] = static_cast<char>(below(256));
        break;
      default:
        replace_number(bytes, at);
    }
  }

  /// The first number after a place becomes something that a number should not be.
  void replace_number(std::string& bytes, std::size_t at) {
    static const std::array<std::string, 12> kBad{
        "-1", "0", "1e308", "nan", "inf", "99999999999999999999", "4294967296", "0.5", "", "[[[", "x", "\"\"",
    };
    const auto is_number = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
    while (at < bytes.size() && !is_number(bytes[at])) ++at;
    std::size_t end = at;
    while (end < bytes.size() && is_number(bytes[end])) ++end;
    bytes.replace(at, end - at, kBad.at(below(kBad.size())));
  }

  std::mt19937_64 random_;
};

}  // namespace scanbench::app_test
