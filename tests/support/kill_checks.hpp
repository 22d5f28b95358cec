// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that are given up and gone on with must end in the state of one that never stopped.
#pragma once

#include "core/run/checkpoint.hpp"
#include "core/run/run.hpp"
#include "support/scene_checks.hpp"
#include "support/thread_checks.hpp"

#include <gtest/gtest.h>
#include <memory>

namespace plyform {

/// Runs to the end from `resume`, saves at each step, and is given up after `steps` of them.
struct GivenUp {};
inline std::string saved_until(Scene& scene, const Resume* resume, long steps, Frame& last) {
  std::string saved;
  RunHooks hooks;
  hooks.resume = resume;
  hooks.frame = [&](const Frame& frame) { last = frame; };
  hooks.checkpoint.interval = 0.0;
  hooks.checkpoint.save = [&](const std::string& state) {
    saved = state;
    if (--steps == 0) throw GivenUp();
  };
  try {
    run_scene(scene, 1 + static_cast<int>(steps % 2), hooks);
  } catch (const GivenUp&) {
  }
  return saved;
}

/// A run given up `kills` times, in the middle of whatever follows, ends in the state of one that
/// never was.
inline void expect_the_same_after_kills(const Case& data, int kills) {
  Scene whole = make_scene(data);
  const long steps = run_scene(whole, 1, {}).summary.steps;
  ASSERT_GT(steps, kills);
  std::unique_ptr<Resume> resume;
  Frame last;
  for (int i = 0; i < kills; ++i) {
    Scene killed = make_scene(data);
    const std::string saved = saved_until(killed, resume.get(), steps / (kills + 1), last);
    ASSERT_FALSE(saved.empty());
    resume = std::make_unique<Resume>(Resume{saved, last});
  }
  Scene again = make_scene(data);
  RunHooks hooks;
  hooks.resume = resume.get();
  EXPECT_EQ(run_scene(again, 2, hooks).summary.steps, steps);
  EXPECT_EQ(state_hash(again), state_hash(whole));
  EXPECT_EQ(first_difference(again, save_state(whole, RunState{})), "");
}

/// A run that ends with its energies closed, with the same bits on two threads and after `kills`.
/// Returns its last energies.
inline Energies expect_sound_and_repeatable(const Case& data, int kills) {
  const RunResult one = run_case(data, 1, {});
  EXPECT_TRUE(ended(one.summary.status)) << one.summary.message;
  EXPECT_LT(std::abs(one.last.energy.balance_error()), 0.01);
  expect_same_bits(run_case(data, 2, {}), one);
  expect_the_same_after_kills(data, kills);
  return one.last.energy;
}

} // namespace plyform
