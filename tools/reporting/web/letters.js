// SPDX-License-Identifier: GPL-3.0-or-later
// How runs that stand beside each other are called.

export const letterOf = (run) => "ABCD"[run];
/** "B: ", before what is of one run of several; empty where there is but one. */
export const prefixOf = (run, runs) => (runs.length > 1 ? `${letterOf(run)}: ` : "");
export const differenceName = (run) => `${letterOf(run)} − A`;
