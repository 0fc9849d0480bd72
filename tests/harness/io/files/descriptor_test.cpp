// Owned file descriptors.
#include "harness/io/files/descriptor.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <utility>

namespace scanbench::io {
namespace {

bool is_open(int number) {
  return ::fcntl(number, F_GETFD) >= 0;
}

FileDescriptor opened(const char* path, int flags) {
  return FileDescriptor(::open(path, flags | O_CLOEXEC));
}

TEST(FileDescriptor, IsClosedOnce) {
  int number = -1;
  {
    FileDescriptor zero = opened("/dev/zero", O_RDONLY);
    number = zero.number();
    EXPECT_TRUE(is_open(number));
    FileDescriptor moved(std::move(zero));
    EXPECT_EQ(moved.number(), number);
    EXPECT_TRUE(is_open(number));
  }
  EXPECT_FALSE(is_open(number));
  FileDescriptor closed = opened("/dev/zero", O_RDONLY);
  EXPECT_EQ(closed.close(), 0);
  EXPECT_FALSE(closed.is_open());
  EXPECT_EQ(closed.close(), 0);
  EXPECT_FALSE(FileDescriptor().is_open());
}

TEST(FileDescriptor, AnAssignedOneReplacesTheOther) {
  FileDescriptor first = opened("/dev/zero", O_RDONLY);
  const int replaced = first.number();
  const int kept = [&] {
    FileDescriptor second = opened("/dev/null", O_RDONLY);
    first = std::move(second);
    return first.number();
  }();
  EXPECT_FALSE(is_open(replaced));
  EXPECT_TRUE(is_open(kept));
}

TEST(WriteAll, SaysWhyNotAllBytesWereWritten) {
  const std::array<std::byte, 10> bytes{};
  EXPECT_TRUE(write_all(opened("/dev/null", O_WRONLY).number(), bytes));
  EXPECT_FALSE(write_all(opened("/dev/full", O_WRONLY).number(), bytes));
  EXPECT_EQ(errno, ENOSPC);
}

}  // namespace
}  // namespace scanbench::io
