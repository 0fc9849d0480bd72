// A running program that is a module, and the socket to it.
#pragma once

#include <cstddef>
#include <ctime>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/io/files/descriptor.hpp"
#include "harness/io/process/child.hpp"
#include "harness/io/process/deadline.hpp"
#include "harness/io/process/pipe.hpp"
#include "harness/study/foreign/fault.hpp"
#include "harness/study/foreign/frame.hpp"
#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// Where the program's standard output and standard error go.
enum class ProgramOutput {
  inherited,  ///< those of this process: of a worker the output of its cell
  captured,   ///< the end of it is added to the messages of faults
};

/// The program has one end of a socket pair as the descriptor that the environment variable SCANBENCH_FD names, an
/// empty standard input, and no other descriptor of this process. It is killed when this process ends.
class Program {
 public:
  /// Throws ForeignFault if the program cannot be started.
  Program(const ForeignSource& source, const ForeignSetting& setting, ProgramOutput output);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();  ///< closes the socket, which ends a good program, and kills the program if it does not exit

  /// Sends a frame and waits for the answer. `header` is a JSON object without its closing brace; the key `id` is
  /// added, which the answer must repeat. Throws ForeignFault for a program that ends, breaks the protocol, answers
  /// with {"error": ...} or does not answer within `seconds`.
  Answer call(std::string header, std::span<const std::span<const double>> parts, double seconds);

 private:
  void start(const std::vector<std::string>& argv);
  Answer exchange(const std::string& header, std::span<const std::span<const double>> parts);
  void refuse_unrequested() const;
  void send_all(const std::string& header, std::span<const std::span<const double>> parts);
  void receive(char* to, std::size_t bytes);
  std::size_t receive_some(char* to, std::size_t most);
  void account_cpu();
  void wait_for(short events);
  ForeignFault ending();

  std::string text_;
  bool in_sandbox_ = false;
  bool is_captured_ = false;
  double memory_kills_ = 0.0;  ///< of the system, before the program was started
  io::FileDescriptor socket_;
  io::PipeReader output_;  ///< of no pipe if the output is inherited
  io::Child child_;
  long id_ = 0;
  double allowed_ = 0.0;        ///< seconds of the present call
  io::Deadline deadline_{0.0};  ///< of the present call
  std::vector<char> ahead_;     ///< bytes that were received and are not yet read: [first_ahead_, end_ahead_)
  std::size_t first_ahead_ = 0;
  std::size_t end_ahead_ = 0;
  clockid_t clock_{};               ///< of the CPU time of the program
  double accounted_seconds_ = 0.0;  ///< of clock_, up to the end of the last call
};

/// CPU time that programs have used during the calls of this process [s]. A stopwatch adds it to that of the caller.
double called_programs_cpu_seconds();

}  // namespace scanbench::study
