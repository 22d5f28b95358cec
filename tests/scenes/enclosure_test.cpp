// SPDX-License-Identifier: GPL-3.0-or-later
// What is not to be trusted of a vacuum between two membranes of rubber: borders that part, and
// single nodes that contact of two meshes dents.
#include "core/run/enclosures.hpp"
#include "core/run/run.hpp"
#include "support/scene_checks.hpp"

#include <gtest/gtest.h>

namespace plyform::enclosure_test {
namespace {

constexpr double side = 80.0, thickness = 1.0, vacuum = 0.09; // mm, mm, N/mm^2

BlankSpec square(double size, MeshKind mesh) {
  BlankSpec blank = rectangle(side, side, size);
  blank.mesh = mesh;
  return blank;
}

/// Clamped all round.
Case enclosed(const BlankSpec& lower, const BlankSpec& upper, bool same) {
  Case data = stack_of({0.0, 0.0}, lower);
  Fabric rubber;
  rubber.name = "rubber";
  rubber.thickness = thickness, rubber.surface_density = 1.1e-9;
  rubber.sheet = MooneyRivlinLaw{0.5 * 0.4 * thickness, 0.0};
  data.fabrics = {rubber};
  data.blanks = {lower, upper};
  for (std::size_t p = 0; p < 2; ++p) {
    data.plies[p].fabric = 0, data.plies[p].blank = same ? 0 : static_cast<int>(p);
    data.plies[p].z = thickness * static_cast<double>(p);
  }
  const double half = 0.5 * side;
  const Vec2 corners[] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  for (std::size_t i = 0; i < 4; ++i) {
    Grip grip;
    grip.place = {true, {corners[i], corners[(i + 1) % 4]}};
    data.boundaries.push_back({"side" + std::to_string(i), -1, grip});
  }
  data.loads = {{0, PlyFace::below, vacuum, {{0.5, vacuum}}},
                {1, PlyFace::above, vacuum, {{0.5, vacuum}}}};
  set_friction(data, 0.0);
  data.solver.duration = 0.03;
  data.solver.mass_damping = 200.0;
  data.solver.outputs = 1;
  return data;
}

bool dented(const RunResult& run) {
  for (const std::string& doubt : run.summary.doubts)
    if (doubt.find("give both the same blank") != std::string::npos) return true;
  return false;
}

TEST(Enclosure, DentsOfTwoMeshesAreDoubted) {
  const BlankSpec fine = square(5.0, MeshKind::alternating);
  EXPECT_TRUE(dented(run_case(enclosed(fine, square(7.0, MeshKind::free), false), 1, {})));
  EXPECT_TRUE(dented(run_case(enclosed(fine, square(8.0, MeshKind::alternating), false), 1, {})));
  EXPECT_FALSE(dented(run_case(enclosed(fine, fine, true), 1, {})));
}

/// What is said once `move` has moved the upper of two sheets.
template <class Move>
std::string doubts_when(const Move& move) {
  const BlankSpec fine = square(5.0, MeshKind::alternating);
  Scene s = make_scene(enclosed(fine, fine, true));
  for (Vec3& x : s.plies[1].x)
    move(x);
  const std::vector<std::string> doubts = doubts_of_enclosures(s);
  return doubts.empty() ? "" : doubts.front();
}

TEST(Enclosure, BordersThatPartAreDoubted) {
  EXPECT_EQ(doubts_when([](Vec3&) {}), "");
  EXPECT_EQ(doubts_when([](Vec3& x) { x.z() += 1e-3 * (1600.0 - x.x() * x.x()); }), ""); // bulged
  const auto parted = [](const std::string& doubt) {
    return doubt.find("their borders have parted") != std::string::npos;
  };
  EXPECT_TRUE(parted(doubts_when([](Vec3& x) { x.x() *= 0.9; })));
  EXPECT_TRUE(parted(doubts_when([](Vec3& x) { x.x() += 10.0; })));
  EXPECT_TRUE(parted(doubts_when([](Vec3& x) { x.z() += 0.2 * x.x(); })));
}

} // namespace
} // namespace plyform::enclosure_test
