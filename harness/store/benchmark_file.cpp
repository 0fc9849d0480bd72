// The specification of a benchmark page as JSON.
#include "harness/store/benchmark_file.hpp"

#include <nlohmann/json.hpp>

#include "harness/store/json_file.hpp"

namespace scanbench::harness {

std::string benchmark_json(const BenchmarkSpec& spec) {
  const nlohmann::ordered_json json{{"about", spec.about}, {"baseline", spec.baseline}, {"example", spec.example}};
  return json.dump(2) + "\n";
}

std::optional<BenchmarkSpec> load_benchmark(const std::filesystem::path& run) {
  const std::filesystem::path file = run / "benchmark.json";
  if (!std::filesystem::exists(file)) return std::nullopt;
  return with_json_of(file, [](const nlohmann::ordered_json& json) {
    return BenchmarkSpec{json.at("about"), json.at("baseline"), json.at("example")};
  });
}

}  // namespace scanbench::harness
