// Interrupts from outside, and those that children send.
#include "harness/io/process/interrupts.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <limits>

#include "harness/io/process/child.hpp"

namespace scanbench::io {
namespace {

TEST(InterruptWatch, NotesASignalAndRestoresTheActions) {
  const auto before = std::signal(SIGINT, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const InterruptWatch watch;
    EXPECT_EQ(InterruptWatch::signal(), 0);
    ::raise(signal);
    EXPECT_EQ(InterruptWatch::signal(), signal);
    EXPECT_EQ(InterruptWatch::sender(), 0);
  }
  EXPECT_TRUE(std::signal(SIGINT, before) == SIG_IGN);
}

TEST(InterruptWatch, SigtermStays) {
  const InterruptWatch watch;
  ::raise(SIGTERM);
  EXPECT_EQ(InterruptWatch::signal(), SIGTERM);
  ::raise(SIGINT);
  EXPECT_EQ(InterruptWatch::signal(), SIGTERM);
}

TEST(InterruptWatch, LeavesHangupsIgnored) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  {
    const InterruptWatch watch;
    ::raise(SIGHUP);
    EXPECT_EQ(InterruptWatch::signal(), 0);
  }
  EXPECT_TRUE(std::signal(SIGHUP, before) == SIG_IGN);
}

TEST(InterruptWatch, ASignalOfAChildIsNotedWithTheChild) {
  const InterruptWatch watch;
  Child child = start_child({}, [] { return ::kill(::getppid(), SIGTERM); });
  child.wait(std::numeric_limits<double>::infinity());  // it is not reaped, so that its parent is known
  EXPECT_EQ(InterruptWatch::signal(), 0);
  EXPECT_EQ(InterruptWatch::sender(), child.pid());
}

TEST(InterruptWatch, AChildHasTheDefaultActions) {
  const InterruptWatch watch;
  Child child = start_child({}, [] {
    InterruptWatch::end_in_child();
    return ::raise(SIGTERM);
  });
  EXPECT_EQ(child.reap().signal, SIGTERM);
}

}  // namespace
}  // namespace scanbench::io
