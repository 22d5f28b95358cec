// SPDX-License-Identifier: GPL-3.0-or-later
// How cloth gives way through its thickness, from the pressure between flat plates over thickness
// or fibre volume fraction. V: fibre volume fraction, V0 without pressure; t0 = fibres / V0.
//
//   p = s (V^n - V0^n)                              core/model/compaction.hpp                (TM)
//   p = A (V / V0 - 1) / (1 / V - 1 / Va)^4                                                  (G)
//
// (G): T. G. Gutowski and others, Consolidation experiments for laminate composites, J. Composite
// Materials 21, 1987. Thicknesses at pressures are compared, not pressures at thicknesses: those of
// many laboratories differ by some 4 % in the one and by 42 % in the other (A. X. H. Yong and
// others, Composites A 142, 2021, 106243).
#pragma once

#include "core/identify/curve_file.hpp"
#include "core/identify/fit_quality.hpp"
#include "core/model/compaction.hpp"

namespace plyform {

enum class CompactionForm { toll_manson, gutowski, table };

/// Pressures are N/mm^2, thicknesses mm, of one ply.
struct CompactionFit {
  CompactionForm form = CompactionForm::table;
  ThicknessCurve loading; ///< the law as points, from no pressure to the densest that was measured
  ThicknessCurve unloading; ///< likewise of rows that were measured as it opened; may be empty
  double free_volume = 0.0; ///< V0
  double densest = 0.0;     ///< V
  /// (TM): s, n; (G): A, Va; V0 is free_volume. With half widths of 95 % limits; none of a table.
  double scale = 0.0, shape = 0.0;
  double scale_limits = 0.0, shape_limits = 0.0, free_limits = 0.0;
  double scatter = 0.0; ///< largest standard deviation of thickness between specimens, over it
  FitQuality quality;   ///< of thickness, over pressure
  std::vector<double> pressure, measured, fitted; ///< of each row, thicknesses
  std::vector<std::size_t> specimen;              ///< of each row
};

struct CompactionSpecimen {
  double fibres = 0.0; ///< mm, thickness of the fibres of one ply alone: rho_A / rho_f
  double layers = 1.0; ///< plies between the plates
};

/// From curves of x: thickness of all layers (mm), or fibre volume fraction; y: pressure (N/mm^2).
/// `opening`: curves of the plates going apart. The form is chosen unless given: (TM) where it is
/// within a hundredth of each thickness or within what rows scatter by, else a table. Reports
/// errors and returns nothing where rows are no compaction.
std::optional<CompactionFit> identify_compaction(const std::vector<Curve>& curves,
                                                 const std::vector<Curve>& opening,
                                                 const CompactionSpecimen& specimen,
                                                 std::optional<CompactionForm> form,
                                                 Diagnostics& diagnostics);

} // namespace plyform
