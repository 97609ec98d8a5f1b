#include "docent/base/destination.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

namespace docent {
namespace {

namespace fs = std::filesystem;

class Destinations : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "far"); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::path{::testing::TempDir()} / "docent_destination_test";
};

TEST_F(Destinations, LinksAreFollowedToFilesThatAreThereOrNot) {
  std::ofstream{folder_ / "far" / "there"} << "x";
  fs::create_symlink("far/there", folder_ / "one");
  fs::create_symlink("one", folder_ / "two");
  fs::create_symlink("far/not_yet", folder_ / "dangling");
  EXPECT_EQ(destination_of(folder_ / "plain")->path, folder_ / "plain");
  EXPECT_EQ(destination_of(folder_ / "one")->path, folder_ / "far" / "there");
  EXPECT_EQ(destination_of(folder_ / "two")->path, folder_ / "far" / "there");
  EXPECT_EQ(destination_of(folder_ / "dangling")->path, folder_ / "far" / "not_yet");
  for (const char* name : {"plain", "one", "two", "dangling", "far"})
    EXPECT_FALSE(destination_of(folder_ / name)->is_stream) << name;
}

TEST_F(Destinations, CirclesAndSocketsAreRefused) {
  fs::create_symlink("b", folder_ / "a");
  fs::create_symlink("a", folder_ / "b");
  EXPECT_NE(destination_of(folder_ / "a").error().message.find("a: cannot be written: "), std::string::npos);

  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = (folder_ / "socket").string();
  ASSERT_LT(path.size(), sizeof address.sun_path);
  std::copy(path.begin(), path.end(), address.sun_path);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(destination_of(path).error().message, path + ": cannot be written: it is a socket");
  ::close(socket);
}

TEST_F(Destinations, PipesAndTerminalsAreStreams) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder_ / "link");
  EXPECT_TRUE(destination_of(folder_ / "pipe")->is_stream);
  EXPECT_TRUE(destination_of(folder_ / "link")->is_stream);
  EXPECT_EQ(destination_of(folder_ / "link")->path, folder_ / "pipe");
  EXPECT_TRUE(destination_of("/dev/null")->is_stream);

  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  ASSERT_EQ(::grantpt(terminal), 0);
  ASSERT_EQ(::unlockpt(terminal), 0);
  const auto to = destination_of(::ptsname(terminal));
  EXPECT_TRUE(to->is_stream);
  const int file = open_destination(*to, folder_ / "beside");
  ASSERT_GE(file, 0);
  EXPECT_EQ(::write(file, "hello", 5), 5);
  std::array<char, 10> read{};
  EXPECT_EQ(::read(terminal, read.data(), read.size()), 5);
  EXPECT_STREQ(read.data(), "hello");
  EXPECT_FALSE(fs::exists(folder_ / "beside"));
  ::close(file);
  ::close(terminal);
}

TEST_F(Destinations, WhatIsOpenGoesOnWhereItIs) {
  // As --report /dev/stdout where the shell sent that to a file.
  const fs::path path = folder_ / "output";
  const int open = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(::write(open, "before ", 7), 7);
  for (const std::string& name : {"/dev/fd/" + std::to_string(open), "/proc/self/fd/" + std::to_string(open)}) {
    const auto to = destination_of(name);
    ASSERT_TRUE(to->is_stream) << name;
    EXPECT_EQ(to->descriptor, open) << name;
    const int file = open_destination(*to, folder_ / "beside");
    ASSERT_GE(file, 0);
    EXPECT_NE(file, open);
    EXPECT_EQ(::write(file, "own ", 4), 4);
    ::close(file);
  }
  ASSERT_EQ(::write(open, "after", 5), 5);
  ::close(open);
  std::string line;
  std::ifstream stream{path};
  std::getline(stream, line);
  EXPECT_EQ(line, "before own own after");
}

TEST_F(Destinations, AFileIsOpenedBesideItsOwn) {
  std::ofstream{folder_ / "there"} << "old";
  const int file = open_destination(*destination_of(folder_ / "there"), folder_ / "beside");
  ASSERT_GE(file, 0);
  ::close(file);
  EXPECT_EQ(fs::file_size(folder_ / "there"), 3U);
  EXPECT_EQ(fs::file_size(folder_ / "beside"), 0U);
  EXPECT_LT(open_destination(*destination_of(folder_ / "no" / "where"), folder_ / "no" / "beside"), 0);
}

TEST_F(Destinations, TwoNamesOfOneFileReplaceEachOther) {
  fs::create_symlink("far/x", folder_ / "link");
  fs::create_symlink("far", folder_ / "near");
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(replace_each_other(folder_ / "a", folder_ / "a"));
  EXPECT_TRUE(replace_each_other(folder_ / "a", folder_ / "far" / ".." / "a"));
  EXPECT_TRUE(replace_each_other(folder_ / "link", folder_ / "far" / "x"));
  EXPECT_TRUE(replace_each_other(folder_ / "near" / "y", folder_ / "far" / "y"));
  EXPECT_TRUE(replace_each_other("here.json", "./here.json"));
  EXPECT_FALSE(replace_each_other(folder_ / "a", folder_ / "b"));
  EXPECT_FALSE(replace_each_other(folder_ / "x", folder_ / "far" / "x"));
  EXPECT_FALSE(replace_each_other(folder_ / "pipe", folder_ / "pipe"));
  EXPECT_FALSE(replace_each_other("/dev/null", "/dev/null"));
}

}  // namespace
}  // namespace docent
