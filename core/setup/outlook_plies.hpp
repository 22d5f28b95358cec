// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of the plies of a scene before it is run.
#pragma once

#include "base/format.hpp"
#include "core/solver/scene.hpp"

#include <string>
#include <vector>

namespace plyform {

/// As Outlook::lines.
using Lines = std::vector<std::string>;

template <class... T>
void say(Lines& lines, fmt::TextOf<T...> text, const T&... arguments) {
  lines.push_back(fmt::format(text, arguments...));
}

/// Size, mesh, element and bending of each ply.
void describe_plies(const Scene& s, Lines& lines);

/// Warns of plies that lock slightly: those of averaged elements whose yarns bear compression, with
/// too few elements across a narrow ply (docs/verification/closed_forms.md,
/// YarnsThatBearCompressionNeedAFinerMesh).
void describe_locking(const Scene& s, Lines& lines);

/// Warns of nets that hardly resist shear on a mesh askew to their yarns (docs/theory/element.md).
void describe_limp(const Scene& s, Lines& lines);

/// Gives the wavelengths of wrinkles of compressed plies under tools that are pushed, once for each
/// fabric and blank.
void describe_wrinkles(const Scene& s, Lines& lines);

} // namespace plyform
