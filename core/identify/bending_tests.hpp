// SPDX-License-Identifier: GPL-3.0-or-later
// Bending stiffness of a fabric from the tests for it.
//
//   B     N mm      moment per width over curvature; w  N/mm^2  weight per area
//   c     mm        Peirce's bending length, B = w c^3
//
// Cantilever (Peirce 1930; ASTM D1388, ISO 4604). A strip that hangs over an edge by L is a heavy
// elastica. With theta the angle of its tangent below the edge and t the distance from its free end
// over c:   theta'' = -t cos(theta), theta'(0) = 0, theta(L/c) = 0.                        (a)
// Its chord's angle or its sag fix theta(0), and so L/c: c = 0.4999 L at the 41.5 degrees of the
// standards, which take L/2. Peirce's formula for other angles of the chord, c = L (cos(phi/2) /
// (8 tan(phi)))^(1/3), gives a c that is 2 % larger there, 4 % at 60 degrees.
//
// Three points. Span S, width b, force F in the middle, deflection d << S: F = 48 B b d / S^3. A
// fabric whose B falls with curvature: moments M = F x / (2 b) at x from a support are statically
// determined, so that with M_m in the middle
//   d = (S / (2 M_m))^2 times the integral of kappa(M) M dM from 0 to M_m,                  (b)
// linear in kappa(M): a table of it by least squares.
//
// Transition zone in the plane (docs/theory/bending.md): where a region of one shear passes into
// another, gamma(s) = a + b exp(-s/l) along the yarn, and D_g = n_c Cs'(a) l^2.
#pragma once

#include "core/identify/fit_quality.hpp"
#include "core/model/fabric.hpp"

#include <optional>
#include <vector>

namespace plyform {

/// Bending stiffness with the rows that it is from.
struct BendingFit {
  double stiffness = 0.0, limits = 0.0; ///< N mm, half width of the 95 % limits; 0: of one reading
  MomentLaw table; ///< of a fabric that does not bend linearly; stiffness is then its first slope
  double bending_length = 0.0;     ///< mm
  std::vector<double> of_specimen; ///< N mm
  double scatter = 0.0;            ///< standard deviation between specimens, N mm
  FitQuality quality;
  std::vector<double> x, measured, fitted;
  std::vector<std::size_t> specimen;
};

/// L/c of a strip whose chord (from edge to tip) is inclined by an angle (rad, in (0, pi/2)) to the
/// horizontal; of one whose tip lies lower than the edge by this share of L, in (0, 1).
double overhang_at_chord(double angle);
double overhang_at_sag(double share);

enum class CantileverReading { chord_angle, sag };

/// Readings of one or more specimens: x overhang L (mm), y chord's angle (rad) or sag (mm). The
/// bending length is the mean of the specimens, that of a specimen the mean of its readings.
/// Reports an error for readings that cannot be, and a bending length that is no fabric's.
std::optional<BendingFit> identify_cantilever(const std::vector<Curve>& curves,
                                              CantileverReading reading, const Fabric& fabric,
                                              const FitOptions& options, Diagnostics& diagnostics);

struct ThreePointSpecimen {
  double span, width; ///< mm
};

/// Force (N) against deflection (mm) of one or more specimens; rows up to options.to, as share of
/// the span, count. One stiffness if a line follows each curve, else a table by (b) of all rows.
/// Corrections and errors as of identify_tension; a table that does not rise is an error.
std::optional<BendingFit> identify_three_point(const std::vector<Curve>& curves,
                                               const ThreePointSpecimen& specimen,
                                               const Fabric& fabric, const FitOptions& options,
                                               Diagnostics& diagnostics);
/// Larger deflections over the span are no longer small.
inline constexpr double small_deflection = 0.1;

struct ZoneFit {
  double length = 0.0, length_limits = 0.0;       ///< l, mm
  double stiffness = 0.0, stiffness_limits = 0.0; ///< D_g, N mm
  double plateau = 0.0;                           ///< a, rad
  std::vector<double> lengths;                    ///< of each profile
  std::vector<double> x, measured, fitted;        ///< mm, rad, rad
  std::vector<std::size_t> specimen;
  FitQuality quality; ///< residuals over the step b
};

/// D_g from profiles: x distance along a yarn (mm), y shear angle (rad), from the side of the step
/// into the zone. The fabric must have its law of shear.
std::optional<ZoneFit> identify_zone(const std::vector<Curve>& curves, const Fabric& fabric,
                                     const FitOptions& options, Diagnostics& diagnostics);
/// Reports an error if the law of shear is among what a fabric file misses.
void check_zone_fabric(const std::vector<std::string>& missing, const Place& at,
                       Diagnostics& diagnostics);

} // namespace plyform
