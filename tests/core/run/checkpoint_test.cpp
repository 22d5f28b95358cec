// SPDX-License-Identifier: GPL-3.0-or-later
// A scene that is saved between two searches and loaded into a new one. Whole runs that are killed
// and resumed: tests/cli/resume_test.sh.
#include "core/run/checkpoint.hpp"
#include "core/run/run.hpp"
#include "core/solver/step.hpp"
#include "support/boundary_scenes.hpp"
#include "support/kill_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

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

// Planes of symmetry are boundaries that states do not tell.
TEST(Checkpoint, OfAPartWithPlanesOfSymmetryGoesOnTheSameWay) {
  const Case data = pushed_square(0.0, MeshKind::alternating, true);
  Resume middle;
  Frame latest;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) { latest = frame; };
  hooks.marks = {2, [&](int number, const Scene&, const std::function<std::string()>& state) {
                   if (number == 1) middle = {state(), latest};
                 }};
  const RunResult whole = run_case(data, 1, hooks);
  ASSERT_FALSE(middle.state.empty());
  RunHooks again;
  again.resume = &middle;
  const RunResult gone_on = run_case(data, 1, again);
  EXPECT_EQ(gone_on.last.plies[0].x, whole.last.plies[0].x);
  EXPECT_EQ(gone_on.summary.steps, whole.summary.steps);
}

/// Two plies that lie on each other, in themselves and on a mesh, held by a grip, some steps on.
Case touching_plies() {
  Case data = stack_of({0.0, 0.7}, rectangle(60.0, 60.0, 20.0));
  Tool floor;
  floor.name = "floor";
  floor.shape = make_mesh_shape(tessellate(Box{{100.0, 100.0, 10.0}}, 50.0, 100.0), nullptr);
  floor.position = {0.0, 0.0, -5.0};
  Tool punch;
  punch.name = "punch";
  punch.shape = Sphere{20.0};
  punch.position = {0.0, 0.0, 21.2};
  punch.motion = Motion::driven;
  punch.stroke = 0.5;
  data.tools = {floor, punch};
  set_friction(data, 0.2);
  data.contact.self = SelfContact::on;
  data.solver.fibre_softening = 100.0;
  data.solver.duration = 0.01;
  return data;
}

/// Reads as LoadArchive, but leaves one member as it was, as if nobody had listed it.
class ForgetfulArchive : public LoadArchive {
public:
  ForgetfulArchive(std::string_view text, std::string forgotten)
      : LoadArchive(text), forgotten_(std::move(forgotten)) {}
  void enter(std::string_view name) { path_.emplace_back(name); }
  void leave() { path_.pop_back(); }
  void bytes(void* data, std::size_t size) {
    std::vector<char> read(size);
    LoadArchive::bytes(read.data(), size);
    if (std::find(path_.begin(), path_.end(), forgotten_) == path_.end())
      std::copy(read.begin(), read.end(), static_cast<char*>(data));
  }

private:
  std::string forgotten_;
  std::vector<std::string> path_;
};

/// What is loaded goes on as what was saved: the comparison at its end finds each member that the
/// lists would lack, by what it has changed.
TEST(Checkpoint, AMemberThatNobodyListedIsFoundByComparing) {
  ThreadPool pool(1);
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.solver.duration = 0.03;
  Scene scene = make_scene(data);
  start(scene, pool);
  const auto closed = [&] { // and yarns are taut
    return scene.tools[0].contacts[1].sums.touching > 0 && scene.group_sums[0] > 0.0 &&
           scene.ply_pairs[0].passes[0].contact.sums.touching > 0;
  };
  for (int i = 0; i < 5000 && !closed(); ++i)
    step(scene, pool);
  ASSERT_TRUE(closed());
  const std::string begin = save_state(scene, RunState{});
  for (int i = 0; i < 10; ++i)
    step(scene, pool);
  const std::string end = save_state(scene, RunState{});
  const auto difference = [&](const char* forgotten) {
    Scene loaded = make_scene(data);
    ForgetfulArchive archive(begin, forgotten);
    visit(archive, loaded);
    for (PlyBody& ply : loaded.plies)
      ply.tree->refit(ply.x_search);
    for (int i = 0; i < 10; ++i) {
      if (compute_forces(loaded, pool)) return std::string("a stop");
      move_plies(loaded, pool);
    }
    return first_difference(loaded, end);
  };
  EXPECT_EQ(difference("nothing"), "");
  EXPECT_EQ(difference("velocity"), "plies.0.x");
  for (const char* member : {"x", "motion", "yarns", "memory", "gap", "filter", "work", "dt",
                             "group_sums", "path_length", "sums"})
    EXPECT_NE(difference(member), "") << member;
}

TEST(Checkpoint, HashTellsStatesApart) {
  ThreadPool pool(1);
  Scene scene = make_scene(falling_ply()), other = make_scene(falling_ply());
  start(scene, pool), start(other, pool);
  EXPECT_EQ(state_hash(scene), state_hash(other));
  EXPECT_EQ(first_difference(scene, save_state(other, RunState{})), "");
  double& v = other.plies[1].velocity[3].y();
  v = std::nextafter(v, 1.0);
  EXPECT_NE(state_hash(scene), state_hash(other));
  EXPECT_EQ(first_difference(scene, save_state(other, RunState{})), "plies.1.velocity");
}

TEST(Checkpoint, StateAfterKillsIsThatOfARunNeverStopped) {
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.tools[0].stroke = 20.0;
  data.solver.duration = 0.005;
  data.solver.mass_damping = 100.0;
  expect_the_same_after_kills(data, 5);
}

/// The laws of a scene that has stopped remember what they did at the state it went back to.
TEST(Checkpoint, WhatLawsRememberIsTakenBackAfterAStop) {
  Case data = coarse_hemisphere({0.0, 0.25 * std::numbers::pi});
  data.solver.duration = 0.03;
  data.solver.outputs = 5;
  Scene scene = make_scene(data);
  RunHooks hooks;
  std::vector<SimdYarnStates> kept;
  hooks.progress = [&](const Progress&) { kept = scene.plies[0].yarns; };
  hooks.frame = [&](const Frame& frame) {
    if (frame.step > 500) scene.plies[1].velocity[0] = {1e9, 0.0, 0.0}; // goes wrong
  };
  const RunResult result = run_scene(scene, 1, hooks);
  ASSERT_EQ(result.summary.status, "stopped") << result.summary.message;
  ASSERT_FALSE(kept.empty());
  EXPECT_GT(scene.step, 500);
  EXPECT_EQ(
      std::memcmp(kept.data(), scene.plies[0].yarns.data(), kept.size() * sizeof(SimdYarnStates)),
      0);
}

/// A state with one field changed, as somebody does who then makes the checksum right: refused, or
/// a scene that can be computed on.
class ChangedState : public ::testing::Test {
protected:
  void SetUp() override {
    scene = make_scene(touching_plies());
    start(scene, pool);
    for (int i = 0; i < 60; ++i)
      step(scene, pool);
    saved = save_state(scene, run);
  }
  /// Whether the state is refused; else some steps are computed from it.
  bool refused(const std::string& state) {
    Scene loaded = make_scene(touching_plies());
    RunState other;
    try {
      load_state(state, loaded, other);
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()), "");
      return true;
    }
    for (int i = 0; i < 3 && !compute_forces(loaded, pool); ++i)
      move_plies(loaded, pool);
    return false;
  }
  ThreadPool pool{1};
  Scene scene;
  RunState run;
  std::string saved;
};

TEST_F(ChangedState, OfWhateverFieldIsRefusedOrComputedOn) {
  ASSERT_FALSE(refused(saved));
  int count = 0;
  const std::size_t stride = std::max<std::size_t>(4, saved.size() / 350 / 4 * 4);
  for (std::size_t at = 0; at + 8 <= saved.size(); at += stride)
    for (const std::int32_t by : {-1, 1 << 30, std::numeric_limits<std::int32_t>::min()}) {
      std::string changed = saved;
      std::memcpy(&changed[at], &by, sizeof by);
      if (by == -1) std::memcpy(&changed[at + 4], &by, sizeof by); // NaN, and -1 of 64 bits
      if (changed != saved && refused(changed)) ++count;
    }
  EXPECT_GT(count, 150) << "of some 1000";
}

TEST_F(ChangedState, IndicesSizesAndChoicesAreChecked) {
  const auto refuses = [&](const char* what, const auto& change) {
    Scene other = make_scene(touching_plies());
    RunState state;
    load_state(saved, other, state);
    change(other, state);
    std::string bytes = save_state(other, state);
    EXPECT_TRUE(refused(bytes)) << what;
  };
  ASSERT_FALSE(scene.ply_pairs[0].passes[0].contact.points.empty());
  ASSERT_FALSE(scene.tools[0].contacts[0].points.empty());
  ASSERT_FALSE(scene.ply_pairs[0].edges.contact.candidates.empty());
  refuses("a face",
          [](Scene& s, RunState&) { s.ply_pairs[0].passes[0].contact.points[0].face = 1000; });
  refuses("a node",
          [](Scene& s, RunState&) { s.ply_pairs[0].passes[0].contact.points[0].node = -1; });
  refuses("faces",
          [](Scene& s, RunState&) { s.ply_pairs[0].passes[0].contact.faces[0] = 1 << 20; });
  refuses("a range", [](Scene& s, RunState&) {
    s.ply_pairs[0].passes[0].contact.points[0].end_face = 1 << 20;
  });
  refuses("distances",
          [](Scene& s, RunState&) { s.ply_pairs[0].passes[0].contact.face_distance.pop_back(); });
  refuses("an active one", [](Scene& s, RunState&) {
    s.ply_pairs[0].passes[0].contact.list.active.push_back(1 << 20);
  });
  refuses("a node at a tool",
          [](Scene& s, RunState&) { s.tools[0].contacts[0].points[0].node = 1 << 20; });
  refuses("a facet",
          [](Scene& s, RunState&) { s.tools[0].contacts[0].points[0].hint.nearest = 1 << 20; });
  refuses("forces", [](Scene& s, RunState&) { s.tools[0].contacts[0].force.pop_back(); });
  refuses("an edge", [](Scene& s, RunState&) {
    s.ply_pairs[0].edges.contact.candidates[0].edge[1] = 1 << 20;
  });
  refuses("a patch",
          [](Scene& s, RunState&) { s.ply_pairs[0].edges.contact.groups[0].patch[0] = -1; });
  refuses("nodes", [](Scene& s, RunState&) { s.plies[1].x.pop_back(); });
  refuses("a place", [](Scene& s, RunState&) {
    s.plies[1].x[3].x() = std::numeric_limits<double>::quiet_NaN();
  });
  refuses("viscosity", [](Scene& s, RunState&) { s.plies[0].yarns.pop_back(); });
  refuses("a ridge", [](Scene& s, RunState&) { s.plies[0].ridges.sides[0] = 7; });
  refuses("sums", [](Scene& s, RunState&) { s.group_sums.clear(); });
  refuses("the step", [](Scene& s, RunState&) { s.step = -1; });
  refuses("the time", [](Scene& s, RunState&) { s.time *= 2.0; });
  refuses("a way", [](Scene& s, RunState&) { s.tools[1].body.displacement.z() += 0.1; });
  refuses("outputs", [](Scene&, RunState& r) { r.outputs_written = 1 << 20; });
  refuses("the good state", [](Scene& s, RunState& r) { r.good.plies.resize(s.plies.size()); });
}

} // namespace
} // namespace plyform::checkpoint_test
