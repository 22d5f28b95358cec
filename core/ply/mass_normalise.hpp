// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors of three freedoms a node to and from motions and forces of the nodes, over the root of
// their masses: y = M^-1/2 v, w = M^-1/2 f make M^-1/2 K M^-1/2 of K.
#pragma once

#include "core/ply/membrane.hpp"

#include <Eigen/Core>
#include <cmath>

namespace plyform {

/// y, n nodes, from v, 3 n.
inline void over_root_of_mass(const Membrane& m, const Eigen::Ref<const Eigen::VectorXd>& v,
                              std::span<Vec3> y) {
  for (std::size_t n = 0; n < y.size(); ++n)
    y[n] = v.segment<3>(static_cast<Eigen::Index>(3 * n)) / std::sqrt(m.node_mass[n]);
}

/// w, 3 n, from f, n nodes.
inline void over_root_of_mass(const Membrane& m, std::span<const Vec3> f,
                              Eigen::Ref<Eigen::VectorXd> w) {
  for (std::size_t n = 0; n < f.size(); ++n)
    w.segment<3>(static_cast<Eigen::Index>(3 * n)) = f[n] / std::sqrt(m.node_mass[n]);
}

} // namespace plyform
