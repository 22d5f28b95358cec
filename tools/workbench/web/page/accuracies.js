// SPDX-License-Identifier: GPL-3.0-or-later
// The accuracies that forms offer.

/** Of a run, with what is said of each where one is chosen. */
export const ACCURACIES = [["", "as the case has it"], ["instant", "instant: plies alone, at once"],
  ["draft", "draft: shear angles to 3°"], ["standard", "standard: to 1°"], ["reference", "reference: to 0.3°"]];
