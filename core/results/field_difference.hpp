// SPDX-License-Identifier: GPL-3.0-or-later
// How far a field of one run is from that of another, on whatever meshes: differences at places of
// the material, over the area before forming.
#pragma once

#include "core/results/frame.hpp"

#include <string>
#include <vector>

namespace plyform {

/// Of the difference of two fields, over the area before forming.
struct FieldError {
  double rms = 0; ///< root of the mean square
  double p99 = 0; ///< 99 % of the area has at most this magnitude
  double max = 0;
  double p95 = 0;  ///< as p99, of 95 % of the area
  double mean = 0; ///< of the magnitudes
};

struct FieldDifference {
  FieldError error;
  std::vector<std::vector<double>> at_nodes; ///< of each ply, one a node of the reference
};

/// A value a triangle by its name in results.h5, shear_angle_deg say: the run's less the
/// reference's, each evened out by nodal_means, at all nodes of all plies of the reference before
/// forming, weighted by the area of each node there. Errors are NaN if any of them is. Throws
/// std::runtime_error if the two have not the same number of plies, std::invalid_argument, which
/// lists the names, if a ply has no such field.
FieldDifference field_difference(const Frame& run, const Frame& reference,
                                 const std::string& field);

/// A value of each triangle made one of each node: the mean over the triangles around it, weighted
/// by their areas before forming. On the rim this is the value a third of a side or so inside.
/// Sizes: m values of m triangles in, n values of n nodes out.
std::vector<double> nodal_means(const PlyFrame& ply, const std::vector<double>& values);

/// The field with the given values at the nodes of `ply` (n), linear in each triangle before
/// forming, at the points (x and y, mm; p of them, as many values out). A point outside of the ply
/// takes the value at the nearest place on it. Throws std::runtime_error for a ply without
/// triangles.
std::vector<double> interpolate(const PlyFrame& ply, const std::vector<double>& nodal,
                                const std::vector<Vec3>& points);

/// A frame with this ply alone, without tools and boundaries.
Frame only_ply(const Frame& frame, std::size_t ply);

/// The error of field_difference, of the shear angle, degrees.
FieldError shear_error(const Frame& run, const Frame& reference);

} // namespace plyform
