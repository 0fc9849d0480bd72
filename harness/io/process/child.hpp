// Child processes: how they begin, wait and end.
#pragma once

#include <sys/types.h>

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "harness/io/files/descriptor.hpp"
#include "harness/io/process/pipe.hpp"
#include "harness/io/process/process_end.hpp"

namespace scanbench::io {

inline constexpr int kInherited = -1;   ///< a standard descriptor that stays that of the parent
inline constexpr int kNullDevice = -2;  ///< a standard descriptor that is /dev/null
inline constexpr int kChannel = 3;      ///< the number that ChildSetting::channel has in the child

/// What a child takes over from its parent. It has the standard descriptors, the channel if there is one, and no other
/// open file: it cannot hold a lock, a pipe of another child or a terminal.
struct ChildSetting {
  int input = kNullDevice;  ///< a descriptor of the parent, kInherited or kNullDevice; so are the next two
  int output = kInherited;
  int errors = kInherited;
  int channel = -1;  ///< a descriptor of the parent; -1: none
  /// The child leads a process group, which an interrupt at the terminal does not reach, and which ends with the child.
  bool own_group = false;
  bool dies_with_parent = true;  ///< the system kills the child when the parent ends
};

/// A process that this one has started. SIGCHLD has its default action while one exists: if it is ignored, which a
/// parent of this process may have set, ended children vanish and cannot be waited for. Children must be started by one
/// thread only.
class Child {
 public:
  Child() = default;  ///< of no process: has ended
  ~Child() { end(); }
  Child(Child&& other) noexcept { *this = std::move(other); }
  Child& operator=(Child&& other) noexcept;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t pid() const { return pid_; }
  /// A descriptor for ppoll(), readable when the process has ended; -1 before Linux 5.3.
  int end_descriptor() const { return end_.number(); }
  /// Does not block. The process id is not used again before reap().
  bool has_ended() const;
  /// Waits for the end and drains the pipes meanwhile, also if a process that the child has started keeps them open.
  /// False if the time is over before.
  bool wait(double seconds, std::initializer_list<PipeReader*> pipes = {}) const;
  /// Sends SIGKILL to the process and to its own group, which it may have left.
  void kill() const;
  /// Waits for the end and kills what is left of its own group. May be repeated.
  const ProcessEnd& reap();
  /// kill() and reap(), but within five seconds: a process that the kernel cannot end now must not delay this one.
  void end();
  /// Requests the end with SIGTERM, and calls end() after `grace_s`.
  void stop(double grace_s);

 private:
  friend Child fork_child(const ChildSetting& setting, unsigned close_flags, const std::function<int()>& body);
  Child(pid_t pid, bool own_group);
  void forget();

  pid_t pid_ = -1;
  bool own_group_ = false;
  bool is_waited_for_ = false;
  FileDescriptor end_;
  ProcessEnd how_;
};

/// Forks. The child runs `body` and exits with its result, without destructors of the parent's objects. An exception
/// that leaves `body` aborts the child. Throws std::system_error if the system refuses another process.
Child start_child(const ChildSetting& setting, const std::function<int()>& body);

/// Forks and executes a program, which is looked up in PATH if its name has no slash. `prepare` runs in the child
/// before. Throws std::system_error if the system refuses another process or does not execute the program.
Child start_program(const std::vector<std::string>& argv, const ChildSetting& setting,
                    const std::function<void()>& prepare = {});

}  // namespace scanbench::io
