// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of points, with fillets and arcs, in case files: profiles of tools, outlines of blanks.
#pragma once

#include "base/diagnostics.hpp"
#include "contact/shapes/tool_shape.hpp"
#include "core/input/keys/toml_tree.hpp"

namespace plyform {

/// The chain that a valid list of [a, b], [a, b, fillet] and {to, centre, turn} makes; with
/// `closed` back to the first point. item: dotted path of the list. Reports arcs and fillets that
/// do not fit, and returns what there is so far then.
Profile read_points(const TomlNode& list, const std::string& item, const PointWords& words,
                    bool closed, Diagnostics& diagnostics);

} // namespace plyform
