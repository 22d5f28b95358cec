// SPDX-License-Identifier: GPL-3.0-or-later
// A file with the bytes that libFuzzer made, for readers that take a path.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace plyform::fuzz {

/// A folder for this process, in memory where the system has one for that.
inline const std::filesystem::path& folder() {
  static const auto* const made = new std::filesystem::path([] { // lives on to the last handler
    std::filesystem::path base = std::filesystem::temp_directory_path();
    if (std::filesystem::is_directory("/dev/shm")) base = "/dev/shm";
    base /= "plyform_fuzz_" + std::to_string(getpid());
    std::filesystem::create_directories(base);
    return base;
  }());
  static const int registered = std::atexit([] {
    std::error_code ignored;
    std::filesystem::remove_all(folder(), ignored);
  });
  (void)registered;
  return *made;
}

inline std::filesystem::path put(const char* name, const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path path = folder() / name;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

} // namespace plyform::fuzz
