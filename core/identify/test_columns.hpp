// SPDX-License-Identifier: GPL-3.0-or-later
// What the two columns of each test's curve are, for read_curve. Which ones the user chooses, and
// hints that name options, are added by the program.
#pragma once

#include "core/identify/bending_tests.hpp"
#include "core/identify/curve_file.hpp"

namespace plyform {

/// A frame's load may be a normalised force, N/mm: normalised_force.hpp.
CurveColumns shear_columns(bool frame);
/// Tension and compression; strain: else displacement.
CurveColumns tension_columns(bool strain);
/// Of rubber: strain or stretch, else displacement; a force of the section, else a nominal stress.
CurveColumns rubber_columns(bool displacement, bool force);
CurveColumns three_point_columns();
CurveColumns cantilever_columns(CantileverReading reading);
CurveColumns zone_columns();
/// Thickness or fibre volume fraction, and pressure.
CurveColumns compaction_columns();

} // namespace plyform
