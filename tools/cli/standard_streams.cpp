// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/standard_streams.hpp"

#include "base/words.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace plyform {
namespace {

void open_missing_descriptors() {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd)
    if (fcntl(fd, F_GETFD) < 0) {
      // the wrong way round: what is printed there fails, and is told
      const int opened = open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
      if (opened > fd) close(opened);
    }
}

#ifdef __GLIBC__

bool write_all(int to, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = write(to, text.data() + at, text.size() - at);
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) at += static_cast<std::size_t>(written);
  }
  return true;
}

/// A stream in the place of a standard one.
struct Stream {
  int to;
  bool must_arrive;       ///< else what is not taken is dropped
  std::string begun = {}; ///< the first bytes of a character that came in two parts
};

/// Bytes at the end of a text that may be the begin of a character of UTF-8.
std::size_t bytes_begun(const std::string& text) {
  for (std::size_t back = 1; back <= 3 && back <= text.size(); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if (byte < 0x80) return 0;
    if (byte < 0xC0) continue; // within a character
    const std::size_t bytes = byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : 2;
    return bytes > back ? back : 0;
  }
  return 0;
}

ssize_t write_printable(void* cookie, const char* bytes, std::size_t size) {
  auto& stream = *static_cast<Stream*>(cookie);
  std::string text = stream.begun + std::string(bytes, size);
  const std::size_t rest = bytes_begun(text);
  stream.begun = text.substr(text.size() - rest);
  text.resize(text.size() - rest);
  const bool arrived = write_all(stream.to, printable(text, "\n\t"));
  return arrived || !stream.must_arrive ? static_cast<ssize_t>(size) : 0;
}

std::FILE* printable_stream(Stream& stream) {
  cookie_io_functions_t functions{};
  functions.write = write_printable;
  return fopencookie(&stream, "w", functions);
}

/// fmt and the C library print to what these two variables name.
void replace_streams() {
  // never destroyed: the C library writes what is left when the program ends
  static Stream &out = *new Stream{STDOUT_FILENO, true}, &err = *new Stream{STDERR_FILENO, false};
  if (std::FILE* made = printable_stream(out)) {
    if (isatty(STDOUT_FILENO) != 0) std::setvbuf(made, nullptr, _IOLBF, BUFSIZ);
    stdout = made;
  }
  if (std::FILE* made = printable_stream(err)) {
    std::setvbuf(made, nullptr, _IONBF, 0);
    stderr = made;
  }
}

#else
void replace_streams() {}
#endif

} // namespace

void prepare_standard_streams() {
  open_missing_descriptors();
  std::signal(SIGPIPE, SIG_IGN); // a reader that went away is one more end that takes nothing
  replace_streams();
}

} // namespace plyform
