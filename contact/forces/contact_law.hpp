// SPDX-License-Identifier: GPL-3.0-or-later
// The force law of one contact: normal penalty that no force can overcome, with damping, and
// Coulomb friction with true stick.
//
//   h    mm      distance at which bodies touch;  d  mm  distance now;  p = h - d  penetration
//   delta mm     depth at which the force has no limit;  u = p / delta;  q = 1 - u^2
//   A    mm^2    area that the contact stands for
//   k    N/mm^3  penalty stiffness per area, c  N s/mm^3  damping per area
//   k_t  N/mm^3  tangential stiffness per area: k / 2, of the order of what bodies in contact show
//                (2 (1 - nu) / (2 - nu) of the normal one: Mindlin, J. Appl. Mech. 16, 1949), and
//                the couples of friction (ply_ply.hpp) then hardly lower the stable step
//   s    mm      elastic tangential displacement remembered by the contact (its history)
//   mu   -       coefficient of friction
//
//   E = 1/2 A k p^2 / q                                                                     (E)
//   N = max(0, A (k p / q^2 + c dp/dt)), p >= 0: in the step that closes a gap dp is what is
//       penetrated, not the way, so that N has no jump where p = 0                          (N)
//   dN/dp = A k (1 + 3 u^2) / q^3                                                           (K)
//
// (N) is the linear penalty while u is small (1.2 times it at u = 0.3). (E) grows without limit
// before delta is reached: no finite energy drives a contact through, which a penalty of finite
// stiffness only makes rarer. It needs steps in which no contact closes by more than half of the
// room that it has left at its present speed, and that follow (K):
// core/solver/stable_time_step.hpp. Barriers of this kind, there logarithmic: Li et al.,
// Incremental Potential Contact, ACM Trans. Graph. 39(4), 2020; a rational one needs no logarithm,
// and its energy has a pole, not only its force.
//
//   s_trial = rotate(s) + tangential part of the relative motion of this step
//   T = -A k_t s,  |T| <= mu N, s shortened to fit when it slides                             (T)
//
// (T) is the elastic-predictor, return-mapping form of Coulomb's law (Wriggers, Computational
// Contact Mechanics, 2nd ed., section 5.2.4): below the cone the contact sticks and gives its
// displacement back, it does not creep.
#pragma once

#include "contact/geometry.hpp"
#include "contact/simd/contact_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {

struct ContactLaw {
  double stiffness = 0.0;                                     ///< k, N/mm^3
  double damping = 0.0;                                       ///< c, N s/mm^3; normal only
  double friction = 0.0;                                      ///< mu
  double max_depth = std::numeric_limits<double>::infinity(); ///< delta, mm; infinite: linear

  double tangential() const { return 0.5 * stiffness; } ///< k_t, N/mm^3

  /// q at depth p, mm.
  double room(double p) const {
    const double u = p / max_depth;
    return std::max(1.0 - u * u, least_room);
  }
  /// Elastic pressure, N/mm^2, at depth p > 0, mm.
  double pressure(double p) const {
    const double q = room(p);
    return stiffness * p / (q * q);
  }
  /// Slope of the pressure, N/mm^3: (K). Bodies apart (p <= 0) count as just touching.
  double tangent(double p) const {
    const double u = std::max(p, 0.0) / max_depth, q = room(std::max(p, 0.0));
    return stiffness * (1.0 + 3.0 * u * u) / (q * q * q);
  }
  /// Elastic energy per area, N/mm, at depth p > 0, mm.
  double energy(double p) const { return 0.5 * stiffness * p * p / room(p); }
};

/// Sums over contacts since the last reset or, for the energies, at present. N mm, N, mm.
struct ContactTotals {
  double elastic = 0.0;     ///< energy stored now in normal and tangential springs
  double friction = 0.0;    ///< work turned to heat by sliding, since the start
  double damping = 0.0;     ///< work of normal damping, since the start
  double penetration = 0.0; ///< deepest now, mm
  double deepest = 0.0;     ///< deepest since the start, mm
  double slip = 0.0;        ///< longest way slid by one contact while it lasted, mm
  int touching = 0;         ///< contacts that carry force now
  /// By how much the next step may be longer than the last one, for no contact to close by more
  /// than half of the room that it has left.
  double step_ratio = std::numeric_limits<double>::infinity();
};

/// Nothing touches, before the contacts of a step are gone through.
inline void clear_present(ContactTotals& sums) {
  sums.elastic = sums.penetration = 0.0;
  sums.touching = 0;
  sums.step_ratio = std::numeric_limits<double>::infinity();
}

/// A row of the contact matrices in absolute values, or what a contact adds to it per area.
struct ContactRow {
  double stiffness = 0.0; ///< N/mm
  double damping = 0.0;   ///< N s/mm
  ContactRow& operator+=(const ContactRow& b) {
    stiffness += b.stiffness;
    damping += b.damping;
    return *this;
  }
};
inline ContactRow operator*(double by, const ContactRow& row) {
  return {by * row.stiffness, by * row.damping};
}

/// ContactTotals::step_ratio of one contact at depth p (mm, below 0: open) that closed by dp (mm)
/// in the last step. While it is open it may close, and then use half of the whole depth.
inline double step_ratio(const ContactLaw& law, double p, double dp) {
  if (!(dp > 0.0)) return std::numeric_limits<double>::infinity();
  const double inside = std::max(p, 0.0);
  return std::max((inside - p) + 0.5 * (law.max_depth - inside), 0.0) / dp;
}

/// By how much of its room a contact may get deeper before the stable step is renewed.
constexpr double deepening = 0.03;

/// mm: depth for which the stable step must do when a contact is `depth` mm deep now.
inline double depth_ahead(const ContactLaw& law, double depth) {
  if (std::isinf(law.max_depth)) return depth;
  const double inside = std::max(depth, 0.0);
  return inside + deepening * (law.max_depth - inside);
}

/// Tangent and damping per area of a contact `depth` mm deep, as far as it may get until the stable
/// step is renewed.
inline ContactRow row_of(const ContactLaw& law, double depth) {
  return {law.tangent(depth_ahead(law, depth)), law.damping};
}

/// s of (T) as a vector of Eigen, which the memory itself must not know.
inline Eigen::Map<Vec3> s_of(ContactHistory& memory) {
  return Eigen::Map<Vec3>(memory.s);
}
inline Eigen::Map<const Vec3> s_of(const ContactHistory& memory) {
  return Eigen::Map<const Vec3>(memory.s);
}

/// Normal force (N) and its share that is damping; p > 0. dp: change of p in this step, mm.
struct NormalForce {
  double total, damping;
};
inline NormalForce normal_force(const ContactLaw& law, double area, double p, double dp,
                                double dt) {
  const double elastic = area * law.pressure(p);
  double viscous = dt > 0.0 ? area * law.damping * dp / dt : 0.0;
  viscous = std::max(viscous, -elastic); // no adhesion
  return {elastic + viscous, viscous};
}

/// (T): updates memory.s and returns the tangential force on the body whose motion relative to the
/// other one, this step, is `motion` (mm). n: unit normal. Adds the heat of sliding to sums.
inline Vec3 friction_force(const ContactLaw& law, double area, double n_force, const Vec3& n,
                           const Vec3& motion, ContactHistory& memory, ContactTotals& sums) {
  if (law.friction == 0.0) return Vec3::Zero();
  const double k = area * law.tangential();
  Eigen::Map<Vec3> s = s_of(memory);
  Vec3 old = s;
  const double length = old.norm();
  if (length > 0.0) { // turn the history into the present tangent plane, its length kept
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

/// Energy (N mm) that the springs of a contact hold, p mm deep.
inline double tangent_energy(const ContactLaw& law, double area, double p,
                             const ContactHistory& memory) {
  return area * (law.energy(p) + 0.5 * law.tangential() * s_of(memory).squaredNorm());
}

/// The contact has opened: what its spring still holds is given up as heat.
inline void release(const ContactLaw& law, double area, ContactHistory& memory,
                    ContactTotals& sums) {
  if (memory.normal_force == 0.0 && s_of(memory).isZero(0.0)) return;
  sums.friction += 0.5 * area * law.tangential() * s_of(memory).squaredNorm();
  memory = {};
}

} // namespace plyform
