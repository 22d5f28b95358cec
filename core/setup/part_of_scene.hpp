// SPDX-License-Identifier: GPL-3.0-or-later
// symmetry = "scene": models the half or quarter of a scene that its planes of symmetry leave.
#pragma once

#include "core/setup/prepare_case.hpp"

namespace plyform {

/// Cuts a prepared case at the planes of symmetry that hold (core/setup/symmetry_ahead.hpp), and
/// says in its notes what is modelled, or warns of why nothing could be left out. Blanks end on
/// boundaries of kind symmetry, forces are those of the part, Case::part_at says what is shown.
/// Nothing is done unless the case asks for it.
void take_part(PreparedCase& prepared);

/// The whole of which a part was taken, with the solver's options and element sizes of the part.
/// prepared.whole must be there.
Case whole_of(const PreparedCase& prepared);

} // namespace plyform
