// SPDX-License-Identifier: GPL-3.0-or-later
// How what lies between two mid-surfaces, or a mid-surface and a tool, gives way through its
// thickness: pressure against depth, from the thickness at which nothing presses to the densest
// packing. Two bodies in series bear the same pressure, and their depths add up.
#pragma once

#include "contact/simd/contact_points.hpp"

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace plyform {

/// Half of a ply: how much thinner it is under a pressure.
struct HalfCompaction {
  std::vector<double> pressure; ///< N/mm^2, ascending from 0
  std::vector<double> depth;    ///< mm, ascending from 0: half of the loss of thickness
};

/// A curve of pressure over depth, sampled evenly so that kernels find their place in it at once:
/// linear in between, and the energy the integral of that.
class CompactionCurve {
public:
  /// Of one half ply (on a tool) or of two in series; a body without a curve (null) does not give
  /// way. At least one is given; each has two points or more. It ends where the first of them does,
  /// and at `most` (N/mm^2). Throws std::invalid_argument if a curve does not ascend.
  CompactionCurve(const HalfCompaction* a, const HalfCompaction* b,
                  double most = std::numeric_limits<double>::infinity());

  /// mm, depth at the densest packing, where the curve ends.
  double packed() const { return packed_; }
  double last_pressure() const { return pressure_.back(); } ///< N/mm^2, there
  /// N/mm^3, of the last piece, with which it goes on beyond.
  double last_slope() const {
    return (pressure_.back() - pressure_[pressure_.size() - 2]) * per_spacing_;
  }
  /// N/mm^2 at a depth (mm) of 0 to packed().
  double pressure(double depth) const;
  /// N/mm^3, the largest slope from 0 up to a depth (mm) of 0 to packed().
  double steepest(double depth) const { return steepest_[piece_of(depth)]; }
  /// N/mm, the work per area up to a depth (mm) of 0 to packed().
  double energy(double depth) const;
  /// Depth (mm) at a pressure (N/mm^2) of 0 to last_pressure().
  double depth_at(double pressure) const;

  /// For kernels; valid as long as this is.
  CompactionTable table() const {
    return {pressure_.data(), energy_.data(), static_cast<int>(pressure_.size()) - 1, per_spacing_,
            packed_};
  }

private:
  std::size_t piece_of(double depth) const;

  std::vector<double> pressure_, energy_; ///< at both ends of all pieces
  std::vector<double> steepest_;          ///< N/mm^3, of the pieces so far
  double packed_ = 0.0, per_spacing_ = 0.0;
};

using CompactionCurvePtr = std::shared_ptr<const CompactionCurve>;

} // namespace plyform
