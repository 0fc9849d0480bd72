// Starts programs and exchanges frames with them.
#include "harness/study/foreign/program.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <system_error>

#include "core/number_text.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/process/descendants.hpp"
#include "harness/io/process/output_tail.hpp"
#include "harness/study/foreign/confine.hpp"
#include "harness/study/foreign/fault.hpp"
#include "harness/study/foreign/sandbox.hpp"

namespace scanbench::study {
namespace {

constexpr std::size_t kAhead = 1 << 16;  // bytes of an answer that one recv() takes
constexpr double kPatience = 0.5;        // seconds that a program has to end after its socket is closed

double used_by_programs = 0.0;  // a clock, like those of the system: one per process

double seconds_on(clockid_t clock) {
  timespec t{};
  if (::clock_gettime(clock, &t) != 0) return 0.0;
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The interpreter that the first line of a script names; empty for other files.
std::string interpreter_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (file.find('/') == std::string::npos || !std::getline(in, line) || !line.starts_with("#!")) return {};
  const std::size_t first = line.find_first_not_of(" \t", 2);
  if (first == std::string::npos) return {};
  return line.substr(first, line.find_first_of(" \t\r", first) - first);
}

/// Why the system does not execute a program, in words.
std::string refusal_of(const std::string& file, int error) {
  const std::string interpreter = error == ENOENT ? interpreter_of(file) : "";
  if (!interpreter.empty()) return file + ": its interpreter " + interpreter + " does not exist";
  return file + ": " + std::generic_category().message(error) +
         (file == "bwrap" ? "; the sandbox needs bubblewrap" : "") +
         (file.find('/') == std::string::npos ? " (looked up in PATH)" : "");
}

/// The environment of a program: as here, but Python orders sets alike in every run, and one thread is used.
void set_environment() {
  ::setenv("SCANBENCH_FD", std::to_string(io::kChannel).c_str(), 1);
  ::setenv("PYTHONHASHSEED", "0", 0);
  ::setenv("OMP_NUM_THREADS", "1", 0);
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
}

/// Runs in the new process: the signals that scanbench handles or ignores have their default actions.
void restore_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace

double called_programs_cpu_seconds() {
  return used_by_programs;
}

Program::Program(const ForeignSource& source, const ForeignSetting& setting, ProgramOutput output)
    : text_(source.text()),
      in_sandbox_(setting.sandbox),
      is_captured_(output == ProgramOutput::captured),
      memory_kills_(io::out_of_memory_kills()),
      ahead_(kAhead) {
  start(setting.sandbox ? sandbox_command(source, setting) : source.program);
  // In a sandbox the program is out of sight: the duration of the calls counts.
  if (in_sandbox_ || ::clock_getcpuclockid(child_.pid(), &clock_) != 0) clock_ = CLOCK_MONOTONIC;
  accounted_seconds_ = seconds_on(clock_);
}

void Program::start(const std::vector<std::string>& argv) {
  const auto refuse = [&](const std::string& reason) {
    throw ForeignFault("the program `" + text_ + "` cannot be started: " + reason);
  };
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    refuse(std::generic_category().message(errno));
  socket_ = io::FileDescriptor(sockets[0]);
  const io::FileDescriptor other_end(sockets[1]);
  io::ChildSetting setting{.channel = other_end.number(), .own_group = is_captured_};
  io::Pipe printed;
  try {
    if (is_captured_) {
      printed = io::make_pipe();
      setting.output = setting.errors = printed.write_end.number();
      output_ = io::PipeReader(std::move(printed.read_end), io::kOutputKept);
    }
    child_ = io::start_program(argv, setting, [&] {
      restore_signals();
      if (is_captured_) confine();
      set_environment();
    });
  } catch (const std::system_error& error) {
    refuse(refusal_of(argv.front(), error.code().value()));
  }
}

Program::~Program() {
  socket_.close();
  child_.wait(kPatience, {&output_});
  child_.end();
  if (is_captured_) remove_confinement(child_.pid());
}

/// How the program ended without answering.
ForeignFault Program::ending() {
  constexpr int kKilledInSandbox = 128 + SIGKILL;  // as bubblewrap reports it
  if (!child_.wait(kPatience, {&output_}))
    return ForeignFault("closed its socket without answering", ForeignFault::Kind::ended);
  const io::ProcessEnd& end = child_.reap();
  const bool killed = end.signal == SIGKILL || (in_sandbox_ && end.exit_code == kKilledInSandbox);
  if (killed && io::out_of_memory_kills() > memory_kills_)
    return ForeignFault("was killed by the system, because memory ran out", ForeignFault::Kind::memory);
  return ForeignFault("ended " + io::to_text(end) + " without answering", ForeignFault::Kind::ended);
}

void Program::wait_for(short events) {
  while (true) {
    if (deadline_.is_over())
      throw ForeignFault("did not answer within " + number_text(allowed_) + " s", ForeignFault::Kind::timeout);
    std::array<pollfd, 3> fds{
        {{socket_.number(), events, 0}, {child_.end_descriptor(), POLLIN, 0}, {output_.descriptor(), POLLIN, 0}}};
    io::wait_for_events(fds, deadline_.seconds_left());
    if (fds[2].revents != 0) output_.drain();
    if (fds[0].revents != 0) return;
    // Another process that it has started may keep the socket open, so that its end does not close it.
    if (fds[1].revents != 0) throw ending();
  }
}

void Program::send_all(const std::string& header, std::span<const std::span<const double>> parts) {
  FrameHead head{static_cast<std::uint32_t>(header.size()), 0};
  for (const auto& part : parts) head.numbers += part.size();
  std::array<char, kFrameHead> first = encode_head(head);
  // NOLINTBEGIN(*-const-cast): sendmsg() does not write there
  std::vector<iovec> pieces{{first.data(), first.size()}, {const_cast<char*>(header.data()), header.size()}};
  for (const auto& part : parts)
    if (!part.empty()) pieces.push_back({const_cast<double*>(part.data()), part.size_bytes()});
  // NOLINTEND(*-const-cast)
  std::size_t next = 0;
  while (next < pieces.size()) {
    msghdr message{};
    message.msg_iov = pieces.data() + next;
    message.msg_iovlen = std::min<std::size_t>(pieces.size() - next, 512);  // below IOV_MAX
    ssize_t sent = ::sendmsg(socket_.number(), &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) {
      wait_for(POLLOUT);
      continue;
    }
    if (sent < 0) throw ending();
    while (next < pieces.size() && static_cast<std::size_t>(sent) >= pieces[next].iov_len)
      sent -= static_cast<ssize_t>(pieces[next++].iov_len);
    if (sent == 0) continue;
    pieces[next].iov_base = static_cast<char*>(pieces[next].iov_base) + sent;
    pieces[next].iov_len -= static_cast<std::size_t>(sent);
  }
}

/// Waits for bytes and takes what one recv() gives.
std::size_t Program::receive_some(char* to, std::size_t most) {
  while (true) {
    const ssize_t n = ::recv(socket_.number(), to, most, MSG_DONTWAIT);
    if (n > 0) return static_cast<std::size_t>(n);
    if (n < 0 && (errno == EAGAIN || errno == EINTR))
      wait_for(POLLIN);
    else
      throw ending();
  }
}

void Program::receive(char* to, std::size_t bytes) {
  while (bytes > 0) {
    if (first_ahead_ == end_ahead_) {
      first_ahead_ = end_ahead_ = 0;
      if (bytes < kAhead) end_ahead_ = receive_some(ahead_.data(), kAhead);
    }
    std::size_t n = std::min(bytes, end_ahead_ - first_ahead_);
    if (n > 0) {
      std::memcpy(to, ahead_.data() + first_ahead_, n);
      first_ahead_ += n;
    } else {
      n = receive_some(to, bytes);
    }
    to += n;
    bytes -= n;
  }
}

/// Adds what the program has used since the last call to the clock of this process. What it does after an answer
/// counts with the next call.
void Program::account_cpu() {
  const double now = seconds_on(clock_);
  used_by_programs += std::max(0.0, now - accounted_seconds_);
  accounted_seconds_ = now;
}

void Program::refuse_unrequested() const {
  std::array<char, 4096> block{};
  std::size_t count = end_ahead_ - first_ahead_;
  const ssize_t n = ::recv(socket_.number(), block.data(), block.size(), MSG_DONTWAIT | MSG_PEEK);
  if (n > 0) count += static_cast<std::size_t>(n);
  if (count > 0)
    throw ForeignFault("sent " + std::to_string(count) + (n == static_cast<ssize_t>(block.size()) ? " or more" : "") +
                       " bytes that nobody requested");
}

Answer Program::exchange(const std::string& header, std::span<const std::span<const double>> parts) {
  if (clock_ == CLOCK_MONOTONIC) accounted_seconds_ = seconds_on(clock_);
  refuse_unrequested();
  send_all(header, parts);
  std::array<char, kFrameHead> first{};
  receive(first.data(), first.size());
  const FrameHead head = decode_head(first);
  std::string text(head.header_bytes, ' ');
  receive(text.data(), text.size());
  std::vector<double> numbers(head.numbers);
  receive(reinterpret_cast<char*>(numbers.data()), numbers.size() * sizeof(double));
  Answer answer(text, std::move(numbers));
  if (const auto error = answer.header().find("error"); error != answer.header().end())
    throw ForeignFault(
        "reports an error: " + io::output_tail(error->is_string() ? error->get<std::string>() : io::json_line(*error)),
        answer.header().value("reason", nlohmann::json()) == "out_of_memory" ? ForeignFault::Kind::memory
                                                                             : ForeignFault::Kind::other);
  const auto id = answer.header().find("id");
  if (id == answer.header().end() || !id->is_number_integer() || id->get<long>() != id_)
    throw ForeignFault("answered to call " + (id == answer.header().end() ? "(none)" : io::json_line(*id)) +
                       " instead of call " + std::to_string(id_));
  return answer;
}

Answer Program::call(std::string header, std::span<const std::span<const double>> parts, double seconds) {
  header += ",\"id\":" + std::to_string(++id_) + "}";
  allowed_ = seconds;
  deadline_ = io::Deadline(seconds);
  const auto place = [&](const std::string& what) {
    output_.drain();
    const std::string tail = io::output_tail(output_.bytes());
    return "the program `" + text_ + "` " + what + (tail.empty() ? "" : "\n" + tail);
  };
  try {
    Answer answer = exchange(header, parts);
    account_cpu();
    return answer;
  } catch (const ForeignFault& fault) {
    throw ForeignFault(place(fault.what()), fault.kind());
  }
}

}  // namespace scanbench::study
