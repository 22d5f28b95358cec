// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a scene that must give the same bits for any number of threads.
#pragma once

#include "core/run/run.hpp"
#include "core/solver/scene.hpp"

#include <cstring>
#include <functional>
#include <gtest/gtest.h>

namespace plyform {

inline bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

inline void expect_same_bits(const RunResult& a, const RunResult& b) {
  EXPECT_EQ(a.summary.status, b.summary.status);
  EXPECT_EQ(a.summary.message, b.summary.message);
  EXPECT_EQ(a.summary.steps, b.summary.steps);
  EXPECT_EQ(std::memcmp(&a.last.energy, &b.last.energy, sizeof(Energies)), 0);
  ASSERT_EQ(a.last.plies.size(), b.last.plies.size());
  for (std::size_t p = 0; p < a.last.plies.size(); ++p)
    EXPECT_TRUE(same_bits(a.last.plies[p].x, b.last.plies[p].x)) << "ply " << p;
  ASSERT_EQ(a.last.tools.size(), b.last.tools.size());
  for (std::size_t t = 0; t < a.last.tools.size(); ++t)
    EXPECT_TRUE(same_bits({a.last.tools[t].force}, {b.last.tools[t].force})) << "tool " << t;
}

/// A scene at its end, and what its run gave.
struct EndedRun {
  Scene scene;
  RunResult result;
};

/// Runs what `make` makes on 1 thread and on 2, expects the same bits of both, returns the first.
inline EndedRun run_on_any_threads(const std::function<Scene()>& make,
                                   const RunHooks& hooks_of_first = {}) {
  EndedRun one{make(), {}};
  one.result = run_scene(one.scene, 1, hooks_of_first);
  Scene again = make();
  expect_same_bits(one.result, run_scene(again, 2, {}));
  return one;
}

} // namespace plyform
