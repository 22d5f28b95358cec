// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the law of one contact (contact/forces/contact_law.hpp) as they are written there, which
// kernels compute several at a time.
#pragma once

#include "contact/forces/contact_law.hpp"

namespace plyform {

/// (T): updates memory.s and memory.slip and returns the tangential force (N) on the body whose
/// displacement relative to the other one in this step is `motion` (mm). area: mm^2; n_force: N; n:
/// unit normal. Adds the work dissipated by sliding to sums.friction.
inline Vec3 friction_force(const ContactLaw& law, double area, double n_force, const Vec3& n,
                           const Vec3& motion, ContactHistory& memory, ContactTotals& sums) {
  if (law.friction == 0.0) return Vec3::Zero();
  const double k = area * law.tangential();
  Eigen::Map<Vec3> s = s_of(memory);
  Vec3 old = s;
  const double length = old.norm();
  if (length > 0.0) { // rotates s into the present tangent plane, with its length preserved
    old -= n.dot(old) * n;
    const double flat = old.norm();
    old = flat > 0.0 ? Vec3(old * (length / flat)) : Vec3(Vec3::Zero());
  }
  const Vec3 trial = old + motion - n.dot(motion) * n;
  const double limit = law.friction * n_force / k;
  const double stretch = trial.norm();
  s = stretch > limit ? Vec3(trial * (limit / stretch)) : trial;
  memory.slip += std::max(stretch - limit, 0.0);
  sums.slip = std::max(sums.slip, memory.slip);
  sums.friction += 0.5 * k * (old + s).dot(trial - s);
  return -k * s;
}

/// Elastic energy (N mm) of the normal and tangential springs of a contact at depth p > 0 (mm) with
/// area mm^2: (E) + 1/2 A k_t s.s.
inline double tangent_energy(const ContactLaw& law, double area, double p,
                             const ContactHistory& memory) {
  return area * (law.energy(p) + 0.5 * law.tangential() * s_of(memory).squaredNorm());
}

} // namespace plyform
