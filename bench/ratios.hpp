// Compares methods with a named alternative in the same run and prints rows of one Markdown table, which `bench_table`
// (bench/CMakeLists.txt) collects.
//
// All methods take turns, in rotated order in every round. Times are CPU times of the thread. A factor is the time of
// the alternative, which is the first method, divided by the time of the method in the same round; a row has the
// median and the 10th and 90th percentile.
#pragma once

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace scanbench::bench {

struct Method {
  std::string name;
  std::function<std::size_t()> run;  ///< returns the number of units of work, for example rays
  double limit = 0;                  ///< factor to reach; 0: none
  std::vector<double> ns = {};       ///< per unit and round
};

inline double quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(std::lround(q * static_cast<double>(values.size() - 1)))];
}

inline double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline std::string time_text(double ns) {
  char text[32];
  if (ns < 1e3)
    std::snprintf(text, sizeof text, "%.3g ns", ns);
  else if (ns < 1e6)
    std::snprintf(text, sizeof text, "%.3g us", 1e-3 * ns);
  else
    std::snprintf(text, sizeof text, "%.3g ms", 1e-6 * ns);
  return text;
}

/// Nanoseconds per unit of work. Runs the method until the clock is fine enough.
inline double time_of(const Method& method) {
  constexpr double kShortest = 0.02;
  std::size_t units = 0;
  const double begin = thread_seconds();
  double end = begin;
  while (end - begin < kShortest) {
    units += method.run();
    end = thread_seconds();
  }
  return 1e9 * (end - begin) / static_cast<double>(units);
}

/// Prints a row for each method after the first. `work` names the work and its unit: "cast, 15 walls, a beam".
inline void measure(const std::string& work, std::vector<Method> methods, int rounds) {
  for (const Method& method : methods) method.run();  // warms caches
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < methods.size(); ++k) {
      Method& method = methods[(k + static_cast<std::size_t>(round)) % methods.size()];
      method.ns.push_back(time_of(method));
    }
  const Method& alternative = methods.front();
  for (std::size_t k = 1; k < methods.size(); ++k) {
    const Method& method = methods[k];
    std::vector<double> factors;
    for (std::size_t i = 0; i < method.ns.size(); ++i) factors.push_back(alternative.ns[i] / method.ns[i]);
    std::printf("| %s | %s: %s | %s: %s | %.3g | %.3g .. %.3g |", work.c_str(), alternative.name.c_str(),
                time_text(quantile(alternative.ns, 0.5)).c_str(), method.name.c_str(),
                time_text(quantile(method.ns, 0.5)).c_str(), quantile(factors, 0.5), quantile(factors, 0.1),
                quantile(factors, 0.9));
    method.limit > 0 ? std::printf(" %g |\n", method.limit) : std::printf(" |\n");
  }
  std::fflush(stdout);
}

}  // namespace scanbench::bench
