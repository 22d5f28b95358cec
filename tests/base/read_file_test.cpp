// SPDX-License-Identifier: GPL-3.0-or-later
// Files of others that have no end, or never begin.
#include "base/read_file.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace plyform::read_file_test {
namespace {

class ReadFile : public ::testing::Test {
protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / ("plyform_files_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  /// Why it is refused; empty if it is read.
  std::string refusal(const std::filesystem::path& file) const {
    std::string reason;
    const bool read = read_file(file, 1000, reason).has_value();
    EXPECT_EQ(read, reason.empty());
    EXPECT_EQ(fault_of_file(file, 1000).empty(), read) << reason;
    return reason;
  }
  std::filesystem::path folder;
};

TEST_F(ReadFile, GivesTheBytesOfAFile) {
  const std::string bytes("a\0b\r\n\xff", 6);
  std::ofstream(folder / "some", std::ios::binary) << bytes;
  std::filesystem::create_symlink(folder / "some", folder / "link");
  std::ofstream(folder / "empty");
  std::string reason;
  EXPECT_EQ(read_file(folder / "some", 6, reason), bytes);
  EXPECT_EQ(read_file(folder / "link", 6, reason), bytes);
  EXPECT_EQ(read_file(folder / "empty", 6, reason), "");
  EXPECT_EQ(read_file(folder / "some", 6, reason, std::string_view("a\0b", 3)), bytes);
  EXPECT_EQ(read_file(folder / "some", 6, reason, "ab"), std::string("a\0", 2))
      << "begins otherwise";
}

TEST_F(ReadFile, PipesDevicesFoldersAndSocketsAreRefused) {
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal(folder / "pipe"), "is a pipe, not a file"); // and does not wait for a writer
  std::filesystem::create_symlink(folder / "pipe", folder / "link");
  EXPECT_EQ(refusal(folder / "link"), "is a pipe, not a file");
  EXPECT_EQ(refusal("/dev/zero"), "is a device, not a file");
  EXPECT_EQ(refusal(folder), "is a folder, not a file");
  EXPECT_EQ(refusal(folder / "none"), "cannot be opened: No such file or directory");
  std::filesystem::create_symlink("self", folder / "self");
  EXPECT_EQ(refusal(folder / "self"), "cannot be opened: Too many levels of symbolic links");
  const int number = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = (folder / "socket").string();
  ASSERT_LT(name.size(), sizeof address.sun_path);
  name.copy(address.sun_path, name.size());
  ASSERT_EQ(bind(number, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(refusal(folder / "socket"), "is a socket, not a file");
  close(number);
}

TEST_F(ReadFile, LargeFilesAreRefusedBeforeTheyAreRead) {
  std::ofstream(folder / "sparse");
  std::filesystem::resize_file(folder / "sparse", std::uintmax_t{10} << 30);
  EXPECT_EQ(refusal(folder / "sparse"),
            "is too large: it has 10240 MB, and 1000 bytes are read at most");
  std::ofstream(folder / "more") << std::string(1001, 'x');
  EXPECT_EQ(refusal(folder / "more"),
            "is too large: it has 1001 bytes, and 1000 bytes are read at most");
  std::ofstream(folder / "most") << std::string(1000, 'x');
  EXPECT_EQ(refusal(folder / "most"), "");
  if (!std::filesystem::exists("/proc/self/maps")) return;
  std::string reason; // the kernel's files say that they have no bytes
  EXPECT_FALSE(read_file("/proc/self/maps", 100, reason));
  EXPECT_EQ(reason, "is too large: 100 bytes are read at most");
}

} // namespace
} // namespace plyform::read_file_test
