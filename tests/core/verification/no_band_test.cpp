// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of which siblings show no error, and those that their bands say nothing of.
#include "core/setup/prepare_case.hpp"
#include "support/run_ends.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::verify_test {
namespace {

/// Of a case of cases/verify, as at the end of a run in which every tool bears the plies.
NoBand none_of(const std::string& name, const std::vector<Override>& overrides = {}) {
  const PreparedCase prepared = prepare_case(PLYFORM_CASES "/verify/" + name, overrides);
  EXPECT_TRUE(prepared.value) << name;
  Frame last;
  for (const BlankMesh& mesh : prepared.meshes) {
    PlyFrame& ply = last.plies.emplace_back();
    for (const Vec2& x : mesh.x)
      ply.x0.emplace_back(x.x(), x.y(), 0.0);
    ply.triangles = mesh.triangles;
  }
  last.tools.resize(prepared.value->tools.size());
  for (ToolFrame& tool : last.tools)
    tool.force = Vec3::UnitZ();
  return figures_without_band(*prepared.value, last);
}

TEST(NoBand, HasTheLargestCompressionWhereTheMeshDoesNotHoldIt) {
  for (const std::string& why : none_of("cup.toml").pressed)
    EXPECT_EQ(why, "");
  const Override sharp{"tool.1.points", "[[34, -80], [34, 0, 1], [160, 0]]"};
  for (const std::string& why : none_of("cup.toml", {sharp}).pressed)
    EXPECT_NE(why.find("die has a radius of 1 mm"), std::string::npos) << why;
  const Override stiff{"fabrics.two", "{surface_density=600, thickness=0.6, "
                                      "warp={density=0.25, stiffness=46000, "
                                      "in_plane_bending_stiffness=9.3}, "
                                      "weft={density=0.25, stiffness=46000, "
                                      "in_plane_bending_stiffness=9.3}, "
                                      "shear={polynomial=[1.5, 3.0, 3.0]}}"};
  const NoBand zones = none_of("cup.toml", {stiff});
  EXPECT_EQ(zones.pressed[0], "");
  EXPECT_NE(zones.pressed[1].find("zones of in-plane bending"), std::string::npos);
}

TEST(NoBand, ErrorsOfAMeshThatResolvesNotFallWithTheElementsAlone) {
  const PreparedCase cup = prepare_case(PLYFORM_CASES "/verify/cup.toml", {});
  EXPECT_TRUE(siblings_of(*cup.value, cup.meshes).resolved);
  const Override sharp{"tool.1.points", "[[34, -80], [34, 0, 1], [160, 0]]"};
  const PreparedCase edge = prepare_case(PLYFORM_CASES "/verify/cup.toml", {sharp});
  Siblings made = siblings_of(*edge.value, edge.meshes);
  EXPECT_FALSE(made.resolved);
  made.softening = 0.0;
  const auto at = [&](double h) { // 0.7 N and degrees at the run's own elements
    return end_with(1, 30.0 + 0.7 * h, 20.0, 100.0 + 0.7 * h);
  };
  for (const VerifiedFigure& f : verified_figures(
           at(1.0), {{Cause::inertia, at(1.0)}, {Cause::mesh, at(made.coarsening)}}, made, {})) {
    if (f.unit == "mm") continue;
    EXPECT_NEAR(f.mesh.value(), 0.7, 1e-9) << f.name;
  }
}

TEST(NoBand, SoDoThoseOfPliesThatAPressureOrAClosedMouldForms) {
  for (const char* name : {"closed_frustum.toml", "diaphragm_cap.toml"}) {
    const PreparedCase pressed = prepare_case(std::string(PLYFORM_CASES "/verify/") + name, {});
    EXPECT_FALSE(siblings_of(*pressed.value, pressed.meshes).resolved) << name;
  }
}

TEST(NoBand, HaveAGivenForceAndADrawInThatIsHeld) {
  const NoBand cup = none_of("cup.toml");
  EXPECT_EQ(cup.force, (std::vector<std::string>{"", "", "given: it is what pushes the tool"}));
  EXPECT_EQ(cup.draw_in, (std::vector<std::string>{"", ""}));
  const NoBand diaphragm = none_of("diaphragm_cap.toml"); // two plies between two membranes
  for (const std::size_t ply : {0u, 3u})
    EXPECT_NE(diaphragm.draw_in[ply], "") << ply;
  for (const std::size_t ply : {1u, 2u})
    EXPECT_EQ(diaphragm.draw_in[ply], "") << ply;
}

TEST(NoBand, HasAFigureThatItsBandWouldBeWiderThan) {
  VerifiedFigure f;
  f.unit = "N", f.force = true, f.value = -13.9;
  f.mesh = 10.0, f.inertia = f.softening = f.chance = 0.0;
  set_band(f);
  EXPECT_FALSE(f.band);
  EXPECT_NE(f.no_band.find("16 N"), std::string::npos) << f.no_band; // 1.65 times 10
  EXPECT_NEAR(width_of_band(f).value(), safety * 10.0, 1e-12);
  f.value = -17.0;
  set_band(f);
  EXPECT_NEAR(f.band.value(), safety * 10.0, 1e-12);
  EXPECT_EQ(f.no_band, "");
}

/// Punch, die and a holder that 1000 N push.
RunEnd pushed(double punch, double holder = 1000.0) {
  RunEnd end = end_with(2, 30.0, 20.0, punch);
  end.last.tools.resize(3);
  end.last.tools[1].name = "die", end.last.tools[1].force_N = -1000.0 - punch;
  end.last.tools[2].name = "holder", end.last.tools[2].force_N = holder;
  end.motions = {Motion::driven, Motion::fixed, Motion::force};
  end.no_band.force = {"", "", "given"};
  return end;
}

TEST(NoBand, AGivenForceCountsForNone) {
  Siblings made;
  made.softening = 0.0;
  const Ends siblings{{Cause::inertia, pushed(0.0)}, // has lost the punch's
                      {Cause::mesh, pushed(21.0, 900.0)},
                      {Cause::late_chance, pushed(20.0)}};
  const auto figures = verified_figures(pushed(20.0), siblings, made, {});
  EXPECT_NEAR(named(figures, "force of punch").inertia.value(), -20.0, 1e-12); // of q - 1 = 1
  const VerifiedFigure& holder = named(figures, "force of holder");
  EXPECT_EQ(holder.value, 1000.0);
  EXPECT_EQ(unmeasured(holder).size(), 4u);
  EXPECT_EQ(holder.no_band, "given");
}

TEST(NoBand, ADrawInThatIsHeldCountsForNone) {
  Siblings made;
  made.coarsening = 1.4;
  RunEnd run = end_with(2, 30.0, 20.0, 100.0);
  run.no_band.draw_in = {"", "held"};
  const auto figures =
      verified_figures(run, {{Cause::mesh, end_with(2, 30.0, 21.0, 100.0)}}, made, {});
  EXPECT_NEAR(named(figures, "draw-in of ply1").mesh.value(), 1.0 / (std::pow(1.4, 1.6) - 1.0),
              1e-9);
  EXPECT_FALSE(named(figures, "draw-in of ply2").mesh);
}

TEST(Bands, OfForcesAreNotBelowWhatTheyLackOfTheBalance) {
  RunEnd run = end_with(1, 30.0, 20.0, 100.0);
  run.balance_N = {98.0};
  const Ends siblings{{Cause::mesh, run}, {Cause::inertia, run}, {Cause::late_chance, run}};
  Siblings made;
  made.coarsening = 1.4, made.softening = 0.0;
  const VerifiedFigure f = named(verified_figures(run, siblings, made, {}), "force of punch");
  EXPECT_NEAR(f.band.value(), safety_of_jitter * 2.0, 1e-12);
}

} // namespace
} // namespace plyform::verify_test
