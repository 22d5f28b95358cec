// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/format.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <sys/file.h>
#include <unistd.h>

namespace plyform {

/// Keeps other runs out of a folder while it exists.
class FolderLock {
public:
  /// Throws std::runtime_error if another run has the folder.
  explicit FolderLock(const std::filesystem::path& directory)
      : file_(open(directory.c_str(), O_RDONLY)) {
    if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(file_);
      throw std::runtime_error(fmt::format(
          "{}: another run writes into this folder; wait for it, or give another one with -o",
          directory.string()));
    }
  }
  ~FolderLock() {
    if (file_ >= 0) close(file_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int file_;
};

} // namespace plyform
