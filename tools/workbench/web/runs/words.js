// SPDX-License-Identifier: GPL-3.0-or-later
// How runs are spoken of.

const STATES = {
  queued: "waits", starting: "starts", running: "runs", done: "done", doubtful: "doubtful", instant: "instant",
  stopped: "stopped itself", interrupted: "interrupted", failed: "could not run", killed: "killed",
  "taken out": "taken out", damaged: "damaged",
};

export const LIVE = new Set(["queued", "starting", "running"]);
export const stateWord = (run) => STATES[run.state] || run.state;

/** "about 3 min left" of a number of seconds. */
export function timeWords(seconds) {
  if (seconds < 60) return `${Math.max(0, Math.round(seconds))} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

/** What a run does now, how far it is, and what is left: one line. */
export function progressWords(run) {
  const { progress } = run;
  if (!progress) return run.state === "running" ? "begins" : stateWord(run);
  const words = [progress.words || progress.phase];
  if (Number.isFinite(progress.fraction)) words.push(`${Math.round(100 * progress.fraction)} %`);
  if (Number.isFinite(progress.remaining_s)) words.push(`about ${timeWords(progress.remaining_s)} left`);
  return words.join(", ");
}

/** Fraction of the phase, 0 to 1, or null. */
export function fractionOf(run) {
  return run.progress && Number.isFinite(run.progress.fraction) ? run.progress.fraction : null;
}
