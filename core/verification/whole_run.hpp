// SPDX-License-Identifier: GPL-3.0-or-later
// What symmetry hides: the whole of a scene of which a part was modelled (Case::part_at), run once
// with its first moving tool off the symmetry by a thousandth of an element.
#pragma once

#include "core/results/verification.hpp"
#include "core/run/run.hpp"
#include "core/verification/verify.hpp"

namespace plyform {

/// Runs the whole and compares it with what was shown of the part. band: degrees, of its shear.
/// Nothing if it was interrupted or did not go to its end. Throws as run_case.
std::optional<WholeRun> run_whole(const Case& whole, const RunResult& shown, ErrorPart band,
                                  int threads, const VerifyHooks& hooks);

/// Why not to trust a part whose symmetry waves break; empty: none do.
std::string doubt_of_symmetry(const WholeRun& whole);

} // namespace plyform
