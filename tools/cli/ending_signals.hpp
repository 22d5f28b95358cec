// SPDX-License-Identifier: GPL-3.0-or-later
// Signals that end a run early: its state is written, and says so.
#pragma once

#include <atomic>
#include <string>

namespace plyform {

/// Lets every signal that would end the program set a flag in its place; but SIGQUIT, which ends it
/// at once, and SIGKILL, which nothing can catch. A hang-up that is ignored (nohup) stays so.
void catch_ending_signals();

/// Set by the first signal.
const std::atomic<bool>& interrupted();

/// Which it was: "signal SIGUSR1 (User defined signal 1)"; empty: none.
std::string ending_signal();

} // namespace plyform
