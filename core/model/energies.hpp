// SPDX-License-Identifier: GPL-3.0-or-later
// The energies of a run and their balance. The table energy_terms defines the terms for
// history.csv, summary.json, the balance and the plots.
#pragma once

#include <array>

namespace plyform {

/// Energies, and work done since the start, N mm (mJ). friction: of dry sliding; film: of laws that
/// go by the viscosity of a film. external: work of tools, boundaries, loads
/// and gravity on the plies, the energy of the plies at the start, and what changes of temperature
/// give to the energy of shear (W df, C_e = f dW/dgamma), which no work of the plies is.
/// mass_scaling: kinetic energy that came with added mass.
struct Energies {
  double kinetic = 0, fibre = 0, shear = 0, stitch = 0, bending = 0, contact = 0, friction = 0,
         damping = 0, stitch_breaking = 0, external = 0, mass_scaling = 0, compaction = 0,
         viscous = 0, film = 0;
  /// Energies below this are rounding errors, and ratios to them mean nothing; no term of the
  /// balance. Scene::energy_floor.
  double floor = 0;
  double residual() const; ///< stored and dissipated energy minus external work, N mm
  double largest() const;  ///< magnitude of the largest term; NaN if any is
  /// residual() over largest(), or over the floor if that is more; 0 when all are 0.
  double balance_error() const;
  /// Work of all deformation, stored and lost: of yarns, shear, stitches and bending, and through
  /// the thickness; without friction and damping, N mm.
  double deformation() const;
  double kinetic_over_deformation() const; ///< as balance_error, of the kinetic energy
  double kinetic_over_shear() const;       ///< likewise
  Energies& operator+=(const Energies& more);
  double kinetic_over(double work) const; ///< of a work in N mm, likewise; 0 when both are 0
};

/// A term: its name in files and in words, and its sign in the balance: stored or dissipated +1,
/// external work -1.
struct EnergyTerm {
  const char *name, *label;
  double Energies::*value;
  double sign;
};

inline constexpr std::array<EnergyTerm, 14> energy_terms = {{
    {"kinetic", "kinetic", &Energies::kinetic, 1.0},
    {"fibre", "fibres", &Energies::fibre, 1.0},
    {"shear", "shear", &Energies::shear, 1.0},
    {"stitch", "stitches", &Energies::stitch, 1.0},
    {"bending", "bending", &Energies::bending, 1.0},
    {"contact", "contact", &Energies::contact, 1.0},
    {"friction", "friction", &Energies::friction, 1.0},
    {"film", "film friction", &Energies::film, 1.0},
    {"damping", "damping", &Energies::damping, 1.0},
    {"compaction", "compaction loss", &Energies::compaction, 1.0},
    {"viscous", "viscous loss", &Energies::viscous, 1.0},
    {"stitch_breaking", "stitch breaking", &Energies::stitch_breaking, 1.0},
    {"external", "external work", &Energies::external, -1.0},
    {"mass_scaling", "mass scaling", &Energies::mass_scaling, -1.0},
}};

} // namespace plyform
