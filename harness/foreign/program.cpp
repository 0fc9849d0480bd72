// Starts programs and exchanges frames with them.
#include "harness/foreign/program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>

#include "core/number_text.hpp"
#include "harness/files/json.hpp"
#include "harness/foreign/confine.hpp"
#include "harness/foreign/fault.hpp"
#include "harness/foreign/output_tail.hpp"

namespace scanbench::harness {
namespace {

constexpr int kProgramSocket = 3;             // the descriptor that SCANBENCH_FD names
constexpr std::size_t kOutputKept = 4096;     // bytes kept of what a program prints
constexpr std::size_t kAhead = 1 << 16;       // bytes of an answer that one recv() takes
constexpr double kPatience = 0.5;             // seconds that a program has to end after its socket is closed
constexpr double kLongestWait = 3600 * 24.0;  // of one poll(), s

double now_seconds() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

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
  return file + ": " + std::strerror(error) + (file == "bwrap" ? "; the sandbox needs bubblewrap" : "") +
         (file.find('/') == std::string::npos ? " (it was sought in PATH)" : "");
}

/// The environment of a program: as here, but Python orders sets alike in every run, and one thread is used.
void set_environment() {
  ::setenv("SCANBENCH_FD", std::to_string(kProgramSocket).c_str(), 1);
  ::setenv("PYTHONHASHSEED", "0", 0);
  ::setenv("OMP_NUM_THREADS", "1", 0);
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
}

/// Runs in the new process. Writes errno to `trouble` if the program cannot be executed.
[[noreturn]] void become(const std::vector<std::string>& argv, pid_t parent, int socket, int output, int trouble) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) _exit(3);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (output >= 0) {
    ::setpgid(0, 0);
    confine();
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
  }
  ::dup2(nothing, STDIN_FILENO);
  // The socket may have the number of `trouble`, so that is moved first.
  const int moved = ::fcntl(trouble, F_DUPFD_CLOEXEC, kProgramSocket + 1);
  const int from = ::fcntl(socket, F_DUPFD_CLOEXEC, kProgramSocket + 1);
  ::dup2(from, kProgramSocket);
  ::close_range(kProgramSocket + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  set_environment();
  std::vector<char*> arguments;
  arguments.reserve(argv.size() + 1);
  for (const auto& argument : argv)
    arguments.push_back(const_cast<char*>(argument.c_str()));  // NOLINT(*-const-cast): execvp() does not write there
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  const int error = errno;
  [[maybe_unused]] const ssize_t n = ::write(moved, &error, sizeof error);
  _exit(127);
}

/// Under bubblewrap: no network, the whole file system read-only but for one folder.
std::vector<std::string> in_sandbox(const std::vector<std::string>& program, const ForeignSetting& setting) {
  std::vector<std::string> argv{"bwrap", "--unshare-all", "--die-with-parent", "--ro-bind", "/",       "/",
                                "--dev", "/dev",          "--ro-bind-try",     "/dev/shm",  "/dev/shm"};
  if (!setting.writable_folder.empty()) {
    const std::string folder = std::filesystem::absolute(setting.writable_folder).string();
    argv.insert(argv.end(), {"--bind", folder, folder, "--chdir", folder});
  }
  argv.emplace_back("--");
  argv.insert(argv.end(), program.begin(), program.end());
  return argv;
}

}  // namespace

double called_programs_cpu_seconds() {
  return used_by_programs;
}

Program::Program(const ForeignSource& source, const ForeignSetting& setting, ProgramOutput output)
    : text_(source.text()), in_sandbox_(setting.sandbox), ahead_(kAhead) {
  start(setting.sandbox ? in_sandbox(source.program, setting) : source.program, output);
  // NOLINTNEXTLINE(*-prefer-member-initializer): of the process that was started above
  end_ = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0));
  // In a sandbox the program is out of sight: the duration of the calls counts.
  if (in_sandbox_ || ::clock_getcpuclockid(pid_, &clock_) != 0) clock_ = CLOCK_MONOTONIC;
  accounted_seconds_ = seconds_on(clock_);
}

void Program::start(const std::vector<std::string>& argv, ProgramOutput output) {
  const auto refuse = [&](const std::string& reason) {
    throw ForeignFault("the program `" + text_ + "` cannot be started: " + reason);
  };
  std::array<int, 2> sockets{-1, -1};
  std::array<int, 2> trouble{-1, -1};
  std::array<int, 2> printed{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0 ||
      ::pipe2(trouble.data(), O_CLOEXEC) != 0 ||
      (output == ProgramOutput::captured && ::pipe2(printed.data(), O_CLOEXEC) != 0))
    refuse(std::strerror(errno));
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(argv, parent, sockets[1], printed[1], trouble[1]);
  own_group_ = output == ProgramOutput::captured;
  if (pid_ > 0 && own_group_) ::setpgid(pid_, pid_);
  socket_ = sockets[0];
  output_ = printed[0];
  for (const int fd : {sockets[1], trouble[1], printed[1]})
    if (fd >= 0) ::close(fd);
  int error = pid_ < 0 ? errno : 0;
  if (pid_ > 0 && ::read(trouble[0], &error, sizeof error) != sizeof error) error = 0;
  ::close(trouble[0]);
  if (output_ >= 0) ::fcntl(output_, F_SETFL, O_NONBLOCK);
  if (error != 0) {
    if (pid_ > 0) ::waitpid(pid_, nullptr, 0);
    reaped_ = true;
    ::close(socket_);
    if (output_ >= 0) ::close(output_);
    refuse(refusal_of(argv.front(), error));
  }
}

Program::~Program() {
  ::close(socket_);
  if (!has_ended(kPatience)) {
    ::kill(pid_, SIGKILL);
    has_ended(10 * kPatience);
  }
  if (own_group_) ::kill(-pid_, SIGKILL);
  if (own_group_) remove_confinement(pid_);
  for (const int fd : {output_, end_})
    if (fd >= 0) ::close(fd);
}

bool Program::has_ended(double seconds) {
  const double end = now_seconds() + seconds;
  while (!reaped_) {
    const pid_t ended = ::waitpid(pid_, &wait_status_, WNOHANG);
    reaped_ = ended == pid_ || (ended < 0 && errno == ECHILD);
    if (reaped_ || now_seconds() > end) break;
    drain_output();
    const timespec pause{0, 500000};
    ::nanosleep(&pause, nullptr);
  }
  return reaped_;
}

void Program::drain_output() {
  if (output_ < 0) return;
  std::array<char, 4096> block{};
  for (int i = 0; i < 64; ++i) {
    const ssize_t n = ::read(output_, block.data(), block.size());
    if (n <= 0) break;
    output_text_.append(block.data(), static_cast<std::size_t>(n));
    if (output_text_.size() > 2 * kOutputKept) output_text_.erase(0, output_text_.size() - kOutputKept);
  }
}

/// How the program ended, in words.
std::string Program::ending() {
  if (!has_ended(kPatience)) return "closed its socket without answering";
  if (WIFSIGNALED(wait_status_))
    return "ended by signal " + std::to_string(WTERMSIG(wait_status_)) + " (" + strsignal(WTERMSIG(wait_status_)) +
           ") without answering";
  return "ended with exit code " + std::to_string(WEXITSTATUS(wait_status_)) + " without answering";
}

void Program::wait_for(short events) {
  while (true) {
    const double left = std::min(deadline_ - now_seconds(), kLongestWait);
    if (left <= 0)
      throw ForeignFault("did not answer within " + number_text(allowed_) + " s", ForeignFault::Kind::timeout);
    std::array<pollfd, 3> fds{{{socket_, events, 0}, {end_, POLLIN, 0}, {output_, POLLIN, 0}}};  // negative: ignored
    const timespec timeout{static_cast<time_t>(left), static_cast<long>(1e9 * (left - std::floor(left)))};
    if (::ppoll(fds.data(), fds.size(), &timeout, nullptr) <= 0) continue;
    if (fds[2].revents != 0) drain_output();
    if (fds[0].revents != 0) return;
    // Another process that it has left may keep the socket open, so that its end does not close it.
    if (fds[1].revents != 0) throw ForeignFault(ending(), ForeignFault::Kind::ended);
    if ((fds[2].revents & POLLHUP) != 0) {
      const timespec pause{0, 1000000};  // a closed output is always ready
      ::nanosleep(&pause, nullptr);
    }
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
    ssize_t sent = ::sendmsg(socket_, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) {
      wait_for(POLLOUT);
      continue;
    }
    if (sent < 0) throw ForeignFault(ending(), ForeignFault::Kind::ended);
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
    const ssize_t n = ::recv(socket_, to, most, MSG_DONTWAIT);
    if (n > 0) return static_cast<std::size_t>(n);
    if (n < 0 && (errno == EAGAIN || errno == EINTR))
      wait_for(POLLIN);
    else
      throw ForeignFault(ending(), ForeignFault::Kind::ended);
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
  const ssize_t n = ::recv(socket_, block.data(), block.size(), MSG_DONTWAIT | MSG_PEEK);
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
        "reports an error: " + output_tail(error->is_string() ? error->get<std::string>() : json_line(*error)),
        answer.header().value("reason", nlohmann::json()) == "out_of_memory" ? ForeignFault::Kind::memory
                                                                             : ForeignFault::Kind::other);
  const auto id = answer.header().find("id");
  if (id == answer.header().end() || !id->is_number_integer() || id->get<long>() != id_)
    throw ForeignFault("answered to call " + (id == answer.header().end() ? "(none)" : json_line(*id)) +
                       " instead of call " + std::to_string(id_));
  return answer;
}

Answer Program::call(std::string header, std::span<const std::span<const double>> parts, double seconds) {
  header += ",\"id\":" + std::to_string(++id_) + "}";
  allowed_ = seconds;
  deadline_ = now_seconds() + seconds;
  const auto place = [&](const std::string& what) {
    drain_output();
    const std::string tail = output_tail(output_text_);
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

}  // namespace scanbench::harness
