// The blocks of code in a page of docs/, and their commands run in a folder.
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace scanbench::app_test {

/// The texts of all blocks in this language, in their order.
inline std::vector<std::string> page_blocks(const std::string& text, const std::string& language) {
  std::vector<std::string> blocks;
  std::string line;
  std::istringstream in(text);
  for (bool inside = false; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = line == "```" + language;
      if (inside) blocks.emplace_back();
    } else if (inside) {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

/// Runs the lines of all `sh` blocks in a folder, one after the other, and returns their number. The first one that
/// ends with another exit code than 0 fails the test, and no further one is run.
inline int run_commands_of_page(const std::string& text, const Folder& folder) {
  int count = 0;
  for (const std::string& block : page_blocks(text, "sh")) {
    std::istringstream commands(block);
    for (std::string command; std::getline(commands, command); ++count) {
      const std::string all = "cd " + folder.path().string() + " && { " + command + "; } >log 2>&1";
      const int status = std::system(all.c_str());
      EXPECT_EQ(status, 0) << command << "\n" << read(folder / "log");
      if (status != 0) return count;
    }
  }
  return count;
}

}  // namespace scanbench::app_test
