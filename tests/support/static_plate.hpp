// SPDX-License-Identifier: GPL-3.0-or-later
// Plates at rest with small deflections: the stencils of a flat ply, put together into one matrix
// and solved, so that closed forms of plates can be asked of many meshes in no time.
#pragma once

#include "core/ply/bending.hpp"

#include <Eigen/SparseCholesky>
#include <numbers>

namespace plyform {

/// A flat ply that bends.
struct StaticPlate {
  BlankMesh mesh;
  Bending bending;
  Eigen::SparseMatrix<double> stiffness; ///< N/mm, of deflections
};

inline StaticPlate make_plate(const BlankMesh& mesh, const BendingLaw& law, double warp) {
  StaticPlate p{mesh, {}, {}};
  p.bending = make_bending(mesh.x, mesh.triangles, law, warp, warp + 0.5 * std::numbers::pi,
                           std::vector<double>(mesh.x.size(), 1e-8));
  const Bending& b = p.bending;
  Eigen::Matrix3d d;
  d << law.families[0].law.stiffness, law.coupling, 0.0, law.coupling,
      law.families[1].law.stiffness, 0.0, 0.0, 0.0, law.twist;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t n = 0; n < mesh.x.size(); ++n)
    for (std::int32_t i = b.begin[n]; i < b.begin[n + 1]; ++i)
      for (std::int32_t j = b.begin[n]; j < b.begin[n + 1]; ++j)
        entries.emplace_back(b.node[i], b.node[j],
                             b.area[n] *
                                 Eigen::Map<const Eigen::Vector3d>(b.b[i].data())
                                     .dot(d * Eigen::Map<const Eigen::Vector3d>(b.b[j].data())));
  const auto size = static_cast<Eigen::Index>(mesh.x.size());
  p.stiffness.resize(size, size);
  p.stiffness.setFromTriplets(entries.begin(), entries.end());
  return p;
}

/// Deflections, mm, under forces (N) on the nodes, with those that are `held` (not NaN) as they
/// are.
inline Eigen::VectorXd deflect(const StaticPlate& p, const Eigen::VectorXd& force,
                               const Eigen::VectorXd& held) {
  std::vector<Eigen::Index> number(p.mesh.x.size(), -1);
  Eigen::Index count = 0;
  for (std::size_t n = 0; n < number.size(); ++n)
    if (std::isnan(held[static_cast<Eigen::Index>(n)])) number[n] = count++;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right(count);
  for (std::size_t n = 0; n < number.size(); ++n)
    if (number[n] >= 0) right[number[n]] = force[static_cast<Eigen::Index>(n)];
  for (Eigen::Index c = 0; c < p.stiffness.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(p.stiffness, c); it; ++it) {
      const Eigen::Index row = number[static_cast<std::size_t>(it.row())];
      const Eigen::Index column = number[static_cast<std::size_t>(c)];
      if (row < 0) continue;
      if (column < 0)
        right[row] -= it.value() * held[c];
      else
        entries.emplace_back(row, column, it.value());
    }
  Eigen::SparseMatrix<double> free(count, count);
  free.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd found =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(free).solve(right);
  Eigen::VectorXd w = held;
  for (std::size_t n = 0; n < number.size(); ++n)
    if (number[n] >= 0) w[static_cast<Eigen::Index>(n)] = found[number[n]];
  return w;
}

} // namespace plyform
