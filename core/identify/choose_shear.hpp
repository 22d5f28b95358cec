// SPDX-License-Identifier: GPL-3.0-or-later
// Which law a shear curve has.
//
// Cross-validation: the law is fitted without some rows and predicts them; error: root of the mean
// square of what it misses them by, over max(load, load_floor x the largest). Of several specimens
// each is left out in turn, and predicted but for a factor, by which specimens differ; of one,
// blocks of neighbouring rows (at most 20; single rows where they are few), but for the first and
// the last. Knots of tables are looked for anew each time.
//
// The first law in the order of preference whose mean squared error is within one standard error of
// the least is taken (one-standard-error rule: Breiman, Friedman, Olshen and Stone, Classification
// and Regression Trees, 1984, section 3.4.3; here of the differences between the two laws' errors
// of the same rows, as rows that are hard for one are so for all): polynomial of 3, of fewer and of
// more, static torque and polynomial, table. Where loads are largest such a law may still be far
// off: its misfit of the torque (shear_checks.hpp) must be below 2 %, twice the rows' noise, or
// twice the misfit of the law of the least error. Laws whose torque falls or is negative within the
// range are none.
//
// What a machine adds comes first: a load zero too high looks like a static torque. Where the
// polynomial of 3 shows a disturbance, and where rows are many (30), another law counts only if it
// explains the rows so much better than the polynomial with the disturbance that suits it best as
// chance does once in a thousand curves (Fisher's F of the further numbers; a knot that was looked
// for is one). A static torque rises from nothing within a small angle, a wrong zero is there at
// once: rows near 0 tell. Without them nothing does, and a load zero does not count; that the curve
// does not show it is warned of.
//
// Of specimens with more than 150 rows means of neighbouring ones are taken for the choice; the law
// is fitted to all.
#pragma once

#include "core/identify/fit_quality.hpp"
#include "core/identify/shear_forms.hpp"

namespace plyform {

struct LawChoice {
  ShearForm form;
  std::vector<double> knots; ///< of a table, rad
  std::string why;           ///< "cross-validated 1.9 %, polynomial of 3 14 %"
};

/// The law of the rows of all specimens, up to `end` (rad); `words` as for check_disturbances.
LawChoice choose_shear(const std::vector<ShearSpecimen>& specimens, double end,
                       const ShearTest& test, const Fabric& fabric, const FitOptions& options,
                       const CurveWords& words);

} // namespace plyform
