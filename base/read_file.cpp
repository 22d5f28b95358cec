// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/read_file.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace plyform {
namespace {

/// An open file, closed with this.
class Descriptor {
public:
  explicit Descriptor(const std::filesystem::path& file) {
    do // O_NONBLOCK: a pipe that nobody writes to is opened too, to be refused
      number_ = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    while (number_ < 0 && errno == EINTR);
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

private:
  int number_ = -1;
};

std::string system_text(int error) {
  return std::generic_category().message(error);
}

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

std::string size_text(std::uintmax_t bytes) {
  constexpr std::uintmax_t mega = 1 << 20;
  return bytes < 10 * mega ? fmt::format("{} bytes", bytes) : fmt::format("{} MB", bytes / mega);
}

/// Why what is open is not to be read; empty if it is.
std::string fault_of(const Descriptor& in, const std::filesystem::path& file, std::size_t most,
                     std::size_t& size) {
  struct stat found {};
  const int error = in.number() < 0 ? errno : 0;
  const bool known =
      in.number() >= 0 ? fstat(in.number(), &found) == 0 : stat(file.c_str(), &found) == 0;
  if (known && !S_ISREG(found.st_mode)) // a socket cannot be opened
    return fmt::format("is {}, not a file", kind_of(found.st_mode));
  if (in.number() < 0) return "cannot be opened: " + system_text(error);
  if (!known) return "cannot be read: " + system_text(errno);
  size = static_cast<std::size_t>(std::max<off_t>(found.st_size, 0));
  if (size > most)
    return fmt::format("is too large: it has {}, and {} are read at most", size_text(size),
                       size_text(most));
  return {};
}

} // namespace

std::optional<std::string> read_file(const std::filesystem::path& file, std::size_t most,
                                     std::string& reason, std::string_view begin) {
  const Descriptor in(file);
  std::size_t size = 0;
  reason = fault_of(in, file, most, size);
  if (!reason.empty()) return std::nullopt;
  constexpr std::size_t part = 1 << 16;
  std::string content(begin.size(), '\0');
  if (!begin.empty()) {
    const ssize_t count = read(in.number(), content.data(), content.size());
    if (count != static_cast<ssize_t>(begin.size()) || content != begin) {
      content.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
      return content;
    }
  }
  content.resize(size + 1); // one more, to see the end at once
  for (std::size_t at = begin.size();;) {
    if (at == content.size()) content.resize(at + part); // it grows, or is one of the kernel's
    const ssize_t count = read(in.number(), content.data() + at, content.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      reason = "cannot be read: " + system_text(errno);
      return std::nullopt;
    }
    at += static_cast<std::size_t>(count);
    if (at > most) {
      reason = fmt::format("is too large: {} are read at most", size_text(most));
      return std::nullopt;
    }
    if (count == 0) {
      content.resize(at);
      return content;
    }
  }
}

std::string fault_of_file(const std::filesystem::path& file, std::size_t most) {
  std::size_t size = 0;
  return fault_of(Descriptor(file), file, most, size);
}

} // namespace plyform
