// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/helper_process.hpp"

#include "base/format.hpp"

#include <cerrno>
#include <clocale>
#include <csignal>
#include <exception>
#include <fstream>
#include <locale>
#include <new>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace plyform {
namespace {

enum HelperCode { work_done = 0, work_refused = 1, no_memory = 2 };

/// Bytes of address space that this process has.
std::size_t own_address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void limit(int what, rlim_t amount) {
  const rlimit value{amount, amount};
  setrlimit(static_cast<__rlimit_resource>(what), &value);
}

/// Faults end the helper, quietly, and so does too much time or memory.
void prepare_helper(HelperLimits limits) {
  std::setlocale(LC_ALL, "C"); // numbers have decimal points, whatever the program around has set
  std::locale::global(std::locale::classic());
  for (const int fault : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGXCPU, SIGTERM, SIGINT})
    std::signal(fault, SIG_DFL);
  std::signal(SIGPIPE, SIG_IGN);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  if (const std::size_t own = own_address_space(); own > 0) limit(RLIMIT_AS, own + limits.bytes);
  alarm(20 * limits.seconds); // one that waits for something
}

bool write_all(int to, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = write(to, text.data() + at, text.size() - at);
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) at += static_cast<std::size_t>(written);
  }
  return true;
}

[[noreturn]] void help(const std::function<std::string()>& work, HelperLimits limits, int to) {
  int code = no_memory;
  try {
    prepare_helper(limits);
    std::string text;
    try {
      text = work();
      code = work_done;
    } catch (const std::bad_alloc&) {
      code = no_memory;
    } catch (const std::exception& error) {
      text = error.what();
      code = work_refused;
    }
    if (!write_all(to, text)) code = no_memory;
  } catch (...) {
    code = no_memory;
  }
  _exit(code); // nothing of this copy is to be flushed or written at exit
}

std::string read_all(int from) {
  std::string text;
  char part[65536];
  for (;;) {
    const ssize_t count = read(from, part, sizeof part);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(part, static_cast<std::size_t>(count));
  }
}

} // namespace

HelperResult in_helper_process(const std::function<std::string()>& work, HelperLimits limits) {
  const auto fail = [](const char* what) {
    throw std::runtime_error(fmt::format("{}: {}", what, std::generic_category().message(errno)));
  };
  int ends[2] = {-1, -1};
  if (pipe(ends) != 0) fail("no pipe to a helper process");
  const pid_t helper = fork();
  if (helper < 0) {
    close(ends[0]), close(ends[1]);
    fail("no helper process");
  }
  if (helper == 0) {
    close(ends[0]);
    help(work, limits, ends[1]);
  }
  close(ends[1]);
  HelperResult result;
  result.text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(helper, &status, 0) < 0)
    if (errno != EINTR) fail("the helper process was lost");
  using End = HelperResult::End;
  if (WIFEXITED(status) && WEXITSTATUS(status) == work_done) return result;
  if (WIFEXITED(status) && WEXITSTATUS(status) == work_refused) {
    result.end = End::refused;
    return result;
  }
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.end =
      signal == SIGXCPU || signal == SIGKILL || signal == SIGALRM ? End::timeout : End::crashed;
  result.text = signal != 0 ? fmt::format("ended by signal {}", signal) : "out of memory";
  return result;
}

} // namespace plyform
