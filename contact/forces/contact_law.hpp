// SPDX-License-Identifier: GPL-3.0-or-later
// The force law of one contact: a barrier penalty in the normal direction, which no finite force
// overcomes, with viscous damping, and Coulomb friction with elastic stick.
//
//   h    mm      distance at which bodies touch;  d  mm  distance now;  p = h - d  penetration
//   delta mm     depth at which the force becomes infinite;  u = p / delta;  q = 1 - u^2
//   A    mm^2    tributary area of the contact
//   k    N/mm^3  penalty stiffness per area, c  N s/mm^3  damping per area
//   k_t  N/mm^3  tangential stiffness per area: k / 2, of the order of what bodies in contact show
//                (2 (1 - nu) / (2 - nu) of the normal one: Mindlin, J. Appl. Mech. 16, 1949), and
//                the couples of friction (ply_ply.hpp) then hardly lower the stable step
//   s    mm      elastic tangential displacement (history variable of the contact)
//   mu   -       coefficient of friction
//
//   E = 1/2 A k p^2 / q                                                                     (E)
//   N = max(0, A (k p / q^2 + c dp/dt)), p >= 0; in the step that closes a gap dp is the depth
//       reached, without the gap closed before, so that N has no jump at p = 0              (N)
//   dN/dp = A k (1 + 3 u^2) / q^3                                                           (K)
//
// (N) approximates the linear penalty while u is small (1.2 times it at u = 0.3). (E) has a pole at
// p = delta: no finite energy drives a contact through, whereas a penalty of finite stiffness only
// makes that rarer. In return the time step must be such that no contact, at its present closing
// speed, uses more of its remaining depth delta - p in a step than makes (K) 2.4 times as large
// (step_share), and it must be stable for the stiffness (K): core/solver/stable_time_step.hpp.
// Logarithmic barriers of this kind: Li et al., Incremental Potential Contact, ACM Trans. Graph.
// 39(4), 2020; the rational one needs no logarithm, and not only its force but also its energy has
// a pole.
//
//   s_trial = rotate(s) + tangential part of the relative motion of this step
//   T = -A k_t s,  |T| <= mu N, s shortened to fit when it slides                             (T)
//
// Other bounds than mu N, of films and by the speed, the angle of fibres or the way slid:
// contact/forces/friction_law.hpp.
//
// A ply is as thick as its cloth. r is the present thickness over that before forming: of a ply its
// A0 / A, as its volume stays (core/ply/thickness.hpp), of two plies the mean that has their
// distance h r. The law acts on distances over r, and its energy is that of an area before forming:
//
//   E = A e(p),  p = h - d / r;  N = A e'(p) / r                                            (R)
//
// so that the area on which e' presses, A / r, is the present one where r is A0 / A. E has the
// derivative N d / r by r, which the plies feel in their plane (core/solver/thickness_forces.cpp).
//
// Cloth that gives way through its thickness bears the pressure of a curve p_c up to its densest
// packing p_1; (E) to (K) then hold for what goes beyond, p - p_1, and are added to the curve,
// which goes on with its last slope. Unloaded, it follows a curve of its own, p_u, shifted to where
// loading has ended (p_m, the greatest depth so far) and back from there; it keeps a set:
//
//   p >= p_m:  e' = p_c(p);   p < p_m:  e' = p_u(p - p_m + p_u^-1(p_c(p_m)))                (C)
//
// (T) is the elastic-predictor, return-mapping form of Coulomb's law (Wriggers, Computational
// Contact Mechanics, 2nd ed., section 5.2.4): inside the friction cone the contact sticks, its
// tangential displacement is elastic and recovered on unloading, and it does not creep.
#pragma once

#include "base/geometry.hpp"
#include "contact/forces/compaction_curve.hpp"
#include "contact/forces/friction_law.hpp"
#include "contact/simd/contact_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plyform {

struct ContactLaw {
  double stiffness = 0.0;                                     ///< k, N/mm^3
  double damping = 0.0;                                       ///< c, N s/mm^3; normal only
  double friction = 0.0;                                      ///< mu
  double max_depth = std::numeric_limits<double>::infinity(); ///< delta, mm; infinite: linear
  CompactionCurvePtr loading = {},
                     unloading = {}; ///< null: none; only loading: goes back as it came
  /// What its force in the plane of plies, whose thickness it presses, adds to the bound of (K),
  /// over it.
  double thickness_coupling = 0.0;
  FrictionLawPtr sliding = {}; ///< instead of `friction`; null: Coulomb's law
  double process_time = 1.0;   ///< s of the process in each simulated second
  double share = 1.0;  ///< of the area on which `sliding` acts: half of it in each of two passes
  double memory = 0.0; ///< s of the process, T of `sliding`
  /// mm, gap up to which faces slide on each other: which a film fills, or a vacuum holds; 0: only
  /// what touches slides
  double sliding_gap = 0.0;

  bool rubs() const { return sliding || friction > 0.0; } ///< whether it has friction at all
  /// Whether its friction goes by the speed.
  bool has_film() const { return sliding && sliding->has_rates(); }
  /// Whether its friction keeps something of each place.
  bool keeps() const { return sliding && sliding->keeps(); }
  /// Whether it asks for the temperatures of both bodies.
  bool by_temperature() const { return sliding && sliding->spec().flow.factor; }

  /// p_1, mm.
  double packed() const { return loading ? loading->packed() : 0.0; }
  /// Depth (mm) that no force reaches.
  double depth_limit() const { return packed() + max_depth; }
  double tangential() const { return 0.5 * stiffness; } ///< k_t, N/mm^3

  /// q at depth p, mm.
  double remaining(double p) const {
    const double u = p / max_depth;
    return std::max(1.0 - u * u, least_remaining);
  }
  /// Elastic pressure, N/mm^2, at depth p > 0, mm, of a contact that was `compacted` (mm) deep.
  double pressure(double p, double compacted = 0.0) const {
    if (!loading) return barrier(p);
    const double beyond = std::max(p - packed(), 0.0), inside = std::min(p, packed());
    const double below = beyond > 0.0 ? barrier(beyond) + beyond * loading->last_slope() : 0.0;
    return below + curve_pressure(inside, std::max(compacted, inside));
  }
  /// Slope of the pressure, N/mm^3, (K), the largest up to this depth. Bodies apart (p <= 0) count
  /// as just touching.
  double tangent(double p) const {
    const double beyond = std::max(p - packed(), 0.0);
    const double u = beyond / max_depth, q = remaining(beyond);
    const double tangent = stiffness * (1.0 + 3.0 * u * u) / (q * q * q);
    if (!loading) return tangent;
    const double inside = std::clamp(p, 0.0, packed());
    double steepest = loading->steepest(inside);
    if (unloading)
      steepest =
          std::max(steepest, unloading->steepest(unloading->depth_at(loading->pressure(inside))));
    return beyond > 0.0 ? steepest + tangent : steepest;
  }
  /// Elastic energy per area, N/mm, at depth p > 0, mm, of a law without a curve.
  double energy(double p) const { return 0.5 * stiffness * p * p / remaining(p); }

private:
  double barrier(double p) const {
    const double q = remaining(p);
    return stiffness * p / (q * q);
  }
  /// (C).
  double curve_pressure(double p, double compacted) const {
    if (!unloading) return p > 0.0 ? loading->pressure(p) : 0.0;
    const double from = unloading->depth_at(loading->pressure(compacted));
    const double now = from - (compacted - p);
    return now > 0.0 ? unloading->pressure(now) : 0.0;
  }
};

/// The law for kernels, without the greatest depths so far. dt: s, 0 for no damping.
inline ContactKernelLaw kernel_law(const ContactLaw& law, double dt) {
  ContactKernelLaw k{};
  k.stiffness = law.stiffness, k.tangential = law.tangential(), k.friction = law.friction;
  k.max_depth = law.max_depth, k.per_depth2 = 1.0 / (law.max_depth * law.max_depth);
  k.damping_per_dt = dt > 0.0 ? law.damping / dt : 0.0;
  k.depth_limit = law.depth_limit();
  k.sliding_gap = law.sliding_gap;
  if (law.loading) k.loading = law.loading->table();
  if (law.unloading) k.unloading = law.unloading->table();
  return k;
}

/// A law of friction with the step that it is asked for, as kernels call it, and what it has seen.
struct SlidingCall {
  const FrictionLaw& law;
  double per_dt; ///< 1/s, inverse of the time that the step takes in the process; 0: none
  double share;  ///< of ContactLaw
  double memory; ///< s of the process, likewise
  SlidingSeen seen{};

  SlidingCall(const ContactLaw& contact, double dt)
      : law(*contact.sliding), per_dt(dt > 0.0 ? 1.0 / (dt * contact.process_time) : 0.0),
        share(contact.share), memory(contact.memory) {}
  static double stuck(void* call, const SlidingPlace& place) {
    auto& c = *static_cast<SlidingCall*>(call);
    SlidingPlace whole = place;
    whole.stiffness /= c.share, whole.pressure /= c.share, whole.area *= c.share;
    const double viscosity = c.law.spec().flow_at(place.celsius);
    if (whole.kept) c.law.begin(whole, c.per_dt);
    const double left = c.law.stuck(whole, c.per_dt, viscosity);
    const double y = whole.stretch - left;
    c.law.note(whole, y, c.per_dt, viscosity, c.seen);
    if (whole.kept) c.law.follow(whole, y, c.per_dt, c.memory);
    return left;
  }
};

/// Lets a kernel ask the law of friction, if there is one beyond Coulomb's.
inline void ask(ContactKernelLaw& kernel, std::optional<SlidingCall>& call) {
  if (!call) return;
  kernel.friction = 1.0;
  kernel.stuck = SlidingCall::stuck, kernel.sliding = &*call;
  kernel.keeps = call->law.keeps();
}

/// Sums, maxima and minima over the points of one contact.
struct ContactTotals {
  double elastic = 0.0;     ///< N mm, energy stored now in normal and tangential springs
  double friction = 0.0;    ///< N mm, work dissipated by sliding, since the start
  double damping = 0.0;     ///< N mm, work of normal damping, since the start
  double compaction = 0.0;  ///< N mm, lost through the thickness: not given back on unloading
  double vacuum = 0.0;      ///< N mm, work of a vacuum that holds both sides on each other
  double penetration = 0.0; ///< deepest now, mm
  double deepest = 0.0;     ///< deepest since the start, mm
  double slip = 0.0;        ///< largest sliding distance of one contact while it was closed, mm
  SlidingSeen sliding{};    ///< where in the range of its law of friction it was
  int touching = 0;         ///< number of closed contacts
  /// Largest ratio of the next time step to the last one with which, at its present closing speed,
  /// no contact uses more than its share (step_share) of its remaining depth.
  double step_ratio = std::numeric_limits<double>::infinity();
};

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(ContactTotals& sums, F&& f) {
  auto& [elastic, friction, damping, compaction, vacuum, penetration, deepest, slip, sliding,
         touching, step_ratio] = sums;
  f("elastic", elastic);
  f("friction", friction);
  f("damping", damping);
  f("compaction", compaction);
  f("vacuum", vacuum);
  f("penetration", penetration);
  f("deepest", deepest);
  f("slip", slip);
  f("sliding", sliding);
  f("touching", touching);
  f("step_ratio", step_ratio);
}

/// Resets the sums that describe the present state, at the begin of the force loop of a step.
inline void clear_present(ContactTotals& sums) {
  sums.elastic = sums.penetration = 0.0;
  sums.touching = 0;
  sums.step_ratio = std::numeric_limits<double>::infinity();
}

/// Sum of absolute values of a node's row in the contact stiffness and damping matrices (a bound of
/// their eigenvalues: Gershgorin). row_of gives it per area, then in N/mm^3 and N s/mm^3.
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

/// How far (mm) a contact at depth p (mm, below 0: open) may close in a step: an open one may close
/// its gap and then use its share of the depth. 0 beyond the depth limit.
inline double room_in_a_step(const ContactLaw& law, double p) {
  const double limit = law.depth_limit();
  const double inside = std::max(p, 0.0), left = std::max(1.0 - inside / limit, 0.0);
  const double share = step_share + shallow_share * (left * left * (left * left) * left);
  return std::max((inside - p) + share * (limit - inside), 0.0);
}

/// ContactTotals::step_ratio of one contact at depth p (mm, below 0: open) that closed by dp (mm)
/// in the last step. Infinite if the contact does not close.
inline double step_ratio(const ContactLaw& law, double p, double dp) {
  return dp > 0.0 ? room_in_a_step(law, p) / dp : std::numeric_limits<double>::infinity();
}

/// Fraction of its remaining depth by which a contact may deepen before the stable time step is
/// computed again.
constexpr double deepening = 0.03;

/// Depth (mm) for which the stable time step is computed if a contact is `depth` mm deep now.
inline double depth_ahead(const ContactLaw& law, double depth) {
  if (std::isinf(law.max_depth)) return depth;
  const double inside = std::max(depth, 0.0);
  return inside + deepening * (law.depth_limit() - inside);
}

/// Tangent stiffness (K), N/mm^3, and damping, N s/mm^3, of a contact whose gap is `gap` mm now,
/// taken at the depth that it may reach until the stable time step is computed again. thickness: r.
inline ContactRow row_of(const ContactLaw& law, double gap, double thickness) {
  const double per = 1.0 / thickness, per2 = (1.0 + law.thickness_coupling) * per * per;
  return {per2 * law.tangent(depth_ahead(law, -gap * per)), per2 * law.damping};
}

/// s of (T), mm, as an Eigen vector; ContactHistory itself must not depend on Eigen.
inline Eigen::Map<Vec3> s_of(ContactHistory& memory) {
  return Eigen::Map<Vec3>(memory.s);
}
inline Eigen::Map<const Vec3> s_of(const ContactHistory& memory) {
  return Eigen::Map<const Vec3>(memory.s);
}

/// Normal force and the part of it that is damping, N.
struct NormalForce {
  double total, damping;
};
/// (N) at depth p > 0 (mm). area: mm^2; dp: change of p in this step, mm; dt: s, 0 for no damping.
inline NormalForce normal_force(const ContactLaw& law, double area, double p, double dp,
                                double dt) {
  const double elastic = area * law.pressure(p);
  double viscous = dt > 0.0 ? area * law.damping * dp / dt : 0.0;
  viscous = std::max(viscous, -elastic); // no adhesion
  return {elastic + viscous, viscous};
}

/// Ends a contact that has opened: counts the energy left in its tangential spring as frictional
/// dissipation and resets its history. area: mm^2.
inline void release(const ContactLaw& law, double area, ContactHistory& memory,
                    ContactTotals& sums) {
  if (memory.normal_force == 0.0 && s_of(memory).isZero(0.0)) return;
  sums.friction += 0.5 * area * law.tangential() * s_of(memory).squaredNorm();
  memory = {};
}

} // namespace plyform
