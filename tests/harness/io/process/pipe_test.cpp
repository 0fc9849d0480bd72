// Pipes, deadlines and what a reader keeps.
#include "harness/io/process/pipe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "harness/io/process/deadline.hpp"

namespace scanbench::io {
namespace {

void send(const FileDescriptor& to, std::string_view text) {
  ASSERT_TRUE(write_all(to.number(), std::as_bytes(std::span(text))));
}

TEST(PipeReader, TakesWhatIsThereAndClosesAtTheEnd) {
  Pipe pipe = make_pipe();
  PipeReader reader(std::move(pipe.read_end), 100);
  reader.drain();  // does not block
  EXPECT_EQ(reader.bytes(), "");
  send(pipe.write_end, "one ");
  send(pipe.write_end, "two");
  reader.drain();
  EXPECT_EQ(reader.bytes(), "one two");
  EXPECT_TRUE(reader.is_open());
  pipe.write_end.close();
  reader.drain();
  EXPECT_FALSE(reader.is_open());
  EXPECT_EQ(reader.descriptor(), -1);
  EXPECT_EQ(reader.bytes(), "one two");
}

TEST(PipeReader, KeepsTheLastBytes) {
  Pipe pipe = make_pipe();
  PipeReader reader(std::move(pipe.read_end), 10);
  std::string all;
  for (char letter = 'a'; letter <= 'z'; ++letter) {
    send(pipe.write_end, std::string(3, letter));
    all.append(3, letter);
    reader.drain();
    EXPECT_LE(reader.bytes().size(), 20U);
    EXPECT_GE(reader.bytes().size(), std::min<std::size_t>(10, all.size()));
    EXPECT_TRUE(all.ends_with(reader.bytes()));
  }
}

TEST(PipeReader, OfNoPipeIsEmpty) {
  PipeReader reader;
  reader.drain();
  EXPECT_EQ(reader.bytes(), "");
  EXPECT_FALSE(reader.is_open());
}

TEST(Deadline, IsOverWhenItsSecondsHavePassed) {
  EXPECT_TRUE(Deadline(0.0).is_over());
  EXPECT_FALSE(Deadline(60.0).is_over());
  EXPECT_FALSE(Deadline(std::numeric_limits<double>::infinity()).is_over());
  EXPECT_LE(Deadline(60.0).seconds_left(), 60.0);
}

TEST(WaitForEvents, EndsAtAnEventOrAtTheDeadline) {
  Pipe pipe = make_pipe();
  std::array<pollfd, 2> events{{{pipe.read_end.number(), POLLIN, 0}, {-1, POLLIN, 0}}};
  const double begun = monotonic_seconds();
  wait_for_events(events, 0.01);
  EXPECT_GE(monotonic_seconds() - begun, 0.01);
  EXPECT_EQ(events[0].revents, 0);
  send(pipe.write_end, "x");
  wait_for_events(events, std::numeric_limits<double>::infinity());
  EXPECT_EQ(events[0].revents, POLLIN);
  EXPECT_EQ(events[1].revents, 0);
  wait_for_events(events, -1.0);  // a deadline that is over
  EXPECT_EQ(events[0].revents, POLLIN);
}

}  // namespace
}  // namespace scanbench::io
