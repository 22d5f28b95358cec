// SPDX-License-Identifier: GPL-3.0-or-later
// A scene that is saved between two searches and loaded into a new one. Whole runs that are killed
// and resumed: tests/cli/resume_test.sh.
#include "core/solver/checkpoint.hpp"
#include "core/solver/step.hpp"
#include "support/scene_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::checkpoint_test {
namespace {

/// A ply that falls onto another from far away: their boxes are apart at the start only.
Case falling_ply() {
  Case data = stack_of({0.0, 0.7}, rectangle(60.0, 60.0, 10.0));
  data.plies[1].z += 12.0;
  Tool floor;
  floor.name = "floor";
  floor.shape = Plane{};
  data.tools = {floor};
  set_friction(data, 0.2);
  data.gravity = Vec3(0.0, 0.0, -1e6); // mm/s^2: there in 5 ms
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.01;
  return data;
}

void step(Scene& s, ThreadPool& pool) {
  const std::optional<Stop> stop = compute_forces(s, pool);
  ASSERT_FALSE(stop) << stop->message;
  move_plies(s, pool);
}

TEST(Checkpoint, LoadedSceneHasTheBoxesOfTheLastSearchAndGoesOnTheSameWay) {
  ThreadPool pool(1);
  Scene scene = make_scene(falling_ply());
  start(scene, pool);
  const auto gap = [&] { return scene.plies[1].x[0].z() - scene.plies[0].x[0].z(); };
  while (gap() > 2.0)
    step(scene, pool);
  for (const long searches = scene.searches; scene.searches == searches;)
    step(scene, pool);
  step(scene, pool); // between two searches
  RunState run;
  const std::string saved = save_state(scene, run);

  Scene loaded = make_scene(falling_ply());
  load_state(saved, loaded, run);
  for (std::size_t p = 0; p < 2; ++p)
    EXPECT_TRUE(loaded.plies[p].tree->bounds().isApprox(scene.plies[p].tree->bounds()))
        << "ply " << p + 1;
  double closest = gap();
  for (int i = 0; i < 1000; ++i) {
    step(scene, pool);
    step(loaded, pool);
    closest = std::min(closest, gap());
  }
  EXPECT_EQ(scene.plies[0].x, loaded.plies[0].x);
  EXPECT_EQ(scene.plies[1].x, loaded.plies[1].x);
  EXPECT_LT(closest, glass_weave().thickness) << "they have not met";
}

} // namespace
} // namespace plyform::checkpoint_test
