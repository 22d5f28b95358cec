// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of a yarn at a point, with what they remember. A law reads the state of the begin of a step
// and writes that of its end, so that evaluating it twice is harmless: the step is taken when the
// states are exchanged (move_plies of core/solver/step.hpp). What it stores and what it loses come
// out of the evaluation, so that the balance of energy holds for laws with a history, too.
#pragma once

#include "core/model/fabric.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <variant>

namespace plyform {

/// What a law is asked at the end of a step. How fast the strain has changed follows from the
/// strain that the law remembers and one of two clocks. Rates of a material, and all else that
/// takes time in it, go by the process: what they do must not change with solver.duration, which
/// says how fast the process is simulated and costs accuracy by inertia alone. What is there for
/// the sake of the simulation, as damping of its vibrations, goes by simulated time.
struct LawInput {
  double strain = 0.0;
  double per_dt = 0.0; ///< 1/s, inverse of the simulated step that led to it; 0: at the start
  /// 1/s, inverse of the time that this step takes in the process; 0 at the start
  double per_process_dt = 0.0;
  /// Of a yarn in a crimped cell what the cell gives it, N and N mm/mm: core/model/crimp.hpp.
  LawPoint cell{};
};

/// What it answers, per yarn.
struct LawAnswer {
  double value = 0.0;   ///< N, tension
  double slope = 0.0;   ///< N, its derivative by strain
  double damping = 0.0; ///< N s, its derivative by the rate of strain
  double stored = 0.0;  ///< N mm per mm, elastic energy at the end of the step
  double lost = 0.0;    ///< N mm per mm, dissipated in the step
};

/// The largest slope (N) and damping (N s), on which the stable step relies.
struct LawBound {
  double slope = 0.0, damping = 0.0;
};

/// now, next: `states` numbers each, of the begin and the end of the step; they may be the same.
/// has_rates: whether it uses per_process_dt, so that a case needs process.duration.
template <class L>
concept YarnLaw = requires(const L law, const LawInput& in, const double* now, double* next) {
  { L::states } -> std::convertible_to<int>;
  { L::has_rates } -> std::convertible_to<bool>;
  L::start(next); // what it remembers at the start
  { law.at(in, now, next) } -> std::same_as<LawAnswer>;
  { law.bound() } -> std::same_as<LawBound>;
};

/// Adds the viscous tension of a yarn (eta, N s) that is taut to its elastic point. States:
/// stretch, and viscous tension (N), whose work follows from both by the trapezoidal rule.
inline LawAnswer with_viscosity(const LawPoint& point, double viscosity, const LawInput& in,
                                const double* now, double* next) {
  const double stretch = 1.0 + in.strain, change = stretch - now[0];
  const double damping = point.value > 0.0 ? viscosity : 0.0;
  const double viscous = damping * change * in.per_dt;
  const double lost = 0.5 * (viscous + now[1]) * change;
  next[0] = stretch, next[1] = viscous;
  return {point.value + viscous, point.slope, damping, point.energy, lost};
}

/// An elastic yarn that is viscous while it is taut: N = W' + eta d(eps)/dt. The viscosity is
/// solver.fibre_damping, a fraction of critical of the stiffest mode of the mesh: it is there to
/// damp vibrations of the simulation, no property of cloth, and sees simulated time.
struct ViscousYarn {
  static constexpr int states = 2;
  static constexpr bool has_rates = false;
  const TensionLaw& elastic;
  double viscosity = 0.0; ///< eta, N s

  static void start(double* state) { state[0] = 1.0, state[1] = 0.0; }
  LawAnswer at(const LawInput& in, const double* now, double* next) const {
    return with_viscosity(elastic.at(in.strain), viscosity, in, now, next);
  }
  LawBound bound() const { return {elastic.largest_slope(), viscosity}; }
};

/// A yarn of a crimped cell, which has its tension from the cell; its compression is its own.
/// Viscous while it is taut, with the states of ViscousYarn.
struct CrimpedYarn {
  static constexpr int states = ViscousYarn::states;
  static constexpr bool has_rates = false;
  const TensionLaw& elastic;
  double viscosity = 0.0; ///< eta, N s

  static void start(double* state) { ViscousYarn::start(state); }
  LawAnswer at(const LawInput& in, const double* now, double* next) const {
    LawPoint point = in.cell;
    if (in.strain < 0.0) {
      const LawPoint pressed = elastic.at(in.strain);
      point = {point.value + pressed.value, point.slope + pressed.slope,
               point.energy + pressed.energy};
    }
    return with_viscosity(point, viscosity, in, now, next);
  }
  /// dN/deps at most: yarns are straighter than they are long, and may be pressed beside.
  LawBound bound() const { return {elastic.largest_slope() + elastic.compression, viscosity}; }
};

/// A stitch: elastic, and gone for good once it has pulled harder than it can at the end of a step.
/// It then pulls no more at that end, so that it has done half the work of the step (by the
/// trapezoidal rule) that it would have done whole: what it had stored at the begin, and that half,
/// are lost. States: 1 once it is broken, else 0; and, of one that can break, its stretch. It has
/// no viscosity: solver.fibre_damping damps the stiffest modes of the mesh, those of yarns, and
/// stitches are as soft as shear, which it leaves alone.
struct StitchYarn {
  static constexpr int states = 2;
  static constexpr bool has_rates = false;
  const StitchLaw& elastic;

  static void start(double* state) { state[0] = 0.0, state[1] = 1.0; }
  LawAnswer at(const LawInput& in, const double* now, double* next) const {
    const double before = now[1];
    next[0] = now[0], next[1] = before;
    if (next[0] > 0.0) return {};
    const LawPoint point = elastic.at(in.strain);
    if (std::isfinite(elastic.breaking_force)) next[1] = 1.0 + in.strain;
    if (point.value > elastic.breaking_force) {
      next[0] = 1.0;
      const LawPoint was = elastic.at(before - 1.0);
      return {0.0, 0.0, 0.0, 0.0, was.energy + 0.5 * was.value * (next[1] - before)};
    }
    return {point.value, point.slope, 0.0, point.energy, 0.0};
  }
  LawBound bound() const { return {elastic.tension.largest_slope(), 0.0}; }
};

/// The laws that a yarn or a stitch can have.
using AnyYarnLaw = std::variant<ViscousYarn, CrimpedYarn, StitchYarn>;

/// Numbers that are kept for a yarn, and what they are at the start.
template <class Any>
struct StatesOf;
template <YarnLaw... Laws>
struct StatesOf<std::variant<Laws...>> {
  static constexpr int most = std::max({Laws::states...});
};
constexpr int yarn_states = StatesOf<AnyYarnLaw>::most;

inline void start_state(const AnyYarnLaw& any, double* state) {
  std::visit([state](const auto& law) { law.start(state); }, any);
}

inline LawAnswer answer_of(const AnyYarnLaw& any, const LawInput& in, const double* now,
                           double* next) {
  return std::visit([&](const auto& law) { return law.at(in, now, next); }, any);
}

inline LawBound bound_of(const AnyYarnLaw& any) {
  return std::visit([](const auto& law) { return law.bound(); }, any);
}

/// The law of a yarn. viscosity: N s, of the simulation; crimped: in a cell of
/// core/model/crimp.hpp.
inline AnyYarnLaw yarn_law(const TensionLaw& elastic, double viscosity, bool crimped = false) {
  if (crimped) return CrimpedYarn{elastic, viscosity};
  return ViscousYarn{elastic, viscosity};
}

/// Whether a law sees rates of the process.
template <YarnLaw... Laws>
bool has_rates(const std::variant<Laws...>& any) {
  return std::visit([](const auto& law) { return law.has_rates; }, any);
}

/// The same of any law of a fabric.
inline bool has_rates(const Fabric& f) {
  const auto family_has = [](const YarnFamily& family) {
    return has_rates(yarn_law(family.tension, 0.0)) || family.bending_viscosity > 0.0;
  };
  const auto crossing_has = [](const Crossing& crossing) { return crossing.viscous.has_value(); };
  return f.matrix || f.plate_viscosity > 0.0 ||
         std::any_of(f.families.begin(), f.families.end(), family_has) ||
         std::any_of(f.crossings.begin(), f.crossings.end(), crossing_has);
}

} // namespace plyform
