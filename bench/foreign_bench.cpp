// Wall time of a call of a program: 1081 ranges there, 100 lines and 1081 labels back, without any work. The
// alternatives are the same as a module of this process, and a bare exchange of as many bytes with a child process over
// the same kind of socket.
//
// With --ratios [rounds] the program prints, per round in which both take turns, the median wall time of a call, that
// of a bare exchange, and their ratio.
#include <benchmark/benchmark.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "core/modules.hpp"
#include "core/scan.hpp"
#include "harness/study/foreign/inspect.hpp"
#include "harness/study/foreign/program_modules.hpp"

namespace scanbench {
namespace {

constexpr int kBeams = 1081;

class Echo final : public LineExtractor {
 public:
  ScanLines extract(const Scan& scan, Trace&) const override {
    ScanLines found{{}, std::vector<int>(scan.ranges.size(), -1)};
    for (int i = 0; i < 100; ++i) {
      LineFeature line{.segment = {{1, -1}, {1, 1}}, .line = {1, 0}, .covariance = {}};
      line.first_beam = line.last_beam = 10 * i;
      line.points = 1;
      found.labels[static_cast<std::size_t>(10 * i)] = i;
      found.lines.push_back(line);
    }
    return found;
  }
};

void call(benchmark::State& state, const LineExtractor& module) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(-135), radians(0.25), kBeams);
  const std::vector<double> ranges(kBeams, 2.0);
  Trace silent;
  for (auto _ : state) benchmark::DoNotOptimize(module.extract({sensor, ranges, 0.0}, silent).lines.size());
}

void in_this_process(benchmark::State& state) {
  call(state, Echo());
}
BENCHMARK(in_this_process)->UseRealTime();

std::unique_ptr<LineExtractor> echo_program() {
  study::ForeignSource source;
  source.program = {SCANBENCH_ECHO};
  study::inspect_program(source, false);
  return study::run_program<LineExtractor>(source, {}, {});
}

void in_a_program(benchmark::State& state) {
  call(state, *echo_program());
}
BENCHMARK(in_a_program)->UseRealTime();

/// A child process that reads and writes as many bytes as the program does, and nothing else.
class BareExchange {
 public:
  BareExchange() {
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets_.data()) != 0) std::abort();
    pid_ = ::fork();
    if (pid_ == 0) {
      ::close(sockets_[0]);
      while (read_all(sockets_[1], call_) && ::write(sockets_[1], answer_.data(), answer_.size()) > 0) continue;
      ::_exit(0);
    }
    ::close(sockets_[1]);
  }
  BareExchange(const BareExchange&) = delete;
  BareExchange& operator=(const BareExchange&) = delete;
  ~BareExchange() {
    ::close(sockets_[0]);
    ::waitpid(pid_, nullptr, 0);
  }

  void operator()() {
    if (::write(sockets_[0], call_.data(), call_.size()) < 0 || !read_all(sockets_[0], answer_)) std::abort();
  }

 private:
  static bool read_all(int fd, std::vector<char>& to) {
    for (std::size_t done = 0; done < to.size();) {
      const ssize_t n = ::read(fd, to.data() + done, to.size() - done);
      if (n <= 0) return false;
      done += static_cast<std::size_t>(n);
    }
    return true;
  }

  // A head, a header of about 80 bytes, and the numbers: ranges and time there; lines, covariances and labels back.
  std::vector<char> call_ = std::vector<char>(96 + 8 * (kBeams + 1));
  std::vector<char> answer_ = std::vector<char>(96 + 8 * (100 * 13 + kBeams));
  std::array<int, 2> sockets_{-1, -1};
  pid_t pid_ = -1;
};

void bare_exchange(benchmark::State& state) {
  BareExchange exchange;
  for (auto _ : state) exchange();
}
BENCHMARK(bare_exchange)->UseRealTime();

/// The median wall time of 2000 runs [us].
double microseconds(const std::function<void()>& run) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times(2000);
  for (double& time : times) {
    const auto begin = Clock::now();
    run();
    time = std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
  }
  std::ranges::nth_element(times, times.begin() + 1000);
  return times[1000];
}

void print_ratios(int rounds) {
  const auto module = echo_program();
  BareExchange exchange;
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(-135), radians(0.25), kBeams);
  const std::vector<double> ranges(kBeams, 2.0);
  Trace silent;
  microseconds([&] { exchange(); });  // until the processor has its clock
  for (int round = 0; round < rounds; ++round) {
    const double bare = microseconds([&] { exchange(); });
    const double call = microseconds([&] {
      benchmark::DoNotOptimize(module->extract({sensor, ranges, 0.0}, silent).lines.size());
    });
    std::printf("call %.1f us, bare exchange %.1f us, ratio %.2f, difference %.1f us\n", call, bare, call / bare,
                call - bare);
  }
}

}  // namespace
}  // namespace scanbench

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--ratios") {
    scanbench::print_ratios(argc > 2 ? std::atoi(argv[2]) : 5);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
