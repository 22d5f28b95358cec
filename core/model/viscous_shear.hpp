// SPDX-License-Identifier: GPL-3.0-or-later
// What a crossing resists by the rate of shear, beside ShearLaw: a dashpot (Voigt and Kelvin), and
// branches of a spring and a dashpot in line (Maxwell). All rates are those of the process.
//
//   gamma  rad    shear angle;  v  1/s  rate of a dashpot;  dt  s  step, of the process
//   D(g,v) N mm   torque of the dashpot, odd in v;  c = D/v  N mm s  its viscosity
//   q      N mm   torque of a branch, G N mm its modulus, theta s its relaxation time
//
//   C = C_e(gamma) + D(gamma, gamma') + sum q,   q' + q/theta = G gamma'                        (V)
//
// Maxwell. For a constant rate within the step (V) is exact with
//   q_1 = e q_0 + G theta (1 - e)/dt (gamma_1 - gamma_0),  e = exp(-dt/theta)                   (X)
// With unit mass and w the motion of a step, central differences w_1 = w_0 - dt^2 q give
// z^2 - (1 + e - a) z + e = 0, a = dt^2 G (1 - e)/s, s = dt/theta: stable for a <= 2 (1 + e), that
// is dt^2 G <= 2 s coth(s/2), and as s coth(s/2) >= 2 always where dt^2 G <= 4. So a branch never
// limits a step further than a spring of its modulus does, whatever its time.
//
// Dashpot. A step of a simulated second is r = process.duration / solver.duration seconds of the
// process: the rate of the process is the simulated one over r, and the dashpot that the explicit
// step sees is c/r. So that the torque is what it is, C_e, of a stroke of T simulated seconds, c/r
// is about C_e T, and the limit dt <= 2 m r / c of damping is shorter than that of yarns, 2 /
// omega, by omega T times the ratio of shear to yarn stiffness: ten times and more. So a dashpot
// never acts on nodes by itself: it has a spring of modulus K in line, as stiff as the step can
// afford (core/ply/viscous_membrane.hpp), which makes it a branch whose time is c/K. It lags by
// that, whatever solver.duration is. By backward Euler, for any D that rises in v:
//   D(gamma, v) + K dt v = q_0 + K (gamma_1 - gamma_0),  q_1 = D(gamma, v)                      (B)
// which has the torque of a steady rate exactly, and e = 1/(1 + s) in the polynomial above: stable
// under the same condition.
//
// Work of a branch in a step, (q_0 + q_1)/2 (gamma_1 - gamma_0), less what its spring stores more
// is what it loses.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace plyform {

/// Torque of the dashpot over the angle at one rate.
struct RateCurve {
  double rate = 0.0;          ///< 1/s, above 0
  std::vector<double> angle;  ///< rad, ascending from 0; the law does not see its sign
  std::vector<double> torque; ///< N mm, at least 0; linear between, constant beyond
  bool operator==(const RateCurve&) const = default;
  double at(double angle) const;
};

struct MaxwellBranch {
  double modulus = 0.0; ///< G, N mm; of yarns N
  double time = 0.0;    ///< theta, s
  bool operator==(const MaxwellBranch&) const = default;
};

struct ViscousShear {
  std::vector<double> c; ///< N mm s, coefficients of 1, g^2, g^4 ...: D = (c0 + c2 g^2 ...) v
  /// In place of c: ascending by rate; linear in the rate from 0 and between, and beyond the last.
  std::vector<RateCurve> curves;
  std::vector<MaxwellBranch> branches;
  std::optional<std::array<double, 2>> measured_rates; ///< 1/s, ascending; of magnitudes

  bool operator==(const ViscousShear&) const = default;
  bool has_dashpot() const { return !c.empty() || !curves.empty(); }
  /// D, N mm; rate: 1/s.
  double torque(double angle, double rate) const;
  /// c (N mm s) at the v that solves (B) for its right side `driven` (N mm) and K dt = `spring_dt`
  /// (N mm s): q_1 = c/(c + K dt) times the right side. factor: of the viscosity, as of a
  /// temperature; 1 at that of the law.
  double viscosity(double angle, double driven, double spring_dt, double factor = 1.0) const;
  /// N mm, at once: sum of G.
  double instant_modulus() const;
  /// 1/s, rates beyond which nothing is known of it; nothing: not said. Of curves their ends.
  std::optional<std::array<double, 2>> known_rates() const;
};

/// (X): the factors e of q_0 and G theta (1 - e)/dt of the motion (N mm). dt: s, above 0.
struct MaxwellStep {
  double keep = 1.0, rise = 0.0;
};
MaxwellStep maxwell_step(const MaxwellBranch& branch, double dt);

} // namespace plyform
