// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/stable_time_step.hpp"

#include "base/lanczos.hpp"
#include "core/solver/frequencies.hpp"
#include "core/solver/stiffness_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr int lanczos_interval = 1000; // steps; eigenvalue ratios change more slowly than bounds

/// Bounds of one ply: of its elements, with the eigenvalue ratio applied, and of its contacts.
struct PlyBound {
  Frequencies elements, contacts;

  double sum_step() const {
    return Frequencies{elements.omega2 + contacts.omega2, elements.damping + contacts.damping}
        .step();
  }

  /// Stable time step (s) of the sum of both bounds, with the gain applied to the elements and to
  /// the bound of contacts up to `known` (1/s^2), its value when the gain was computed. The
  /// increase of contact stiffness since then counts in full: a single deep contact is as stiff as
  /// its row sum.
  double step_with_gain(double time_step_gain, double known) const {
    const double grown = std::max(contacts.omega2 - known, 0.0);
    return Frequencies{
        (elements.omega2 + contacts.omega2 - grown) / (time_step_gain * time_step_gain) + grown,
        (elements.damping + contacts.damping) / time_step_gain}
        .step();
  }
};

PlyBound bound_of(const Layup& layup, const ContactRows& touching, std::size_t p) {
  const PlyBody& ply = layup.plies[p];
  PlyBound of;
  each_kind_of([&]<class K>() { K::add_bound(ply, of.elements); });
  of.elements.damping += layup.data.solver.mass_damping;
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const ContactRow& row = touching[p][n];
    const double mass = ply.mass[n];
    of.contacts.omega2 = std::max(of.contacts.omega2, row.stiffness / mass);
    of.contacts.damping = std::max(of.contacts.damping, row.damping / mass);
  }
  return of;
}

/// Ratio of the stable time step of the whole scene, by Lanczos' iteration, to `dt` (s).
double time_step_gain_of(const Scene& s, double dt, ThreadPool& pool) {
  StiffnessOperator product(s, dt);
  const double lhs = upper_bound(
      largest_ritz_value([&](const Eigen::VectorXd& v) { return product.apply(v, pool); },
                         product.start(), ritz_steps));
  return lhs <= 4.0 ? std::sqrt(4.0 / lhs) : 4.0 / lhs; // (S) is convex in dt
}

} // namespace

double element_omega2(const PlyBody& ply) {
  Frequencies of;
  each_kind_of([&]<class K>() { K::add_bound(ply, of); });
  return of.omega2;
}

StepBound stable_step(const Layup& layup, const ContactRows& touching) {
  StepBound bound;
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    if (layup.plies[p].resting) continue;
    const PlyBound of = bound_of(layup, touching, p);
    double dt = std::min(of.step_with_gain(layup.time_step_gain, layup.plies[p].lanczos_contacts),
                         of.elements.step());
    if (of.contacts.omega2 > 0.0) dt = std::min(dt, of.contacts.step());
    if (bound.ply < 0 || !(dt >= bound.dt))
      bound = {dt, of.elements.omega2 + of.contacts.omega2, static_cast<int>(p),
               layup.plies[p].bound.triangle};
  }
  return bound;
}

void update_stable_step(Scene& s, ThreadPool& pool) {
  const bool lanczos_due = s.step >= s.next_lanczos;
  pool.run(static_cast<int>(s.plies.size()), [&](int p) {
    PlyBody& ply = s.plies[p];
    const Stopwatch watch(ply.search_seconds);
    ply.bound = eigenvalue_bound(ply.membrane, ply.x);
    if (lanczos_due) ply.eigenvalue_ratio = eigenvalue_ratio(ply.membrane, ply.x);
  });
  if (!lanczos_due) return;
  s.next_lanczos = s.step + lanczos_interval;
  renew_rows(s, s.ply_pairs, pool);
  const ContactRows touching = contact_rows(s, pool);
  double dt = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    if (s.plies[p].resting) continue;
    const PlyBound of = bound_of(s, touching, p);
    s.plies[p].lanczos_contacts = of.contacts.omega2;
    dt = std::min(dt, of.sum_step());
  }
  const double time_step_gain =
      s.time_step_gain * time_step_gain_of(s, s.time_step_gain * dt, pool);
  // the gain is rounded down, so that rounding errors of the iteration have no effect
  constexpr double grain = 1e-3;
  s.time_step_gain = std::max(1.0, grain * std::floor(time_step_gain / grain));
}

} // namespace plyform
