// SPDX-License-Identifier: GPL-3.0-or-later
// A strip that bends under its own weight, against the heavy elastica.
#include "core/run.hpp"
#include "scene_checks.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>

namespace plyform {
namespace {

/// Sag of the end of a clamped strip of length L under its weight, from the elastica
/// D theta'' = w (L - s) cos(theta), theta(0) = 0, theta'(L) = 0, by shooting; theta downwards.
double elastica_sag(double length, double w, double d) {
  const int steps = 4000;
  const double h = length / steps;
  double sag = 0.0;
  const auto shoot = [&](double start) { // theta'(L) for theta'(0) = start
    double theta = 0.0, slope = start;
    sag = 0.0;
    for (int i = 0; i < steps; ++i) { // midpoint rule
      const double s = i * h;
      const double middle = theta + 0.5 * h * slope;
      const double slope_middle = slope - 0.5 * h * w * (length - s) * std::cos(theta) / d;
      slope -= h * w * (length - s - 0.5 * h) * std::cos(middle) / d;
      theta += h * slope_middle;
      sag += h * std::sin(middle);
    }
    return slope;
  };
  double low = 0.0, high = 0.5 * w * length * length / d; // the linear beam's
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(middle) < 0.0 ? low : high) = middle;
  }
  return sag;
}

/// Sag (mm) of the free end of a strip of 100 mm beyond its clamp, at rest: a plate without
/// Poisson's effect, which is a beam.
double strip_sag(double stiffness, MeshKind mesh) {
  Case data = stack_of({0.0}, rectangle(110.0, 20.0, 5.0));
  data.blanks[0].mesh = mesh;
  Fabric fabric;
  fabric.surface_density = data.fabrics[0].surface_density;
  fabric.thickness = data.fabrics[0].thickness;
  fabric.isotropic = IsotropicLaw{12.0 * stiffness / (fabric.thickness * fabric.thickness), 0.0};
  fabric.bending.warp.stiffness = fabric.bending.weft.stiffness = stiffness;
  fabric.bending.twist = 2.0 * stiffness;
  data.fabrics[0] = fabric;
  Boundary clamp;
  clamp.name = "clamp";
  clamp.place = {Vec2(-55.0, -10.0), Vec2(-45.0, 10.0)}; // two cells: place and slope
  data.boundaries = {clamp};
  data.gravity = {0.0, 0.0, -9810.0};
  set_friction(data, 0.0);
  data.solver.mass_damping = 40.0; // 1/s, about critical for the first mode of the softer strip
  data.solver.duration = 0.5;
  const RunResult run = run_case(data, 2, {});
  EXPECT_EQ(run.summary.status, "done") << run.summary.message;
  double sag = 0.0;
  int ends = 0;
  for (std::size_t n = 0; n < run.last.plies[0].x0.size(); ++n)
    if (run.last.plies[0].x0[n].x() > 54.9) {
      sag += run.last.plies[0].x0[n].z() - run.last.plies[0].x[n].z();
      ++ends;
    }
  return sag / ends;
}

TEST(BendingLong, StripHangsAsTheHeavyElastica) {
  const double w = 6e-10 * 9810.0;             // N/mm^2
  for (const double stiffness : {10.0, 2.0}) { // w L^3/D = 0.6 and 2.9: small and large sag
    // The node at the clamp's end bends by what lies half a cell on either side of it, so the strip
    // is clamped in the middle of the last clamped cell: 2.5 mm more than from node to node.
    const double theory = elastica_sag(102.5, w, stiffness);
    for (const MeshKind mesh : {MeshKind::diagonal, MeshKind::alternating}) {
      const double sag = strip_sag(stiffness, mesh);
      // 3 %: 20 elements along the strip
      EXPECT_NEAR(sag, theory, 0.03 * theory);
      std::cout << "[ sag      ] " << sag / theory << " of theory\n";
    }
  }
}

} // namespace
} // namespace plyform
