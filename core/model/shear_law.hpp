// SPDX-License-Identifier: GPL-3.0-or-later
// The law of shear of a crossing: torque that two families exert on each other in one unit cell
// against the shear angle gamma, which is positive where the angle between the first family and the
// second closes: the diagonal first + second of a cell gets longer, the other one shorter.
//
//        second                    /second
//        |   /.                   /  .:
//        |  / .   gamma > 0      / .:
//        | /  .   ------->      /.:
//        +------ first         +------ first
//
// The law may be odd, or differ by the sign of gamma, as that of a fabric whose stitches run along
// one diagonal does. Yarn strains within a pair deviate from their means by what counts as shear
// (core/ply/membrane.hpp) and has no sign, s^2 = beta (delta_a^2 + delta_b^2). With the measure
// g^2 = gamma^2 + s^2, u = gamma / g and W, the integral of C from 0, a cell stores
//
//   E = (1 + phi(u))/2 W(g) + (1 - phi(u))/2 W(-g),  phi(u) = u (1 + b - b u^2), b = 0.48       (C)
//     = W_o(g) + phi(u) W_e(g),  W_o, W_e(g) = (W(g) +- W(-g))/2
//
// The integrals of the odd and of the even part of C, C_o, C_e(g) = (C(g) -+ C(-g))/2, are W_o and
// W_e. Without deviations E = W(gamma); of an odd law W_e = 0 and E = W(g). The derivatives are
//
//   p      = C_o/g + phi C_e/g - u phi' W_e/g^2    2 dE/d(s^2), the stiffness of deviations     (D)
//   torque = gamma p + phi' W_e/g                  dE/dgamma
//
// Deviations small beside gamma cost what shear of that side does, but for a hundredth that is of
// the other one, so that they are never free where one side is stiff. With C linear on either side
// E is convex, and nowhere softer than the softer side: docs/theory/element.md.
#pragma once

#include "core/model/law_point.hpp"
#include "core/model/monotone_curve.hpp"

#include <vector>

namespace plyform {

constexpr double side_cubic = 0.48; ///< b of (C)

/// Answer of one cell.
struct ShearResponse {
  double torque = 0.0; ///< N mm, dE/dgamma of (C)
  double secant = 0.0; ///< N mm, p of (D)
  double energy = 0.0; ///< N mm, E of (C)
};

/// Torque against shear angle: a polynomial, k[0] g + k[1] g^3 + k[2] g^5 ..., or a table through
/// which a monotone curve passes. A table from (0, 0) on is odd; one that starts at a negative
/// angle and has (0, 0) within is the law of both signs.
struct ShearLaw {
  std::vector<double> k;             ///< N mm, coefficients of g, g^3, g^5 ...
  std::vector<double> angle, torque; ///< rad and N mm, ascending; straight on beyond the ends
  std::vector<double> negative_k{};  ///< N mm, in the place of k for g < 0; empty: k

  bool operator==(const ShearLaw&) const = default;
  bool tabulated() const { return !angle.empty(); }
  /// Whether Cs(-g) = -Cs(g) for all g by the law's form.
  bool odd() const { return tabulated() ? !(angle.front() < 0.0) : negative_k.empty(); }
  /// The table, with views of this law.
  MonotoneCurve curve() const { return {angle, torque, odd()}; }
  /// Cs (N mm), dCs/dg (N mm/rad), Ws (N mm); g in rad, of either sign: -0.0 is of the negative
  /// side.
  LawPoint at(double g) const;
  double secant(double g) const; ///< Cs(g) / g, N mm; its limit at 0
  /// The odd part, the mean of both sides: C_o, its slope and W_o; g >= 0.
  LawPoint odd_part(double g) const;
  /// (C) and (D). gamma: rad; deviation2: s^2.
  ShearResponse respond(double gamma, double deviation2) const;
};

} // namespace plyform
