// docs/modules.md has the program's own description of its modules.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "harness/report/catalog.hpp"
#include "tests/support/places.hpp"

namespace scanbench {
namespace {

TEST(ModulesDocument, IsWhatDescribeAllPrints) {
  std::ifstream file(places::source_dir() / "docs/modules.md");
  ASSERT_TRUE(file);
  const std::string document((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(document, harness::catalog_markdown(harness::catalog()))
      << "write it again: ./scanbench describe --all --markdown > docs/modules.md";
}

}  // namespace
}  // namespace scanbench
