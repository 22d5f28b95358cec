// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of yarns and stitches, a file each: what one is asked and answers is in law_input.hpp.
#pragma once

#include "core/model/relaxing_yarn.hpp"
#include "core/model/stitch_yarn.hpp"
#include "core/model/viscous_yarn.hpp"

#include <algorithm>
#include <variant>

namespace plyform {

/// The laws that a yarn or a stitch can have.
using AnyYarnLaw = std::variant<ViscousYarn, CrimpedYarn, RelaxingYarn, StitchYarn>;

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

/// The law of a yarn, which refers to what it is made of. viscosity: N s, of the simulation;
/// crimped: in a cell of core/model/crimp.hpp.
inline AnyYarnLaw yarn_law(const TensionLaw& elastic,
                           const std::optional<MaxwellBranch>& relaxation, double viscosity,
                           bool crimped = false) {
  if (crimped) return CrimpedYarn{elastic, viscosity};
  if (relaxation) return RelaxingYarn{elastic, *relaxation, viscosity};
  return ViscousYarn{elastic, viscosity};
}

/// Whether a law sees rates of the process.
template <YarnLaw... Laws>
bool has_rates(const std::variant<Laws...>& any) {
  return std::visit([](const auto& law) { return law.has_rates; }, any);
}

/// The same of any law of tension of a fabric's yarns.
inline bool has_rates_of_yarns(const Fabric& f) {
  return std::any_of(f.families.begin(), f.families.end(), [](const YarnFamily& family) {
    return has_rates(yarn_law(family.tension, family.relaxation, 0.0));
  });
}

/// The same of any law of a fabric.
inline bool has_rates(const Fabric& f) {
  const auto family_has = [](const YarnFamily& family) { return family.bending_viscosity > 0.0; };
  const auto crossing_has = [](const Crossing& crossing) { return crossing.viscous.has_value(); };
  return f.matrix || f.plate_viscosity > 0.0 || has_rates_of_yarns(f) ||
         std::any_of(f.families.begin(), f.families.end(), family_has) ||
         std::any_of(f.crossings.begin(), f.crossings.end(), crossing_has);
}

} // namespace plyform
