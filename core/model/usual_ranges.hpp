// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges in which numbers of fabrics usually lie: numbers in files outside of them are warned of,
// laws from measured curves outside of them are refused unless the user says that they are right.
#pragma once

namespace plyform {

struct UsualRange {
  double least, most;
  bool holds(double value) const { return value >= least && value <= most; }
};

/// N per yarn, tension over strain.
inline constexpr UsualRange usual_stiffness{100.0, 1e6};
/// N mm, bending stiffness per width.
inline constexpr UsualRange usual_bending_stiffness{0.0, 1e4};
/// mm, Peirce's bending length: garment cloth 10 to 40, reinforcements 20 to 200.
inline constexpr UsualRange usual_bending_length{10.0, 300.0};
/// N/mm per rad, torque of a cell over its shear angle and area, at 10 degrees. Garment cloth has
/// 0.01 to 0.3 (0.2 to 5 gf/cm degree by Kawabata's tester), dry reinforcements 0.01 to 0.5,
/// thermoplastic prepregs up to some N/mm.
inline constexpr UsualRange usual_shear_rigidity{1e-3, 10.0};
/// N/mm^2, shear modulus of rubber: from very soft silicone to hard bags of Shore A 70.
inline constexpr UsualRange usual_rubber_modulus{0.02, 5.0};

/// N/mm^2, at the densest packing of a ply: vacuum 0.1, autoclaves and RTM to 2, presses to 5.
inline constexpr double usual_compaction_pressure = 5.0;

} // namespace plyform
