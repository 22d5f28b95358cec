// SPDX-License-Identifier: GPL-3.0-or-later
// A cell of a weave with crimp: two yarns that go over and under each other, so that pulling one
// straightens it and lifts the other. Straight from crossing to crossing, as in the biaxial theory
// of Kawabata, Niwa and Kawai, J. Textile Inst. 64 (1973) 21-46; heights by Peirce's condition
// (ibid. 28 (1937) T45) that yarns stay in touch: h_1 + h_2 = D.
//
//        ____________ p_a (1 + eps_a)
//       |            |
//        .         _o   |            o  the yarn of the other family, seen along it
//           L_a _.-     | h_a        half a wave of a yarn, from crossing to crossing
//          _.-          |
//         o             |
//
//   p_a    mm  half a wave in the unformed fabric: n spacings of the yarns that it crosses
//   n      -   1 of a plain weave, 2 of a 2/2 twill: float of the weave
//   c_a    -   crimp, length of yarn over the distance that it spans, less 1
//   L_a0   mm  p_a (1 + c_a);  h_a0 = sqrt(L_a0^2 - p_a^2), height of the wave; D = h_10 + h_20
//   L_a    mm  sqrt(p_a^2 (1 + eps_a)^2 + h_a^2);  e_a = L_a / L_a0 - 1, elongation of the yarn
//   T_a    N   tension of the yarn, T_a(e_a), by its own law; 0 for e_a < 0 (it is slack)
//   w_a    N mm   L_a0 times the integral of T_a over e_a
//
//   w(eps_1, eps_2) = min over h_1 in [0, D] of w_1(eps_1, h_1) + w_2(eps_2, D - h_1)          (C1)
//   T_1 h_1 / L_1 = T_2 h_2 / L_2      at the minimum, unless at an end: forces across it      (C2)
//   N_a = T_a p_a (1 + eps_a) / L_a    per yarn; h_1 gives no term, w being a minimum over it  (C3)
//
// w_a is convex in length and height for yarns whose tension does not fall, so w is convex, and its
// second derivative is at most that at constant heights, which is at most p_a^2 / L_a0 times the
// largest slope of T_a along each direction. Twice convex: no element gets soft that was stable.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace plyform {

struct Case;
struct TensionLaw;

struct CrimpedCell {
  std::array<double, 2> half_wave{}; ///< p_a, mm
  std::array<double, 2> crimp{};     ///< c_a, at least 0

  double length(std::size_t a) const { return half_wave[a] * (1.0 + crimp[a]); } ///< L_a0, mm
  double height(std::size_t a) const;                                            ///< h_a0, mm
  double heights() const { return height(0) + height(1); }                       ///< D, mm
  /// Strain at which a family is straight if nothing holds the other, the end of its toe; the other
  /// must be long enough to take all of D.
  double toe(std::size_t a) const { return crimp[a]; }
  /// Strain down to which family a gets shorter by more crimp alone, 0 at most: it takes the height
  /// that the other, strained by `other`, gives up. What is shorter is pressed.
  double shortest(std::size_t a, double other) const;
};

/// What a cell answers at two strains.
struct CellAnswer {
  std::array<double, 2> pull{};   ///< N_a, N per yarn
  std::array<double, 2> stored{}; ///< w_a / p_a, N mm per mm of fabric along the yarn
  double height = 0.0;            ///< h_1, mm
  /// dN_a/deps_a (N) of the cell, the other strain constant
  std::array<double, 2> slope{};
  double cross = 0.0; ///< p_a dN_a/deps_b, N mm: the same for both
};

/// (C1) to (C3) of a cell of yarns of these laws, their tension alone, at strains eps_a.
CellAnswer answer_of(const CrimpedCell& cell, const std::array<double, 2>& strain,
                     const TensionLaw& first, const TensionLaw& second);

/// Cells of a case's fabrics and where their yarns are straight, for the user: a line per crossing
/// with crimp.
std::vector<std::string> describe_crimp(const Case& data);

} // namespace plyform
