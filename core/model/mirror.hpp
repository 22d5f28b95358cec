// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror images at vertical planes: of places, directions and whole parts.
#pragma once

#include "core/model/case.hpp"

#include <vector>

namespace plyform {

Vec3 normal_of(const SymmetryPlane& plane);

/// Of a place, mm.
Vec3 mirrored(const SymmetryPlane& plane, const Vec3& x);
/// Of a direction.
Vec3 mirrored_direction(const SymmetryPlane& plane, const Vec3& v);

/// One of the images that planes make of a part: a place x goes over to turn x + shift.
struct Mirror {
  unsigned planes = 0; ///< at which it is mirrored, as bits
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero(); ///< mm

  Vec3 place(const Vec3& x) const { return turn * x + shift; }
  Vec3 direction(const Vec3& v) const { return turn * v; }
  bool turns_round() const { return turn.determinant() < 0.0; } ///< left to right
};

/// The images of a part at planes at right angles to each other: as many as 2 to the power of
/// their number, that at no plane, the part itself, first. The bits of Mirror::planes are their
/// numbers in it.
std::vector<Mirror> images_at(const std::vector<SymmetryPlane>& planes);

/// How many such images the whole of a case has, of which a part may be modelled.
inline std::size_t parts_of(const Case& data) {
  return std::size_t{1} << data.part_at.size();
}

/// The planes of symmetry of a ply: none where they are not at right angles to each other.
std::vector<SymmetryPlane> planes_of(const std::vector<Boundary>& boundaries, int ply);

/// Whether a node that lies there before forming, mm, is on a plane, but for the rounding of
/// coordinates given with some digits.
bool lies_on(const SymmetryPlane& plane, const Vec2& x);

} // namespace plyform
