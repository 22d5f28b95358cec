// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet without yarns (core/model/sheet_law.hpp):
//   q_a = A0 sum_b S_ab k_b, in the place of (Q) of core/ply/membrane.hpp                     (q)
#include "core/ply/in_plane_law.hpp"

namespace plyform {
namespace {

SheetResponse response(const Membrane& m, const Vec3& k1, const Vec3& k2) {
  return std::visit([&](const auto& law) { return law.at(k1, k2); }, *m.fabric.sheet);
}

/// (q) of triangles [begin, end); each triangle is a strain group of its own.
GroupReport sheet_forces(const Membrane& m, std::span<const Vec3> x, double, int begin, int end,
                         const LawStates<YarnMemory>&, std::span<ElementForce> q) {
  GroupReport report;
  for (int e = begin; e < end; ++e) {
    const FibreState s = fibre_state(m, x, e);
    const Vec3 k1 = s.lambda1 * s.f1, k2 = s.lambda2 * s.f2;
    const SheetResponse r = response(m, k1, k2);
    q[e] = {m.area[e] * (r.s11 * k1 + r.s12 * k2), m.area[e] * (r.s12 * k1 + r.s22 * k2)};
    report.collapsed |= collapsed(s);
  }
  return report;
}

/// Energy of the sheet; all of it counts as shear.
MembraneEnergy sheet_energy(const Membrane& m, std::span<const Vec3> x, std::span<const YarnMemory>,
                            double) {
  MembraneEnergy sum;
  for (int e = 0; e < m.groups(); ++e) {
    const FibreState s = fibre_state(m, x, e);
    sum.shear += m.area[e] * response(m, s.lambda1 * s.f1, s.lambda2 * s.f2).energy;
  }
  return sum;
}

double stiffness(const Membrane& m, const FibreState& s, const Gram& g) {
  const Vec3 k1 = s.lambda1 * s.f1, k2 = s.lambda2 * s.f2;
  return std::visit([&](const auto& law) { return law.stiffness_bound(k1, k2, g); },
                    *m.fabric.sheet);
}

} // namespace

const InPlaneLaw sheet_in_plane{false, sheet_forces, sheet_energy, stiffness};

} // namespace plyform
