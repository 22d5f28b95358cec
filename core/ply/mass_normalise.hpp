// SPDX-License-Identifier: GPL-3.0-or-later
// Mass normalisation of displacements and forces: y = M^-1/2 v, w = M^-1/2 f, so that f = K y gives
// w = M^-1/2 K M^-1/2 v. Vectors v, w have three degrees of freedom per node.
#pragma once

#include "core/ply/membrane.hpp"

#include <Eigen/Core>
#include <cmath>

namespace plyform {

/// y = M^-1/2 v, mass (t) of n nodes: y of n nodes (mm) from v of size 3 n (mm t^1/2).
inline void over_root_of_mass(std::span<const double> mass,
                              const Eigen::Ref<const Eigen::VectorXd>& v, std::span<Vec3> y) {
  for (std::size_t n = 0; n < y.size(); ++n)
    y[n] = v.segment<3>(static_cast<Eigen::Index>(3 * n)) / std::sqrt(mass[n]);
}

/// w = M^-1/2 f: w of size 3 n (N t^-1/2) from f of n nodes (N).
inline void over_root_of_mass(std::span<const double> mass, std::span<const Vec3> f,
                              Eigen::Ref<Eigen::VectorXd> w) {
  for (std::size_t n = 0; n < f.size(); ++n)
    w.segment<3>(static_cast<Eigen::Index>(3 * n)) = f[n] / std::sqrt(mass[n]);
}

} // namespace plyform
