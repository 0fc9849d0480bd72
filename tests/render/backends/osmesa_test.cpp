// A missing OSMesa is an error that names the package to install.
#include "render/backends/osmesa.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.hpp"

namespace scanbench::render {
namespace {

using ::testing::HasSubstr;
using ::testing::Property;
using ::testing::Throws;

TEST(OsMesa, NamesThePackageToInstallIfTheLibraryIsMissing) {
  EXPECT_THAT([] { OsMesa("libno-such-library.so.1"); },
              Throws<ConfigError>(Property(&ConfigError::what, HasSubstr("install libosmesa6"))));
}

TEST(OsMesa, NamesTheFunctionThatALibraryLacks) {
  EXPECT_THAT([] { OsMesa("libc.so.6"); },
              Throws<ConfigError>(Property(&ConfigError::what, HasSubstr("OSMesaCreateContextExt"))));
}

TEST(OsMesa, DrawsWithTheDefaultRasterizerWhateverTheEnvironmentSays) {
  ::setenv("GALLIUM_DRIVER", "softpipe", 1);
  const OsMesa gl;
  EXPECT_EQ(std::getenv("GALLIUM_DRIVER"), nullptr);
}

TEST(OsMesa, OfTheSystemHasAllFunctions) {
  EXPECT_NO_THROW(OsMesa());
}

}  // namespace
}  // namespace scanbench::render
