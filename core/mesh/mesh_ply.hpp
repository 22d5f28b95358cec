// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of a ply where it lies at the start.
#pragma once

#include "core/mesh/mesh_blank.hpp"
#include "core/model/case.hpp"

namespace plyform {

/// Meshes the ply's blank, turns it by the ply's rotation and moves its origin to the seed. The
/// mesh turns with the blank, but for zones along tools, which stay with these; the yarns stay at
/// the ply's angle. Throws as mesh_blank.
BlankMesh mesh_ply(const Case& data, const Ply& ply);

} // namespace plyform
