// SPDX-License-Identifier: GPL-3.0-or-later
// The force law of one contact: normal penalty with damping, Coulomb friction with true stick.
//
//   h    mm      distance at which bodies touch;  d  mm  distance now;  p = h - d  penetration
//   A    mm^2    area that the contact stands for
//   k    N/mm^3  penalty stiffness per area, c  N s/mm^3  damping per area
//   k_t  N/mm^3  tangential stiffness per area: k / 2, of the order of what bodies in contact show
//                (2 (1 - nu) / (2 - nu) of the normal one: Mindlin, J. Appl. Mech. 16, 1949), and
//                the couples of friction (sheet_contact.hpp) then hardly lower the stable step
//   s    mm      elastic tangential displacement remembered by the contact (its history)
//   mu   -       coefficient of friction
//
//   N = max(0, A (k p + c dp/dt)), p >= 0: in the step that closes a gap dp is what is
//       penetrated, not the way, so that N has no jump where p = 0                          (N)
//   s_trial = rotate(s) + tangential part of the relative motion of this step
//   T = -A k_t s,  |T| <= mu N, s shortened to fit when it slides                             (T)
//
// (T) is the elastic-predictor, return-mapping form of Coulomb's law (Wriggers, Computational
// Contact Mechanics, 2nd ed., section 5.2.4): below the cone the contact sticks and gives its
// displacement back, it does not creep.
#pragma once

#include "contact/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

struct ContactLaw {
  double stiffness = 0.0; ///< k, N/mm^3
  double damping = 0.0;   ///< c, N s/mm^3; normal only
  double friction = 0.0;  ///< mu

  double tangential() const { return 0.5 * stiffness; } ///< k_t, N/mm^3
};

/// Sums over contacts since the last reset or, for the energies, at present. N mm, N, mm.
struct ContactSums {
  double elastic = 0.0;     ///< energy stored now in normal and tangential springs
  double friction = 0.0;    ///< work turned to heat by sliding, since the start
  double damping = 0.0;     ///< work of normal damping, since the start
  double penetration = 0.0; ///< deepest now, mm
  double deepest = 0.0;     ///< deepest since the start, mm
  double slip = 0.0;        ///< longest way slid by one contact while it lasted, mm
  int touching = 0;         ///< contacts that carry force now
};

/// What one contact remembers from step to step.
struct ContactMemory {
  Vec3 s = Vec3::Zero();    ///< mm
  double damping_force = 0; ///< N, of the last step, for the trapezoidal work sum
  double normal_force = 0;  ///< N
  double slip = 0;          ///< mm, way slid since it touched
};

/// Normal force (N) and its share that is damping; p > 0. dp: change of p in this step, mm.
struct NormalForce {
  double total, damping;
};
inline NormalForce normal_force(const ContactLaw& law, double area, double p, double dp,
                                double dt) {
  const double elastic = area * law.stiffness * p;
  double viscous = dt > 0.0 ? area * law.damping * dp / dt : 0.0;
  viscous = std::max(viscous, -elastic); // no adhesion
  return {elastic + viscous, viscous};
}

/// (T): updates memory.s and returns the tangential force on the body whose motion relative to the
/// other one, this step, is `motion` (mm). n: unit normal. Adds the heat of sliding to sums.
inline Vec3 friction_force(const ContactLaw& law, double area, double n_force, const Vec3& n,
                           const Vec3& motion, ContactMemory& memory, ContactSums& sums) {
  if (law.friction == 0.0) return Vec3::Zero();
  const double k = area * law.tangential();
  Vec3 old = memory.s;
  const double length = old.norm();
  if (length > 0.0) { // turn the history into the present tangent plane, its length kept
    old -= n.dot(old) * n;
    const double flat = old.norm();
    old = flat > 0.0 ? Vec3(old * (length / flat)) : Vec3(Vec3::Zero());
  }
  const Vec3 trial = old + motion - n.dot(motion) * n;
  const double limit = law.friction * n_force / k;
  const double stretch = trial.norm();
  memory.s = stretch > limit ? Vec3(trial * (limit / stretch)) : trial;
  memory.slip += std::max(stretch - limit, 0.0);
  sums.slip = std::max(sums.slip, memory.slip);
  sums.friction += 0.5 * k * (old + memory.s).dot(trial - memory.s);
  return -k * memory.s;
}

/// Energy (N mm) that the springs of a contact hold, p mm deep.
inline double spring_energy(const ContactLaw& law, double area, double p,
                            const ContactMemory& memory) {
  return 0.5 * area * (law.stiffness * p * p + law.tangential() * memory.s.squaredNorm());
}

/// The contact has opened: what its spring still holds is given up as heat.
inline void release(const ContactLaw& law, double area, ContactMemory& memory, ContactSums& sums) {
  if (memory.normal_force == 0.0 && memory.s.isZero(0.0)) return;
  sums.friction += 0.5 * area * law.tangential() * memory.s.squaredNorm();
  memory = {};
}

} // namespace plyform
