// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies the yarns and the crimps of a weave from biaxial tension curves.
//
// Warp and weft are strained in some ratio, or one of them is free; loads of both per yarn over
// both strains. A crimped cell (core/model/crimp.hpp) makes such curves of two yarns and two
// crimps: stiffnesses k_1, k_2 and crimps c_1, c_2 by least squares of all rows of all files
// (Levenberg and Marquardt), with the weights of linear_law.hpp; where no line fits, tables of ten
// pieces that rise. Half waves are those of the fabric's crimp, or of a plain weave. A direction is
// free where its load stays below noise_share of the other's largest, or where the file does not
// have it: its strain is then not used.
//
// Limits from the covariance at the solution, as of linear_law.hpp; of crimps beside tables
// also by how far they move with half of the pieces. A wrong zero of strain, of one
// file and direction or of all files, is looked for as disturbances.hpp does: one more number to
// fit, found if chance would do it once in a thousand curves.
#pragma once

#include "core/identify/fit_quality.hpp"
#include "core/model/fabric.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// Rows of one biaxial test; both directions are as long, a free one that was not measured is 0.
struct BiaxialCurve {
  std::string file;
  std::vector<int> line;                     ///< of each row
  std::array<std::vector<double>, 2> strain; ///< warp, weft
  std::array<std::vector<double>, 2> load;   ///< N per yarn
  std::array<bool, 2> free{};                ///< the direction bears nothing
  std::size_t size() const { return line.size(); }
};

/// Reads a file whose header names warp and weft; loads are divided by `yarns`. Rows with an empty
/// cell are left out, with a warning. Reports errors and returns nothing as read_curve, for a
/// direction that has strain without load or the reverse, and for loads below 0 by more than
/// noise_share of the largest.
std::optional<BiaxialCurve>
read_biaxial(const std::string& file, const std::array<double, 2>& yarns, Diagnostics& diagnostics);

/// A strain that is too large by `amount` in a file, or in all.
struct StrainZero {
  std::optional<std::size_t> file; ///< nothing: all of them
  std::size_t direction = 0;
  double amount = 0.0, limits = 0.0;
};

struct BiaxialFit {
  std::array<TensionLaw, 2> yarn;           ///< of straight yarns
  std::array<double, 2> stiffness_limits{}; ///< of lines, N per yarn
  std::array<double, 2> crimp{}, crimp_limits{};
  std::array<double, 2> height{}; ///< mm, of the waves
  bool plain = true;              ///< half waves of one spacing
  bool line = true;
  std::vector<StrainZero> zeros; ///< taken off
  double sensitivity = 0.0;      ///< largest change of a crimp by a strain zero of 0.001, over it
  FitQuality quality;            ///< of both loads; at: strain
  std::vector<std::array<double, 2>> strain, measured, fitted; ///< of each row
  std::vector<std::size_t> specimen;
};

struct BiaxialOptions {
  bool fit_zeros = false; ///< takes wrong zeros of strain off, as far as they are found
  bool doubtful = false;  ///< warns of what is refused else
};

/// Reports an error and returns nothing if curves bear nothing, have fewer than eight rows with a
/// load, cannot be fitted to within 20 %, do not show the crimps (one strain ratio, or 95 % limits
/// as large as a crimp), or show a wrong zero of strain that makes the law worthless (tables follow
/// such zeros). Densities come from the fabric.
std::optional<BiaxialFit> identify_biaxial(const std::vector<BiaxialCurve>& curves,
                                           const Fabric& fabric, const BiaxialOptions& options,
                                           Diagnostics& diagnostics);

} // namespace plyform
