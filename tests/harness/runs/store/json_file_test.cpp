// JSON files of a run that are refused.
#include "harness/runs/store/json_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include "core/error.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string nested(int levels) {
  return "{\"a\": " + std::string(static_cast<std::size_t>(levels), '[') +
         std::string(static_cast<std::size_t>(levels), ']') + "}";
}

TEST(JsonFile, RefusesWhatIsNoObjectOfReasonableDepthAndNamesTheFile) {
  const support::TemporaryFolder folder;
  const auto refusal = [&](const std::string& bytes) {
    const fs::path file = folder.write("x.json", bytes);
    return support::config_refusal([&] { load_json_object(file); });
  };
  EXPECT_EQ(refusal("{\"a\": 1}"), "");
  EXPECT_EQ(refusal(nested(20)), "");
  for (const std::string& bad :
       {std::string(), std::string("[]"), std::string("{\"a\": "), std::string("\xff"), nested(100000)})
    EXPECT_THAT(refusal(bad), HasSubstr("x.json: ")) << bad.substr(0, 20);
}

TEST(RunFiles, OfBenchmarksAreCheckedLikeAllOthers) {
  const support::TemporaryFolder folder;
  for (const std::string& bad : {std::string("[]"), std::string(R"({"about": 1})"), nested(100000)}) {
    folder.write("benchmark.json", bad);
    EXPECT_THAT(support::config_refusal([&] { load_benchmark(folder.path()); }), HasSubstr("benchmark.json: "));
  }
}

TEST(JsonFile, IsReadAsTheLibraryReadsIt) {
  const support::TemporaryFolder folder;
  for (const std::string text :
       {R"({"a": [1, -2, 2.5, "t", true, null, [], {}, [[3], {"x": 4}]], "o": {"y": [5]}, "a": 2})", "7", "\"t\""})
    EXPECT_EQ(load_json(folder.write("x.json", text)), nlohmann::ordered_json::parse(text));
}

TEST(JsonFile, CountsOnlyBracketsOutsideOfStringsAsLevels) {
  const support::TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    return support::config_refusal([&] { load_json(folder.write("x.json", text)); });
  };
  EXPECT_EQ(refusal("{\"" + std::string(100, '[') + "\\\"{{\": \"\\\\\"}"), "");
  EXPECT_EQ(refusal(nested(31)), "");
  EXPECT_THAT(refusal(nested(32)), HasSubstr("x.json: nested deeper than 32 levels"));
  EXPECT_THAT(refusal("{\"\\\\\": " + nested(32) + "}"), HasSubstr("nested deeper"));
  std::string flat = "[[]";
  for (int i = 0; i < 100; ++i) flat += ", [{}]";
  EXPECT_EQ(refusal(flat + "]"), "");
}

TEST(JsonFile, RefusesWhatIsNoRegularFile) {
  const support::TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "fifo").c_str(), 0600), 0);
  for (const fs::path& file : {folder.path() / "fifo", folder.path(), fs::path("/dev/zero")})
    EXPECT_THAT(support::config_refusal([&] { load_json_object(file); }), HasSubstr("not a regular file")) << file;
  EXPECT_THAT(support::config_refusal([&] { load_json_object(folder.path() / "none"); }), HasSubstr("none"));
}

TEST(RunFiles, OfWrongTypesAreRefusedWithTheirName) {
  const support::TemporaryFolder folder;
  folder.write("status.json", R"({"status": "ok", "message": 5})");
  EXPECT_THAT(support::config_refusal([&] { load_status(folder.path()); }), HasSubstr("status.json"));
  folder.write("scan.json", R"({"content_hash": 5, "sensor_name": 7, "beams": 1})");
  EXPECT_THAT(support::config_refusal([&] { stated_recording_hash(folder.path()); }), HasSubstr("scan.json"));
  EXPECT_THAT(support::config_refusal([&] { load_recording(folder.path()); }), HasSubstr("scan.json"));
  folder.write("manifest.json", R"({"program": "scanbench", "schema": 1, "version": 5, "argv": [3]})");
  EXPECT_THAT(support::config_refusal([&] { manifest_facts(folder.path()); }), HasSubstr("manifest.json"));
  EXPECT_THAT(support::config_refusal([&] { load_manifest(folder.path()); }), HasSubstr("manifest.json"));
}

TEST(RunFiles, NameNoScenarioOutsideTheFolder) {
  const support::TemporaryFolder folder;
  folder.write("manifest.json", R"({"program": "scanbench", "schema": 1, "state": "complete", "start": "", "end": "",
      "argv": [], "scenarios": ["../../x"], "cells": []})");
  EXPECT_THAT(support::config_refusal([&] { load_manifest(folder.path()); }), HasSubstr("../../x"));
}

/// An .npy file without values, whose header states a shape.
std::string empty_npy(const std::string& shape) {
  std::string header = "{'descr': '<i4', 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header.push_back('\n');
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + std::string(1, '\0') + header;
}

TEST(RunFiles, StateNoMoreFramesWithoutBeamsThanMemoryHolds) {
  const support::TemporaryFolder folder;
  folder.write("lines.csv", "frame,line,x1_m,y1_m,x2_m,y2_m,rho_m,alpha_rad,first_beam,last_beam,points,rms_m\n");
  folder.write("labels.npy", empty_npy("(5, 0)"));
  EXPECT_EQ(load_result(folder.path()).lines.size(), 5u);
  for (const char* shape : {"(4611686018427387904, 0)", "(1000000000, 0)"}) {
    folder.write("labels.npy", empty_npy(shape));
    EXPECT_THAT(support::config_refusal([&] { load_result(folder.path()); }), HasSubstr("frames without beams"))
        << shape;
  }
}

}  // namespace
}  // namespace scanbench::runs
