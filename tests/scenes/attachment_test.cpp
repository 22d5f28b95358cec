// SPDX-License-Identifier: GPL-3.0-or-later
// Strips pulled by springs and grippers, against what their stiffnesses in series and Coulomb's
// friction give. The strip has its warp along x, EA = yarns per width * width * stiffness.
#include "core/model/motion.hpp"
#include "core/setup/boundaries_ahead.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/solver/attached_motion.hpp"
#include "core/solver/stable_time_step.hpp"
#include "core/solver/step.hpp"
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

#include <cmath>
#include <type_traits>

namespace plyform::attachment_test {
namespace {

constexpr double length = 100.0, width = 20.0; // mm
constexpr double softening = 200.0;

/// 100 x 20 mm, free, at rest long before the end.
Case free_strip(double size) {
  Case data = stack_of({0.0}, rectangle(length, width, size));
  set_friction(data, 0.0);
  data.solver.fibre_softening = softening;
  data.solver.mass_damping = 1000.0; // 1/s
  data.solver.duration = 0.05;
  return data;
}

/// N per strain, of the whole width.
double strip_stiffness(const Case& data) {
  const Fabric& fabric = data.fabrics[0];
  return fabric.families[0].density * width * fabric.families[0].tension.stiffness / softening;
}

template <class Kind>
Boundary at_end(double x, double stiffness) {
  Kind kind;
  kind.place = {true, {Vec2(x, -0.5 * width), Vec2(x, 0.5 * width)}};
  kind.stiffness = stiffness;
  if constexpr (std::is_same_v<Kind, Gripper>)
    kind.direction = Vec3(x < 0.0 ? -1.0 : 1.0, 0.0, 0.0);
  else
    kind.anchor = Vec3(x < 0.0 ? x - 40.0 : x + 40.0, 0.0, 0.3);
  return {x < 0.0 ? "left" : "right", -1, kind};
}

const BoundaryFrame& named(const Frame& f, const std::string& name) {
  for (const BoundaryFrame& b : f.boundaries)
    if (b.name == name) return b;
  throw std::runtime_error("no boundary " + name);
}

RunResult run_on_two(const Case& data) {
  const EndedRun run = run_on_any_threads([&] { return make_scene(data); });
  EXPECT_EQ(run.result.summary.status, "done") << run.result.summary.message;
  EXPECT_LT(std::abs(run.result.last.energy.balance_error()), 0.01);
  return run.result;
}

TEST(Attachments, ForceOfASpringAndADriveInSeriesWithTheStrip) {
  for (const double size : {10.0, 5.0}) {
    Case data = free_strip(size);
    data.boundaries = {at_end<TensionSpring>(-50.0, 2.0), at_end<Gripper>(50.0, 5.0)};
    data.boundaries[1].as<Gripper>().stroke = 8.0;
    const RunResult run = run_on_two(data);
    const double in_series = 1.0 / (1.0 / 2.0 + 1.0 / 5.0 + length / strip_stiffness(data));
    const double wanted = in_series * 8.0;
    const BoundaryFrame &spring = named(run.last, "left"), &gripper = named(run.last, "right");
    fmt::print("cells of {} mm: {:.4f} and {:.4f} N for {:.4f} N\n", size, spring.force_N,
               gripper.force_N, wanted);
    EXPECT_NEAR(spring.force_N, wanted, 0.01 * wanted);
    EXPECT_NEAR(gripper.force_N, wanted, 0.01 * wanted);
    EXPECT_NEAR(spring.stroke_mm, wanted / 2.0, 0.01 * wanted / 2.0);
    EXPECT_NEAR(gripper.stroke_mm, 8.0 - wanted / 5.0, 0.01 * 8.0);
    EXPECT_NEAR((spring.force + Vec3(spring.force_N, 0.0, 0.0)).norm(), 0.0, 0.01 * wanted);
  }
}

TEST(Attachments, GripperUnderAForceGoesAsFarAsSpringAndStripGiveWay) {
  Case data = free_strip(10.0);
  data.boundaries = {at_end<TensionSpring>(-50.0, 2.0), at_end<Gripper>(50.0, 0.0)};
  data.boundaries[0].as<TensionSpring>().preload = 3.0;
  data.boundaries[1].as<Gripper>().force = 10.0;
  data.boundaries[1].as<Gripper>().programme = {{0.1, 3.0}, {0.5, 10.0}};
  data.boundaries[1].as<Gripper>().mass = 1e-6; // t: of its own, as much as four strips have
  const RunResult run = run_on_two(data);
  const BoundaryFrame &spring = named(run.last, "left"), &gripper = named(run.last, "right");
  const double gone = (10.0 - 3.0) / 2.0, longer = 10.0 * length / strip_stiffness(data);
  EXPECT_NEAR(spring.force_N, 10.0, 0.1);
  EXPECT_NEAR(gripper.force_N, 10.0, 0.1);
  EXPECT_NEAR(spring.stroke_mm, gone, 0.01 * gone);
  EXPECT_NEAR(gripper.stroke_mm, gone + longer, 0.01 * (gone + longer));
}

TEST(Attachments, GripperThatThrowsAPlyIsDoubtful) {
  Case data = free_strip(10.0);
  data.solver.mass_damping = 0.0;
  data.boundaries = {at_end<TensionSpring>(-50.0, 0.01), // some 0.1 N against 10
                     at_end<Gripper>(50.0, 0.0)};
  data.boundaries[1].as<Gripper>().force = 10.0;
  data.solver.duration = 0.005;
  const RunResult run = run_case(data, 1, {});
  EXPECT_EQ(run.summary.status, "doubtful");
  EXPECT_NE(run.summary.message.find("do not trust the way of right"), std::string::npos)
      << run.summary.message;
}

/// Four segments of a blank-holder on the flange of two plies, each under a force of its own.
TEST(Attachments, FourHoldersPressWithTheirOwnForces) {
  const double forces[] = {40.0, 120.0, 75.0, 60.0};
  std::vector<Override> changes{{"blanks.square.element_size", "13.0"},
                                {"solver.duration", "0.05"},
                                {"tool.0.stroke", "20.0"}};
  for (int k = 0; k < 4; ++k)
    changes.emplace_back(fmt::format("tool.{}.force", 5 + k), fmt::format("{}", forces[k]));
  const PreparedCase reading =
      prepare_case(std::string(PLYFORM_CASES) + "/square_box/case.toml", changes);
  ASSERT_TRUE(reading.value);
  const RunResult run = run_case(*reading.value, 1, {}, reading.meshes);
  EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01);
  Vec3 sum = Vec3::Zero();
  for (const ToolFrame& tool : run.last.tools)
    sum += tool.force;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(run.last.tools[5 + k].force_N, forces[k], 0.01 * forces[k]) << k;
    // in the plane what moves below it drags it along by friction, no more
    EXPECT_LE(run.last.tools[5 + k].force.head<2>().norm(), 0.2 * forces[k] * 1.01) << k;
  }
  const double punch = run.last.tools[0].force_N;
  EXPECT_GT(punch, 50.0);
  EXPECT_LT(sum.norm(), 0.02 * punch); // die and holders bear the punch
  fmt::print(
      "punch {:.2f} N, holders {:.2f}, {:.2f}, {:.2f}, {:.2f} N, sum of all ({:.3f}, {:.3f}, "
      "{:.3f}) N, balance {:.1e}\n",
      punch, run.last.tools[5].force_N, run.last.tools[6].force_N, run.last.tools[7].force_N,
      run.last.tools[8].force_N, sum.x(), sum.y(), sum.z(), run.last.energy.balance_error());
}

TEST(Attachments, SpringAtItsLimitGivesWayAtThatForce) {
  Case data = free_strip(10.0);
  data.boundaries = {at_end<TensionSpring>(-50.0, 2.0), at_end<Gripper>(50.0, 5.0)};
  data.boundaries[0].as<TensionSpring>().max_force = 4.0;
  data.boundaries[1].as<Gripper>().stroke = 8.0;
  const RunResult run = run_on_two(data);
  EXPECT_NEAR(named(run.last, "left").force_N, 4.0, 1e-9);
  EXPECT_NEAR(named(run.last, "right").force_N, 4.0, 0.04);
  const double longer = 4.0 * length / strip_stiffness(data);
  EXPECT_NEAR(named(run.last, "left").stroke_mm, 8.0 - 4.0 / 5.0 - longer, 0.08);
}

TEST(Attachments, SpringsTurnTowardsTheirAnchors) {
  // Two springs of 1 N/mm and 30 mm at right angles to each other, preloaded, on one end; a grip
  // holds the other.
  Case data = free_strip(10.0);
  data.boundaries = {at_end<TensionSpring>(50.0, 1.0), at_end<TensionSpring>(50.0, 1.0)};
  data.boundaries[1].name = "other";
  for (int k = 0; k < 2; ++k) {
    auto& spring = data.boundaries[k].as<TensionSpring>();
    spring.anchor = {50.0 + 30.0 * M_SQRT1_2, (k == 0 ? 30.0 : -30.0) * M_SQRT1_2, 0.3};
    spring.preload = 5.0;
  }
  data.boundaries.push_back(hold("grip", {-50, -10}, {-50, 10}, -Vec3::UnitX(), 0.0));
  const RunResult run = run_on_two(data);
  const double held = named(run.last, "grip").force_N;
  const BoundaryFrame &one = named(run.last, "right"), &other = named(run.last, "other");
  // both anchors lie 30/sqrt(2) mm before and beside the end, which comes nearer by what the strip
  // gets longer
  const double beside = 30.0 * M_SQRT1_2;
  const double before = beside - held * length / strip_stiffness(data);
  const double now = std::hypot(before, beside), e = 2.0 * (5.0 + now - 30.0) * before / now;
  EXPECT_LT(one.stroke_mm, 0.0); // the strip is longer, the springs shorter
  EXPECT_NEAR(held, e, 0.01 * e);
  EXPECT_NEAR(one.force_N, 5.0 + one.stroke_mm, 1e-9);
  EXPECT_NEAR((one.force + other.force).y(), 0.0, 0.01);
  EXPECT_GT(one.force.y(), 2.0);
}

TEST(Attachments, CarriedAnchorMovesWithItsTool) {
  Case data = free_strip(10.0);
  Tool cart;
  cart.name = "cart";
  cart.shape = Box{{10.0, 10.0, 10.0}};
  cart.position = {200.0, 0.0, 0.0};
  cart.motion = Motion::driven;
  cart.direction = Vec3::UnitX();
  cart.stroke = 6.0;
  data.tools = {cart};
  set_friction(data, 0.0);
  data.boundaries = {at_end<TensionSpring>(-50.0, 2.0), at_end<TensionSpring>(50.0, 2.0)};
  data.boundaries[1].as<TensionSpring>().carrier = 0;
  const RunResult run = run_on_two(data);
  const double wanted = 6.0 / (1.0 / 2.0 + 1.0 / 2.0 + length / strip_stiffness(data));
  EXPECT_NEAR(named(run.last, "left").force_N, wanted, 0.01 * wanted);
  EXPECT_NEAR(named(run.last, "right").force_N, wanted, 0.01 * wanted);
}

TEST(Attachments, GripperMovesItsNodesAsOnePiece) {
  Case data = free_strip(5.0);
  data.boundaries = {hold("grip", {-50, -10}, {-50, 10}, Vec3::UnitX(), 0.0),
                     at_end<Gripper>(50.0, 0.0)};
  auto& gripper = data.boundaries[1].as<Gripper>();
  gripper.place = {false, {Vec2(30.0, -3.0), Vec2(50.0, 10.0)}}; // the strip would turn there
  gripper.force = 5.0;
  gripper.direction = Vec3(0.8, 0.6, 0.0);
  for (const bool guided : {false, true}) {
    gripper.guided = guided;
    const EndedRun run = run_on_any_threads([&] { return make_scene(data); });
    const PlyBody& ply = run.scene.plies[0];
    const std::vector<AttachedNode>& nodes = run.scene.attachments.at(0).nodes;
    ASSERT_GT(nodes.size(), 10u);
    const Vec3 gone = ply.x[nodes[0].node] - ply.x0[nodes[0].node];
    EXPECT_GT(gone.norm(), 0.1);
    for (const AttachedNode& node : nodes)
      EXPECT_LT((ply.x[node.node] - ply.x0[node.node] - gone).norm(), 1e-10);
    const Vec3 sideways = gone - gone.dot(gripper.direction) * gripper.direction;
    if (guided)
      EXPECT_LT(sideways.norm(), 1e-9);
    else
      EXPECT_GT(sideways.norm(), 0.1);
  }
}

TEST(Attachments, StiffSpringsAndDrivesAreInTheStableStep) {
  for (const bool spring : {true, false}) {
    Case data = free_strip(10.0);
    data.solver.step_factor = 0.95;
    data.solver.mass_scaling = data.solver.mass_damping = data.solver.fibre_damping = 0.0;
    data.solver.duration = 0.002;
    data.boundaries = {hold("grip", {-50, -10}, {-50, 10}, Vec3::UnitX(), 0.0),
                       spring ? at_end<TensionSpring>(50.0, 0.0) : at_end<Gripper>(50.0, 0.0)};
    Boundary& puller = data.boundaries[1];
    double steps[2] = {0.0, 0.0};
    for (int stiff = 0; stiff < 2; ++stiff) {
      const double stiffness = stiff == 1 ? 1e5 : 1e-6;
      if (spring)
        puller.as<TensionSpring>().stiffness = stiffness,
        puller.as<TensionSpring>().preload = 0.1 * stiffness;
      else
        puller.as<Gripper>().stiffness = stiffness, puller.as<Gripper>().stroke = 0.1;
      Scene s = make_scene(data);
      double mass = 0.0, least = 1.0; // t, of the nodes; the lightest over its share
      for (const AttachedNode& node : s.attachments[0].nodes)
        mass += s.plies[0].mass[node.node];
      ThreadPool pool(1);
      start(s, pool);
      steps[stiff] = s.next_dt / data.solver.step_factor;
      const std::vector<std::string> said = boundaries_ahead(s);
      EXPECT_EQ(said.size(), stiff == 1 ? 3u : 2u); // two boundaries, and the warning
      EXPECT_EQ(said.back().find("shorten the step") != std::string::npos, stiff == 1);
      if (stiff == 0) continue;
      // As one piece, or with every node by its share: both have mass/k, as shares follow masses.
      least = 2.0 * std::sqrt(mass / stiffness);
      EXPECT_LE(steps[1], least * 1.0001);
      EXPECT_GT(steps[1], 0.5 * least);
      const RunResult run = run_scene(s, 1, {});
      // unstable: the balance fails; it swings still, so that a word of that may be said
      EXPECT_TRUE(ended(run.summary.status)) << run.summary.message;
      EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.02);
    }
    EXPECT_LT(steps[1], 0.5 * steps[0]);
  }
}

/// Minus the gradient of 1/2 k (l - ln)^2, and no more of it than the stable step reckons with.
TEST(Attachments, PullOfASpringIsTheGradientOfItsEnergy) {
  Case data = free_strip(10.0);
  data.boundaries = {at_end<TensionSpring>(50.0, 2.0)};
  auto& spring = data.boundaries[0].as<TensionSpring>();
  spring.anchor = {80.0, 20.0, 15.0};
  spring.preload = 7.0;
  data.solver.duration = 1e-9; // the preload has come up
  Scene s = make_scene(data);
  s.time = 1.0;
  PlyBody& ply = s.plies[0];
  const Attachment& attached = s.attachments.at(0);
  Random random(3);
  std::vector<std::vector<Vec3>> y(1, std::vector<Vec3>(ply.x.size(), Vec3::Zero()));
  for (const AttachedNode& node : attached.nodes) {
    ply.x[node.node] += random_vector(random);
    y[0][node.node] = random_vector(random);
  }
  const auto energy = [&] {
    Vec3 way = spring.anchor;
    for (const AttachedNode& node : attached.nodes)
      way -= node.share * ply.x[node.node];
    return 0.5 * spring.stiffness * std::pow(way.norm() - attached.natural_length, 2);
  };
  const auto pulls_at = [&](double step) {
    for (const AttachedNode& node : attached.nodes)
      ply.x[node.node] += step * y[0][node.node];
    pull_springs(s, s, s.tools);
    return std::pair{energy(), ply.pull};
  };
  constexpr double h = 1e-5;
  pull_springs(s, s, s.tools);
  const std::vector<Vec3> here = ply.pull;
  const auto [after, pull_after] = pulls_at(h);
  const auto [before, pull_before] = pulls_at(-2.0 * h);
  double work = 0.0, curvature = 0.0, reckoned = 0.0;
  std::vector<std::vector<Vec3>> f(1, std::vector<Vec3>(ply.x.size(), Vec3::Zero()));
  add_attachment_forces(s, s, 1.0, y, f);
  for (const AttachedNode& node : attached.nodes) {
    const Vec3& direction = y[0][node.node];
    work += here[node.node].dot(direction);
    curvature -= (pull_after[node.node] - pull_before[node.node]).dot(direction) / (2.0 * h);
    reckoned += f[0][node.node].dot(direction);
  }
  ASSERT_GT(std::abs(work), 0.1);
  EXPECT_NEAR(-(after - before) / (2.0 * h), work, 1e-6 * std::abs(work));
  EXPECT_GT(curvature, 0.0);
  EXPECT_LE(curvature, reckoned * (1.0 + 1e-9));
  EXPECT_GT(curvature, 0.1 * reckoned);
}

TEST(Attachments, HalfAGripperOnAPlaneOfSymmetryIsHalfTheWhole) {
  const auto pulled = [](bool half) {
    Case data = free_strip(10.0);
    if (half) data.blanks[0].outline.boundary = {{-50, 0}, {50, 0}, {50, 10}, {-50, 10}};
    data.boundaries = {at_end<TensionSpring>(-50.0, half ? 1.0 : 2.0),
                       at_end<Gripper>(50.0, half ? 2.5 : 5.0)};
    data.boundaries[1].as<Gripper>().stroke = 8.0;
    if (half) {
      data.boundaries[0].as<TensionSpring>().anchor.y() = 5.0; // before the middle of the half edge
      data.boundaries.push_back({"plane", -1, SymmetryPlane{Vec2::Zero(), Vec2::UnitY()}});
    }
    return run_on_two(data);
  };
  const RunResult whole = pulled(false), half = pulled(true);
  for (const char* name : {"left", "right"}) {
    const double wanted = 0.5 * named(whole.last, name).force_N;
    EXPECT_NEAR(named(half.last, name).force_N, wanted, 1e-3 * wanted) << name;
  }
}

/// The shipped case: at each output, from when all of the strip slides, the pull of the grippers is
/// that of the springs and of friction on both faces under each holder.
TEST(Attachments, DrawOfTheShippedCaseFollowsHoldersAndSprings) {
  const PreparedCase reading =
      prepare_case(std::string(PLYFORM_CASES) + "/springs_and_grippers/case.toml", {});
  for (const CaseError& error : reading.errors)
    ADD_FAILURE() << error.text();
  ASSERT_TRUE(reading.value);
  const Case& data = *reading.value;
  const double mu = data.friction(0, 1);
  ASSERT_GT(mu, 0.0);
  RunHooks hooks;
  int judged = 0;
  hooks.frame = [&](const Frame& f) {
    const BoundaryFrame &south = named(f, "spring_south"), &north = named(f, "spring_north");
    if (south.stroke_mm < 1.5) return; // mm: sticks, or still swings from having come loose
    ++judged;
    // N: of the preload and of how much longer the springs are; one gives way at its limit
    const auto &a = data.boundaries[0].as<TensionSpring>(),
               &b = data.boundaries[1].as<TensionSpring>();
    const double first = a.preload + a.stiffness * south.stroke_mm;
    const double second = std::min(b.preload + b.stiffness * north.stroke_mm, b.max_force);
    EXPECT_NEAR(south.force_N, first, 1e-6 * first);
    EXPECT_NEAR(north.force_N, second, 1e-6 * second);
    double pressed = 0.0;
    for (const Tool& tool : data.tools)
      if (tool.motion == Motion::force) pressed += motion_at(tool, f.time, data.solver.duration);
    const double wanted = 2.0 * mu * pressed + first + second;
    const double pull = named(f, "gripper_south").force_N + named(f, "gripper_north").force_N;
    fmt::print("{:.4f} s, drawn {:6.3f} mm: {:.3f} N for {:.3f} N ({:+.3f} %)\n", f.time,
               south.stroke_mm, pull, wanted, 100.0 * (pull / wanted - 1.0));
    EXPECT_NEAR(pull, wanted, 0.01 * wanted) << f.time;
  };
  Scene scene = make_scene(data, reading.meshes);
  const RunResult run = run_scene(scene, 1, hooks);
  EXPECT_EQ(run.summary.status, "done") << run.summary.message;
  EXPECT_LT(std::abs(run.last.energy.balance_error()), 0.01);
  EXPECT_GT(judged, 10);
  fmt::print("energy balance {:.2e}, {} steps, {:.1f} s\n", run.last.energy.balance_error(),
             run.summary.steps, run.summary.wall_time_s);
}

} // namespace
} // namespace plyform::attachment_test
