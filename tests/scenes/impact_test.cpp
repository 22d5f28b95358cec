// SPDX-License-Identifier: GPL-3.0-or-later
// Blows: whatever meets at high speed either bears it or ends the run by name. Nothing passes
// through anything unnoticed.
#include "support/passing_checks.hpp"
#include "support/stress_scenes.hpp"
#include "support/thread_checks.hpp"

namespace plyform::impact_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What was seen of a run at its output times.
struct Seen {
  bool upright = true;       ///< no ply overhangs: heights tell which is above
  double gap = infinity;     ///< mm, least, between plies
  double lowest = infinity;  ///< mm, height of a node
  double outside = infinity; ///< mm, least distance of a node to a tool
  std::size_t crossings = 0; ///< pairs of triangles
};

/// Runs a scene and looks at it from outside; tools are asked where the frame says they are.
EndedRun watch(const std::function<Scene()>& make, Seen& seen) {
  const std::vector<Tool> tools = make().data.tools;
  RunHooks hooks;
  hooks.frame = [&](const Frame& f) {
    if (seen.upright) seen.gap = std::min(seen.gap, least_gap(f));
    seen.crossings += crossings(f);
    for (const PlyFrame& ply : f.plies)
      for (const Vec3& x : ply.x)
        if (!(x.z() >= seen.lowest)) seen.lowest = x.z();
    for (std::size_t t = 0; t < tools.size(); ++t)
      for (const PlyFrame& ply : f.plies)
        for (const Vec3& x : ply.x) {
          SurfaceHint hint;
          const Vec3 p =
              tools[t].rotation.transpose() * (x - tools[t].position - f.tools[t].displacement);
          const double d = signed_distance(tools[t].shape, p, hint).distance;
          if (!(d >= seen.outside)) seen.outside = d;
        }
  };
  return run_on_any_threads(make, hooks);
}

/// What central differences leave open in the ledger of one blow, relative to its energy. In the
/// step that closes a gap force goes from 0 to k p over a way dp of which the spring sees p: the
/// ledger misses k p (dp - p)/2 <= k dp^2/8, of m v^2/2: (omega dt)^2/4, omega^2 = k/m; the same
/// again, less the damping, in the step that opens it. A gap closes by no more than half of the
/// room in one step, where the force is 1.8 times k p.
double of_one_blow(const Scene& s) {
  double worst = 0.0;
  const auto add = [&](const ContactLaw& law, double density) {
    const double half = 0.5 * law.max_depth, k = law.pressure(half) / half;
    worst = std::max(worst, 0.25 * k * s.max_dt * s.max_dt / density);
  };
  for (const ToolState& tool : s.tools)
    add(tool.contacts[0].law, s.plies[0].membrane.fabric.surface_density);
  each_pass(s, [&](const PlyContact& pass) { // both ways, against the mass of both in series
    add(pass.contact.law, 0.25 * s.plies[0].membrane.fabric.surface_density);
  });
  return worst;
}

/// The same of tools pushed by a force, N mm: it comes into action in the step in which the tool
/// arrives, of which the ledger gives the plies half, F dx/2.
double of_arriving_tools(const Scene& s) {
  double sum = 0.0;
  for (const ToolState& tool : s.tools)
    sum += 0.5 * tool.force_on * tool.body.max_approach_speed * s.max_dt;
  return sum;
}

/// Done, or stopped by a message that has all of `names` in it; no node goes half a thickness into
/// a tool or through a ply; the ledger is closed.
void expect_sound(const EndedRun& run, const Seen& seen, const std::vector<std::string>& names,
                  const std::string& what) {
  const Summary& s = run.result.summary;
  const Energies& e = run.result.last.energy;
  const double error = imbalance(e);
  const double allowed = 0.01 + of_one_blow(run.scene) +
                         of_arriving_tools(run.scene) / std::max(std::abs(e.external), 1e-9);
  fmt::print("{}: {}; gap {:.3g}, outside {:.3g} mm, balance {:.1e} of {:.1e}, {:.2f} s {}\n", what,
             s.status, seen.gap, seen.outside, error, allowed, s.wall_time_s, s.message);
  EXPECT_EQ(seen.crossings, 0u) << what;
  EXPECT_LE(error, allowed) << what;
  EXPECT_GT(seen.gap, 0.0) << what;
  EXPECT_GE(seen.outside, -0.3) << what;
  if (ended(s.status)) return;
  EXPECT_EQ(s.status, "stopped") << what;
  for (const std::string& name : names)
    EXPECT_NE(s.message.find(name), std::string::npos) << what << ": " << s.message;
}

constexpr double speeds[] = {5e3, 2e4, 5e4, 5e5}; // mm/s

Case stack_in_the_air(int plies) {
  Case data = stack_of(std::vector<double>(static_cast<std::size_t>(plies), 0.0),
                       rectangle(60.0, 60.0, 10.0));
  data.plies.back().z = 15.0;
  data.solver.fibre_softening = 100.0;
  data.solver.outputs = 50;
  return data;
}

/// Turns a flat ply about y through its middle and gives it a velocity.
void throw_ply(PlyBody& ply, const Vec3& velocity, double tilt) {
  const Eigen::AngleAxisd turn(tilt, Vec3::UnitY());
  const Vec3 middle = ply.x0.front().z() * Vec3::UnitZ();
  for (Vec3& x : ply.x)
    x = middle + turn * Vec3(x - middle);
  ply.x0 = ply.x_search = ply.x;
  ply.velocity.assign(ply.x.size(), velocity);
}

/// A ply of 60 mm falls flat, or tilted by 17 degrees, on a plate as thick as a tool and on one
/// thinner than the ply. Up to 50 m/s the plate bears it, though the way of a stable step (0.9 mm)
/// is then longer than the ply is thick: steps get shorter. At 500 m/s it is borne, or that is
/// said.
TEST(Impact, PlyThrownAtAPlateIsBorneOrNamed) {
  for (const double thickness : {10.0, 0.3})
    for (const double tilt : {0.0, 0.3})
      for (const double speed : speeds) {
        Seen seen;
        const EndedRun run = watch(
            [&] {
              Case data = stack_in_the_air(1);
              Tool plate;
              plate.name = "plate";
              plate.shape = Box{{200.0, 200.0, thickness}};
              plate.position = {0.0, 0.0, -0.5 * thickness};
              data.tools = {plate};
              set_friction(data, 0.2);
              data.solver.duration = 60.0 / speed;
              Scene s = make_scene(data);
              throw_ply(s.plies[0], {0.2 * speed, 0.0, -speed}, tilt);
              return s;
            },
            seen);
        const std::string what =
            fmt::format("plate of {} mm, tilt {}, {} m/s", thickness, tilt, 1e-3 * speed);
        expect_sound(run, seen, {"ply ply1", "node ", "tool plate"}, what);
        EXPECT_GE(seen.lowest, -0.3) << what; // no deeper than half a thickness, and not below
        EXPECT_TRUE(speed > 1e5 || ended(run.result.summary.status)) << what;
      }
}

/// The same with a second ply in the place of the plate.
TEST(Impact, PlyThrownAtAPlyIsBorneOrNamed) {
  for (const double tilt : {0.0, 0.3})
    for (const double speed : speeds) {
      Seen seen;
      const EndedRun run = watch(
          [&] {
            Case data = stack_in_the_air(2);
            set_friction(data, 0.2);
            data.solver.duration = 60.0 / speed;
            Scene s = make_scene(data);
            throw_ply(s.plies[1], {0.2 * speed, 0.0, -speed}, tilt);
            return s;
          },
          seen);
      const std::string what = fmt::format("ply at ply, tilt {}, {} m/s", tilt, 1e-3 * speed);
      expect_sound(run, seen, {"ply ply1", "ply ply2", "node ", "triangle "}, what);
      EXPECT_TRUE(speed > 1e5 || ended(run.result.summary.status)) << what;
    }
}

/// The punch of a coarse hemisphere at ten times its speed, 14 m/s at most, through one ply and
/// two.
TEST(Impact, PunchAtTenTimesItsSpeed) {
  for (const int plies : {1, 2}) {
    Seen seen;
    seen.upright = false;
    const EndedRun run = watch(
        [&] {
          Case data = coarse_hemisphere(std::vector<double>(static_cast<std::size_t>(plies), 0.0));
          data.solver.duration = 0.01;
          data.solver.outputs = 10;
          return make_scene(data);
        },
        seen);
    expect_sound(run, seen, {"ply ply", "node "}, fmt::format("{} plies", plies));
  }
}

/// Three plies that start `deep` thicknesses in each other, and a tenth in the floor.
EndedRun start_deep(double deep, Seen& seen) {
  return watch(
      [deep] {
        Case data = stack_of({0.0, 0.5, 0.0}, rectangle(60.0, 60.0, 10.0));
        press_by_plate(data);
        data.tools.resize(1);
        set_friction(data, 0.2);
        for (std::size_t p = 0; p < 3; ++p)
          data.plies[p].z = 0.6 * (0.5 + (1.0 - deep) * static_cast<double>(p)) - 0.06;
        data.solver.duration = 0.005;
        data.solver.outputs = 50;
        return make_scene(data);
      },
      seen);
}

/// They come apart as far as contact has room, a quarter of a thickness; what is deeper is named.
TEST(Impact, PliesThatStartDeepInEachOtherComeApart) {
  Seen seen;
  const EndedRun run = start_deep(0.2, seen);
  expect_sound(run, seen, {}, "deep start");
  EXPECT_TRUE(ended(run.result.summary.status));
  EXPECT_GT(seen.gap, 0.8 * 0.6 - 1e-9);
  EXPECT_GT(least_gap(run.result.last), 0.55);
  Seen too_deep;
  const EndedRun stopped = start_deep(0.3, too_deep);
  EXPECT_EQ(stopped.result.summary.status, "stopped");
  expect_sound(stopped, too_deep, {"ply ply1", "ply ply2", "node "}, "too deep a start");
}

/// A plate pushed by 30 N, 10 mm above two plies on a floor: it comes down at its closing speed.
TEST(Impact, PlateDroppedFromTenMillimetres) {
  Seen seen;
  const EndedRun run = watch(
      [] {
        Case data = stack_of({0.0, 0.5}, rectangle(100.0, 100.0, 12.5));
        press_by_plate(data);
        data.tools[1].position.z() += 10.0;
        data.solver.duration = 0.04;
        return make_scene(data);
      },
      seen);
  expect_sound(run, seen, {}, "dropped plate");
  EXPECT_TRUE(ended(run.result.summary.status));
  EXPECT_NEAR(run.result.last.tools[0].force.z(), -30.0, 0.02 * 30.0);
}

} // namespace
} // namespace plyform::impact_test
