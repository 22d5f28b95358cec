// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/write_whole.hpp"

#include "base/format.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace plyform {

namespace fs = std::filesystem;

void throw_cannot(const fs::path& path, const char* what, const std::error_code& error) {
  throw std::runtime_error(fmt::format("{}: cannot {}: {}", path.string(), what, error.message()));
}

namespace {

/// What went wrong in writing a file whole, and the system's error.
struct Failure {
  const char* what;
  int error;
};

std::optional<Failure> replace_file(const fs::path& path,
                                    std::initializer_list<std::string_view> parts, bool on_disk) {
  fs::path temporary = path;
  temporary += ".tmp";
  const auto fail = [&](const char* what, int error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    return Failure{what, error};
  };
  // Whatever has that name, as a pipe or a link to another file, is not written into.
  std::error_code ignored;
  fs::remove(temporary, ignored);
  const int made = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  std::FILE* file = made < 0 ? nullptr : fdopen(made, "wb");
  if (!file) {
    const int error = errno;
    if (made >= 0) close(made);
    return fail("create the file", error);
  }
  int error = 0;
  for (const std::string_view part : parts)
    if (error == 0 && std::fwrite(part.data(), 1, part.size(), file) != part.size()) error = errno;
  // On the disk before it gets its name, so that a power failure leaves the old file or the new
  // one.
  if (error == 0 && (std::fflush(file) != 0 || (on_disk && fsync(fileno(file)) != 0)))
    error = errno;
  if (std::fclose(file) != 0 && error == 0) error = errno; // fclose writes the rest of the buffer
  if (error != 0) return fail("write", error);
  std::error_code renamed;
  fs::rename(temporary, path, renamed);
  if (renamed) return fail("replace the file", renamed.value());
  return std::nullopt;
}

} // namespace

void write_whole(const fs::path& path, std::string_view content) {
  write_whole(path, std::initializer_list<std::string_view>{content});
}

void write_whole(const fs::path& path, std::initializer_list<std::string_view> parts) {
  if (const auto failure = replace_file(path, parts, true))
    throw_cannot(path, failure->what, {failure->error, std::generic_category()});
}

bool write_if_possible(const fs::path& path, std::string_view content) {
  return !replace_file(path, {content}, false);
}

} // namespace plyform
