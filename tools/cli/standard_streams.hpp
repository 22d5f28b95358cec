// SPDX-License-Identifier: GPL-3.0-or-later
// Standard output and standard error of the program.
//
// What is printed there is printable: names and texts come from files of others, and a terminal
// obeys some bytes. No message is worth a run: where standard error takes nothing (a full disk, a
// closed pipe, a terminal that went away) what goes there is dropped. What standard output does not
// take is told at the end, by the exit code too.
#pragma once

namespace plyform {

/// To be called before anything is opened or printed. Descriptors 0 to 2 are there from then on, so
/// that no file of results gets the number of a closed standard output and with it what is printed.
void prepare_standard_streams();

} // namespace plyform
