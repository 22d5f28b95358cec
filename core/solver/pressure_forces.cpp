// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures on plies as a kind of force. A pressure p (positive upwards, against the face below)
// does the work p dV with V the volume beneath a ply, of which a triangle of nodes x1, x2, x3, in
// order about its upper side, has x1 . (x2 x x3) / 6. So each of its nodes gets
//
//   f = p / 6 (x2 - x1) x (x3 - x1)                                                    (P)
//
// a third of p times area times normal; of a vacuum between two plies only what contact leaves of
// it there, with a stiffness of its own (core/solver/vacuum_contact.hpp). Its stiffness has blocks
// of p / 6 times the cross product with the sides of the triangle: symmetric within a sheet, not at
// free edges. A sum of absolute values bounds its eigenvalues (Gershgorin): a row of a node has, of
// each triangle, at most
//
//   |p| / 6 (|x2 - x1| + |x3 - x2| + |x1 - x3|)                                        (K)
//
// The product with K has that in the place of the matrix. p is the largest that a programme has, so
// that a quick rise between two updates of the stable step is in it.
//
// Work by the trapezoidal rule, as of all forces: half of a step's motion times the forces at its
// end (last_load_work, when they are computed), half times those at its begin (when it is taken).
#include "base/format.hpp"
#include "core/model/motion.hpp"
#include "core/solver/force_kinds.hpp"

#include <algorithm>

namespace plyform {
namespace {

bool any_on(const Layup& layup, std::size_t ply) {
  return std::any_of(layup.data.loads.begin(), layup.data.loads.end(),
                     [ply](const PressureLoad& load) { return at(load.ply) == ply; });
}

double half_work(const PlyBody& ply) {
  double sum = 0.0;
  for (std::size_t n = 0; n < ply.load.size(); ++n)
    sum += 0.5 * ply.load[n].dot(ply.motion[n]);
  return sum;
}

/// (K) of each node, and what of a vacuum changes as its gap opens, on the node and from the face
/// over it: add(node, N/mm).
template <class Add>
void each_row(const Layup& layup, std::size_t p, const Add& add) {
  const double sixth = largest_pressure_on(layup.data, p) / 6.0;
  const PlyBody& ply = layup.plies[p];
  if (const double opening = 2.0 * ply.vacuum_stiffness; opening > 0.0)
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      add(n, opening *
                 std::max(ply.membrane.node_area[n], ply.area_now.empty() ? 0.0 : ply.area_now[n]));
  for (const Triangle& t : ply.membrane.triangles) {
    const Vec3 &a = ply.x[at(t[0])], &b = ply.x[at(t[1])], &c = ply.x[at(t[2])];
    const double row = sixth * ((b - a).norm() + (c - b).norm() + (a - c).norm());
    for (const int n : t)
      add(at(n), row);
  }
}

} // namespace

double PressureForces::place(const Layup& layup, int task) const {
  return static_cast<double>(task) / static_cast<double>(layup.plies.size());
}

void PressureForces::run(Layup& layup, int task) {
  if (!any_on(layup, at(task))) return;
  PlyBody& ply = layup.plies[at(task)];
  const double pressure = pressure_on(layup.data, at(task), layup.time).value_or(0.0);
  ply.load.assign(ply.x.size(), Vec3::Zero());
  for (const Triangle& t : ply.membrane.triangles) {
    const Vec3 &a = ply.x[at(t[0])], &b = ply.x[at(t[1])], &c = ply.x[at(t[2])];
    const Vec3 sixth = (b - a).cross(c - a) / 6.0; // (P)
    for (const int n : t)
      ply.load[at(n)] +=
          (pressure - (ply.borne_load.empty() ? 0.0 : ply.borne_load[at(n)])) * sixth;
  }
  ply.last_load_work = half_work(ply);
}

void PressureForces::end_step(Layup& layup) {
  for (PlyBody& ply : layup.plies)
    if (!ply.load.empty()) {
      ply.load_work += ply.last_load_work + half_work(ply);
      ply.last_load_work = 0.0;
    }
}

void PressureForces::list_arrays(Layup& layup) {
  for (PlyBody& ply : layup.plies)
    if (!ply.load.empty()) ply.nodal_forces.push_back(&ply.load);
}

void PressureForces::add_energies(const Layup& layup, ThreadPool&, Energies& e) const {
  for (const PlyBody& ply : layup.plies)
    e.external += ply.load_work + ply.last_load_work;
}

void PressureForces::add_rows(const Layup& layup, std::size_t ply,
                              std::span<ContactRow> rows) const {
  if (any_on(layup, ply))
    each_row(layup, ply, [&](std::size_t n, double row) { rows[n].stiffness += row; });
}

PressureProduct::PressureProduct(const PressureForces&, const Layup& layup,
                                 const TangentFactors& factors)
    : on_ply_(layup.plies.size()) {
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    if (layup.plies[p].resting || !any_on(layup, p)) continue;
    on_ply_[p].assign(layup.plies[p].x.size(), 0.0);
    each_row(layup, p,
             [&](std::size_t n, double row) { on_ply_[p][n] += factors.stiffness * row; });
  }
}

void PressureProduct::add_on_ply(std::size_t ply, const PerPly& y, PerPly& f) const {
  for (std::size_t n = 0; n < on_ply_[ply].size(); ++n)
    f[ply][n] += on_ply_[ply][n] * y[ply][n];
}

void PressureForces::describe(const Layup& layup, std::vector<std::string>& lines) const {
  for (const PressureLoad& load : layup.data.loads) {
    const PlyBody& ply = layup.plies[at(load.ply)];
    double area = 0.0;
    for (const double a : ply.membrane.node_area)
      area += a;
    lines.push_back(fmt::format("pressure {} ply {}: {:g} N/mm2{}, {:.3g} N on it as it lies",
                                load.side == PlyFace::above ? "above" : "below", ply.name,
                                load.pressure, load.programme.empty() ? "" : " at most",
                                load.pressure * area));
  }
}

} // namespace plyform
