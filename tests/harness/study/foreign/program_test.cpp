// Programs as modules: what a good one gives, and what bad ones are told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "harness/study/foreign/fault.hpp"
#include "harness/study/foreign/frame.hpp"
#include "harness/study/foreign/hello.hpp"
#include "harness/study/foreign/inspect.hpp"
#include "harness/study/foreign/program_modules.hpp"
#include "tests/support/places.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace scans = scanbench::support;
using scans::OwnedScan;

bool has_python() {
  static const bool found = std::system("python3 -c pass >/dev/null 2>&1") == 0;
  return found;
}

// A program that speaks the protocol by hand. `answer` is the body of a function that returns the bytes for a call.
constexpr const char* kByHand = R"(
import json, os, signal, socket, struct, sys, time
connection = socket.socket(fileno=int(os.environ['SCANBENCH_FD']))
def receive(count):
    data = b''
    while len(data) < count:
        part = connection.recv(count - len(data))
        if not part: sys.exit(0)
        data += part
    return data
def frame(header, numbers=()):
    text = json.dumps(header).encode()
    return struct.pack('<4sIQ', b'SBF1', len(text), len(numbers)) + text + struct.pack('<%dd' % len(numbers), *numbers)
def lines(header, rows, labels, **more):
    return frame({'id': header['id'], 'arrays': [['lines', len(rows)], ['labels', len(labels)]], **more}, rows + labels)
hello = {'protocol': 1, 'kind': 'extract', 'name': 'by_hand', 'version': '1', 'params': []}
def answer(header, beams):
    if header['call'] == 'hello': return frame({**hello, 'id': header['id']})
    if header['call'] == 'make': return frame({'id': header['id']})
    return extract(header, beams)
def extract(header, beams):
    return lines(header, [], [-1.0] * beams)
)";

constexpr const char* kLoop = R"(
while True:
    magic, length, count = struct.unpack('<4sIQ', receive(16))
    header = json.loads(receive(length))
    receive(8 * count)
    connection.sendall(answer(header, count - 1))
)";

class Programs : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_python()) GTEST_SKIP() << "there is no python3";
  }
  ForeignSource by_hand(const std::string& special) {
    const auto path = folder_.path() / ("program" + std::to_string(++count_) + ".py");
    std::ofstream(path) << kByHand << special << kLoop;
    ForeignSource source;
    source.program = {"python3", path.string()};
    source.scan_seconds = 0.3;
    return source;
  }
  static ForeignSource example(const std::string& name) {
    ForeignSource source;
    source.program = {"python3", (places::source_dir() / "examples/programs" / name).string()};
    inspect_program(source, false);
    return source;
  }
  static ScanLines extract(LineExtractor& module, const OwnedScan& scan) {
    Trace silent;
    return module.extract(scan.view(), silent);
  }
  /// What one extraction with such a program is told, and the kind of fault.
  std::string fault_of(const std::string& special, ForeignFault::Kind kind = ForeignFault::Kind::other) {
    ForeignSource source = by_hand(special);
    try {
      inspect_program(source, false);
      const auto module = run_program<LineExtractor>(source, {}, {});
      extract(*module, scan_);
      extract(*module, scan_);
    } catch (const ForeignFault& fault) {
      EXPECT_EQ(fault.kind(), kind) << fault.what();
      EXPECT_THAT(fault.what(), HasSubstr(".py` "));
      return fault.what();
    } catch (const InvalidResult& error) {
      return std::string("invalid: ") + error.what();
    }
    return "no fault";
  }

  const OwnedScan scan_ = scans::cast(scans::fan_sensor(91, radians(90)), {{{2, -9}, {2, 9}}});
  support::TemporaryFolder folder_;
  int count_ = 0;
};

TEST_F(Programs, AGoodOneIsAsked) {
  const ForeignSource source = example("split_lines.py");
  EXPECT_EQ(source.module.kind, "extract");
  EXPECT_EQ(source.module.info.name, "split_lines");
  EXPECT_EQ(source.module.version, "1.0");
  ASSERT_EQ(source.module.params.size(), 3u);
  EXPECT_EQ(allowed_text(source.module.params[0]), "a number > 0 m");
}

TEST_F(Programs, OneLineThroughAWallIsThatOfAModuleInThisProgram) {
  const auto python = run_program<LineExtractor>(example("my_lines.py"), {{"min_points", std::int64_t{2}}}, {});
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OwnedScan scan = scans::with_noise(scan_, 0.01, seed);
    const ScanLines found = extract(*python, scan);
    ASSERT_EQ(found.lines.size(), 1u);
    EXPECT_NEAR(found.lines[0].line.rho, 2.0, 0.01);
    EXPECT_EQ(found.lines[0].points, 91);
    EXPECT_EQ(found.labels, std::vector<int>(91, 0));
    EXPECT_FALSE(found.lines[0].covariance.has_value());
    EXPECT_LT(found.lines[0].segment.a.y(), found.lines[0].segment.b.y());
  }
}

TEST_F(Programs, AMatcherFindsTheMotionBetweenTwoScansOfARoom) {
  const ForeignSource source = example("point_matcher.py");
  const auto matcher = run_program<ScanMatcher>(source, resolve(source.module.params, {}), {});
  const auto walls = scans::box(-3, -2, 4, 2.5);
  const Pose2 motion(0.1, -0.05, 0.04);
  const OwnedScan first = scans::cast(scans::ring_sensor(720), walls);
  const OwnedScan second = scans::cast(scans::ring_sensor(720), walls, motion);
  const ScanLines none{{}, std::vector<int>(720, -1)};
  const Scan a = first.view(), b = second.view();
  Trace silent;
  const Match match = matcher->match({a, none}, {b, none}, Pose2(), silent);
  EXPECT_NE(match.status, Status::no_match);
  EXPECT_NEAR(match.reference_from_current.x(), motion.x(), 0.02);
  EXPECT_NEAR(match.reference_from_current.y(), motion.y(), 0.02);
  EXPECT_NEAR(match.reference_from_current.yaw(), motion.yaw(), 0.01);
}

TEST_F(Programs, ThatPrintDoNotDisturbTheProtocol) {
  EXPECT_EQ(fault_of("def extract(header, beams):\n"
                     "    print('SBF1' * 1000, flush=True)\n"
                     "    return lines(header, [], [-1.0] * beams)\n"),
            "no fault");
}

TEST_F(Programs, ThatEndSayHow) {
  constexpr auto kEnded = ForeignFault::Kind::ended;
  EXPECT_THAT(fault_of("sys.stderr.write('no licence'); sys.exit(7)\n", kEnded),
              AllOf(HasSubstr("exit code 7"), HasSubstr("no licence")));
  EXPECT_THAT(fault_of("def extract(header, beams): os._exit(0)\n", kEnded),
              HasSubstr("exit code 0 without answering"));
  EXPECT_THAT(fault_of("def extract(header, beams): os.kill(os.getpid(), signal.SIGSEGV)\n", kEnded),
              HasSubstr("ended by signal 11 (Segmentation fault)"));
  EXPECT_THAT(fault_of("def extract(header, beams):\n    os.dup2(os.open('/dev/null', os.O_RDWR), 3)\n    return b''\n",
                       kEnded),
              HasSubstr("without answering"));
}

TEST_F(Programs, ThatStartASessionOfTheirOwnBeforeTheyDescribeThemselvesLeaveNothing) {
  const auto file = folder_.path() / "daemon";
  ForeignSource source = by_hand(
      "if os.fork() == 0:\n"
      "    os.setsid()\n"
      "    if os.fork() == 0:\n"
      "        open('" +
      file.string() +
      "', 'w').write(str(os.getpid()) + ' ')\n"
      "        signal.sigwait([signal.SIGUSR1])\n"
      "    os._exit(0)\n"
      "while not os.path.exists('" +
      file.string() + "') or not open('" + file.string() + "').read().endswith(' '): pass\n");
  inspect_program(source, false);
  pid_t daemon = 0;
  std::ifstream(file) >> daemon;
  ASSERT_GT(daemon, 1);
  EXPECT_EQ(::kill(daemon, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST_F(Programs, ThatSpeakAnotherVersionAreRefused) {
  EXPECT_THAT(fault_of("hello['protocol'] = 2\n"),
              HasSubstr("speaks version 2 of the protocol; this program speaks version 1"));
  EXPECT_THAT(fault_of("hello['protocol'] = 2**32 + 1\n"), HasSubstr("speaks version 4294967297"));
  EXPECT_THAT(fault_of("del hello['protocol']\n"), HasSubstr("key `protocol`"));
}

TEST_F(Programs, ThatDoNotDescribeThemselvesAreAskedOnce) {
  const auto starts = folder_.path() / "starts";
  ForeignSource source = by_hand("open('" + starts.string() + "', 'a').write('x')\nsys.exit(3)\n");
  for (int k = 0; k < 3; ++k) EXPECT_THROW(inspect_program(source, false), ForeignFault);
  EXPECT_EQ(std::filesystem::file_size(starts), 1u);
}

TEST_F(Programs, ThatDescribeThemselvesWronglyAreRefused) {
  EXPECT_THAT(fault_of("hello['kind'] = 'paint'\n"), HasSubstr("its kind is 'paint'; allowed: extract"));
  EXPECT_THAT(fault_of("hello['name'] = '../x'\n"), HasSubstr("its name is '../x'"));
  EXPECT_THAT(fault_of("hello['name'] = 'a\\n' + 'b' * 1000\n"), HasSubstr("its name is 'a?bbb"));
  EXPECT_THAT(fault_of("hello['params'] = [{'name': 'a', 'type': 'number', 'default': -1, 'min': 0}]\n"),
              HasSubstr("the default of a is -1; allowed: a number >= 0"));
  EXPECT_THAT(fault_of("hello['params'] = [{'name': 'a', 'type': 'float', 'default': 1}]\n"),
              HasSubstr("type 'float'; allowed: boolean, integer, number"));
  EXPECT_THAT(fault_of("hello['params'] = 7\n"),
              HasSubstr("`params` of the module is of the JSON type number; allowed: a list of parameters"));
  EXPECT_THAT(fault_of("hello['summary'] = 5\n"),
              HasSubstr("`summary` of the module is of the JSON type number; allowed: a text"));
}

TEST_F(Programs, ThatDescribeAParameterWithAnotherTypeAreRefusedWithItsName) {
  const auto fault_with = [&](const std::string& parameter) {
    return fault_of("hello['params'] = [{'name': 'a', " + parameter + "}]\n");
  };
  EXPECT_THAT(fault_with("'type': 'number', 'default': 'x'"), HasSubstr("`default` of a is \"x\"; allowed: number"));
  EXPECT_THAT(fault_with("'type': 'named points', 'default': {'A': [1]}"),
              HasSubstr("`default` of a is {\"A\":[1]}; allowed: named points"));
  EXPECT_THAT(fault_with("'type': 'named points', 'default': [1, 2]"), HasSubstr("`default` of a is [1,2]"));
  EXPECT_THAT(fault_with("'type': 'rows of numbers', 'default': [1]"), HasSubstr("`default` of a is [1]"));
  EXPECT_THAT(fault_with("'type': 'integer', 'default': 2**63"),
              HasSubstr("is 9223372036854775808; allowed: a whole number of 64 bits"));
  EXPECT_THAT(fault_with("'type': 'number', 'default': 1, 'min': '0'"),
              HasSubstr("`min` of a is of the JSON type string; allowed: a number"));
  EXPECT_THAT(fault_with("'type': 'number', 'default': 1, 'open_min': 'yes'"), HasSubstr("allowed: true, false"));
  EXPECT_THAT(fault_with("'type': 'choice', 'default': 'x', 'choices': [1]"), HasSubstr("allowed: a list of texts"));
}

TEST_F(Programs, ThatAnswerTooLateAreEndedEvenIfTheyIgnoreTheRequest) {
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_THAT(fault_of("signal.signal(signal.SIGTERM, signal.SIG_IGN)\n"
                       "def extract(header, beams): time.sleep(100)\n",
                       ForeignFault::Kind::timeout),
              HasSubstr("did not answer within 0.3 s"));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
}

TEST_F(Programs, ThatAnswerTooMuchAreRefused) {
  EXPECT_THAT(fault_of("def extract(header, beams): return lines(header, [], [-1.0] * beams) + b'and more'\n"),
              HasSubstr("sent 8 bytes that nobody requested"));
  EXPECT_THAT(fault_of("def extract(header, beams): return struct.pack('<4sIQ', b'SBF1', 2, 1 << 40) + b'{}'\n"),
              HasSubstr("announces 1099511627776 numbers; allowed: up to 8388608"));
  EXPECT_THAT(fault_of("def extract(header, beams): return struct.pack('<4sIQ', b'SBF1', 1 << 30, 0)\n"),
              HasSubstr("announces a header of 1073741824 bytes"));
}

TEST_F(Programs, ThatNestTooDeeplyAreRefused) {
  for (const std::string key : {"error", "id", "default"})
    EXPECT_THAT(fault_of("def extract(header, beams):\n    text = b'{\"" + key +
                         "\":' + b'[' * 500000 + b']' * 500000 + b'}'\n"
                         "    return struct.pack('<4sIQ', b'SBF1', len(text), 0) + text\n"),
                HasSubstr("nested more than 32 deep"));
  for (const std::string key : {"error", "id", "params", "protocol"})
    EXPECT_THAT(fault_of("def answer(header, beams):\n    text = b'{\"" + key +
                         "\":' + b'[' * 500000 + b']' * 500000 + b'}'\n"
                         "    return struct.pack('<4sIQ', b'SBF1', len(text), 0) + text\n"),
                HasSubstr("nested more than 32 deep"));
  EXPECT_THAT(fault_of("def extract(header, beams): return frame({'id': header['id'], 'error': '[' * 100})\n"),
              HasSubstr("reports an error: [[["))
      << "brackets in a text do not nest";
}

TEST_F(Programs, ThatAnswerWrongFramesAreRefused) {
  EXPECT_THAT(fault_of("def extract(header, beams): return b'lines: 0, labels: none'\n"),
              HasSubstr("sent 'lines: 0, labels' instead of a frame"));
  EXPECT_THAT(fault_of("def extract(header, beams): return lines({'id': 99}, [], [-1.0] * beams)\n"),
              HasSubstr("answered to call 99 instead of call 3"));
  EXPECT_THAT(fault_of("def extract(header, beams): return frame({'id': header['id'], 'arrays': [['lines', 5]]})\n"),
              HasSubstr("longer than the 0 numbers"));
  EXPECT_THAT(fault_of("def extract(header, beams): return struct.pack('<4sIQ', b'SBF1', 3, 0) + b'[1]'\n"),
              HasSubstr("no JSON object"));
  EXPECT_THAT(fault_of("def extract(header, beams): return frame({'id': header['id'], 'error': 'out of chalk'})\n"),
              HasSubstr("reports an error: out of chalk"));
}

TEST_F(Programs, ThatAnswerNoResultAreInvalid) {
  EXPECT_THAT(fault_of("def extract(header, beams): return frame({'id': header['id']})\n"),
              HasSubstr("invalid: the answer has no array `lines`"));
  EXPECT_THAT(fault_of("def extract(header, beams): return lines(header, [1.0] * 7, [-1.0] * beams)\n"),
              HasSubstr("`lines` has 7 numbers; allowed: 10 per row"));
  EXPECT_THAT(fault_of("def extract(header, beams): return lines(header, [], [0.5] * beams)\n"),
              HasSubstr("a number of `labels` is 0.5; allowed: whole numbers"));
}

TEST_F(Programs, ThatDoNotExistAreNamed) {
  ForeignSource source;
  source.program = {"pyhton3", "my_lines.py"};
  try {
    inspect_program(source, false);
    FAIL() << "the program does not exist";
  } catch (const ForeignFault& fault) {
    EXPECT_THAT(
        fault.what(),
        HasSubstr("`pyhton3 my_lines.py` cannot be started: pyhton3: No such file or directory (looked up in PATH)"));
  }
}

TEST(Hello, DescriptionsRoundTrip) {
  for (const auto& [name, entry] : Registry<LineExtractor>::all()) {
    const ForeignModule module{"extract", entry.info, "7", entry.params};
    const ForeignModule again = read_hello(to_hello(module));
    EXPECT_EQ(again.info.name, name);
    EXPECT_EQ(again.version, "7");
    ASSERT_EQ(again.params.size(), entry.params.size());
    for (std::size_t i = 0; i < entry.params.size(); ++i) {
      EXPECT_EQ(again.params[i].name, entry.params[i].name);
      EXPECT_EQ(again.params[i].default_value, entry.params[i].default_value);
      EXPECT_EQ(allowed_text(again.params[i]), allowed_text(entry.params[i]));
    }
  }
}

TEST(Frame, HeadsRoundTripAndOtherBytesAreRefused) {
  const FrameHead head{77, 1081};
  const auto bytes = encode_head(head);
  EXPECT_EQ(decode_head(bytes).header_bytes, 77u);
  EXPECT_EQ(decode_head(bytes).numbers, 1081u);
  for (std::size_t i = 0; i < 4; ++i) {
    auto wrong = bytes;
    wrong[i] = '?';
    EXPECT_THROW(decode_head(wrong), ForeignFault);
  }
}

}  // namespace
}  // namespace scanbench::study
