// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/ending_signals.hpp"

#include "base/format.hpp"

#include <csignal>
#include <cstring>
#include <vector>

namespace plyform {
namespace {

std::atomic<bool> flag{false};
std::atomic<int> first{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void on_signal(int signal) {
  int none = 0;
  first.compare_exchange_strong(none, signal);
  flag = true;
}

/// Those whose default is to end a program and that are not faults of its own.
std::vector<int> ending() {
  std::vector<int> signals{SIGINT,  SIGTERM, SIGHUP,    SIGXCPU, SIGXFSZ, SIGUSR1,
                           SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO,   SIGPWR};
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal)
    signals.push_back(signal);
  return signals;
}

} // namespace

void catch_ending_signals() {
  for (const int signal : ending()) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0) continue;
    const bool usual = (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == SIG_DFL;
    // shells start what runs in the background of a script with SIGINT ignored
    const bool background = signal == SIGINT && action.sa_handler == SIG_IGN;
    if (!usual && !background) continue; // a profiler's, or nohup
    action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

const std::atomic<bool>& interrupted() {
  return flag;
}

std::string ending_signal() {
  const int signal = first;
  if (signal == 0) return {};
#ifdef __GLIBC__
  if (const char* name = sigabbrev_np(signal))
    return fmt::format("signal SIG{} ({})", name, sigdescr_np(signal));
#endif
  return fmt::format("signal {}", signal);
}

} // namespace plyform
