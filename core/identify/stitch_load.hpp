// SPDX-License-Identifier: GPL-3.0-or-later
// What stitches add to the load of a shear test.
//
// A stitch along s = a e_1 + b e_2, the directions of two families at right angles whose yarns keep
// their length, is as long as lambda over what it was, and adds a torque per area by its force F:
//
//   lambda^2 = a^2 + b^2 + 2 a b sin(gamma)                                                (d)
//   tau = n_s F(lambda - 1) dlambda/dgamma = n_s F a b cos(gamma) / lambda                   (e)
//
// with n_s stitches a mm across them; along the diagonal of both families it is
// n_s F cos(gamma) / (2 sqrt(1 + sin(gamma))). The load is linear in tau as it is in the torque of
// a cell, (40, 41) of shear_tests.hpp, with gamma/2 in zones that shear by half. A specimen the
// other way round has -tau(-gamma): it differs by tau(gamma) + tau(-gamma), and nothing else.
#pragma once

#include "core/identify/shear_tests.hpp"

#include <functional>
#include <vector>

namespace plyform {

/// lambda - 1 at a shear angle (rad), and dlambda/dgamma (1/rad), by (d).
struct StitchElongation {
  double strain, rate;
};
StitchElongation elongation_of(const Fabric& fabric, const Stitch& stitch, double gamma);

/// A stitch's force (N) over its elongation.
using StitchForce = std::function<double(double strain)>;

/// N, of stitches (indices into fabric.stitches) that all have this force. negative: as of
/// test_load. Of a loading that never goes back: the force may be 0 beyond some elongation.
double stitch_load(const ShearTest& test, const Fabric& fabric,
                   const std::vector<std::size_t>& stitches, double extension, bool negative,
                   const StitchForce& force);

/// N, of stitches by their own laws, gone from where they break on.
double stitch_load(const ShearTest& test, const Fabric& fabric,
                   const std::vector<std::size_t>& stitches, double extension, bool negative);

/// Indices of all stitches, without those of `but`.
std::vector<std::size_t> stitches_of(const Fabric& fabric,
                                     const std::vector<std::size_t>& but = {});

} // namespace plyform
