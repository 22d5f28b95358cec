// SPDX-License-Identifier: GPL-3.0-or-later
// What a law at a point is asked, and what it answers. A law reads the state of the begin of a step
// and writes that of its end, so that evaluating it twice is harmless: the step is taken when the
// states are exchanged (move_plies of core/solver/step.hpp). What it stores and what it loses come
// out of the evaluation, so that the balance of energy holds for laws with a history, too.
#pragma once

#include "core/model/law_point.hpp"

#include <concepts>

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
  double time_factor = 1.0; ///< of times in a law, by its temperature: Fabric::flow
};

/// What it answers, per yarn.
struct LawAnswer {
  double value = 0.0;   ///< N, tension
  double slope = 0.0;   ///< N, its derivative by strain
  double damping = 0.0; ///< N s, its derivative by the rate of strain
  double stored = 0.0;  ///< N mm per mm, elastic energy at the end of the step
  double lost = 0.0;    ///< N mm per mm, dissipated in the step by damping, or as it breaks
  double flowed = 0.0;  ///< N mm per mm, dissipated in the step by rates of the process
};

/// On what the stable step relies.
struct LawBound {
  double slope = 0.0;     ///< N, the largest
  double damping = 0.0;   ///< N s, likewise
  double unrelaxed = 0.0; ///< N; times the strain what it pulls beyond its elastic tension at most
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

} // namespace plyform
