// SPDX-License-Identifier: GPL-3.0-or-later
// What the stress table's runs are made and judged with.
#pragma once

#include "core/run/run.hpp"
#include "support/scene_checks.hpp"
#include "support/stress_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace plyform {

/// A file of this process's own.
inline std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(::testing::TempDir()) / fmt::format("{}_{}", getpid(), name);
}

/// Holds the nodes in a box, in all directions.
inline Boundary hold(const std::string& name, const Vec2& low, const Vec2& high,
                     const Vec3& direction, double stroke) {
  Grip g;
  g.place = {false, {low, high}};
  g.direction = direction;
  g.stroke = stroke;
  return {name, -1, g};
}

/// Relative error of the ledger; none where all of it is rounding, below 1e-6 N mm.
inline double imbalance(const Energies& e) {
  const double largest =
      std::max({std::abs(e.kinetic), e.fibre, e.shear, e.damping, std::abs(e.external)});
  return largest < 1e-6 ? 0.0 : std::abs(e.balance_error());
}

/// Stopped, and the message names step, time, ply, triangle and the values.
inline void expect_collapse(const RunResult& run, const std::string& what) {
  EXPECT_EQ(run.summary.status, "stopped") << what;
  for (const char* part : {"stopped at step ", "time ", "ply ply1", "triangle ", "collapsed",
                           "along warp", "along weft", "sheared by", "degrees"})
    EXPECT_NE(run.summary.message.find(part), std::string::npos) << run.summary.message;
  for (const Vec3& x : run.last.plies.at(0).x)
    EXPECT_TRUE(x.allFinite()) << what;
  fmt::print("{}: {}\n", what, run.summary.message);
}

} // namespace plyform
