// docs/gallery.md shows what the catalogue of the tree makes.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <regex>
#include <string>

#include "harness/io/files/atomic_file.hpp"
#include "harness/results/gallery/catalogue.hpp"
#include "tests/support/places.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

TEST(GalleryPage, NamesEveryEntryOfTheCatalogueAndShowsPicturesThatExist) {
  const fs::path docs = places::source_dir() / "docs";
  const std::string page = io::read_file(docs / "gallery.md");
  const Catalogue catalogue = load_catalogue(places::source_dir() / "scenarios/figures.yaml");
  std::size_t drawn = 0;
  for (const CatalogueEntry& entry : catalogue.entries) {
    EXPECT_TRUE(page.find("--entry " + entry.name + "`") != std::string::npos) << entry.name;
    drawn += entry.figure.size();
  }
  for (const AbsentEntry& entry : catalogue.absent)
    EXPECT_TRUE(page.find(": " + entry.why) != std::string::npos) << entry.of;
  const std::regex picture(R"(\]\((images/gallery/[^)]+)\))");
  std::size_t shown = 0;
  for (auto it = std::sregex_iterator(page.begin(), page.end(), picture); it != std::sregex_iterator(); ++it, ++shown)
    EXPECT_TRUE(fs::exists(docs / (*it)[1].str())) << (*it)[1];
  EXPECT_GE(shown, drawn);
  std::uintmax_t bytes = 0;
  for (const auto& file : fs::directory_iterator(docs / "images/gallery")) bytes += file.file_size();
  EXPECT_LT(bytes, std::uintmax_t{2} << 20);
}

}  // namespace
}  // namespace scanbench::results
