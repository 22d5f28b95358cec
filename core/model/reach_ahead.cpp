// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/reach_ahead.hpp"

#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plyform {
namespace {

constexpr double rise = 0.1;    // of a ply's larger side: how far it may bulge out of its way
constexpr double endless = 1e7; // mm, beyond all lengths of a case
constexpr double at_most = 1e5; // mm, from its origin, of a tool without bounds

/// Where a body is at the start, and by what it may be displaced, mm: `way` contains 0.
struct Body {
  Box3 box, way{Vec3::Zero(), Vec3::Zero()};
  Box3 swept() const { return {box.min() + way.min(), box.max() + way.max()}; }
};

Box3 grown(const Box3& box, double by) {
  const Vec3 all = Vec3::Constant(by);
  return {box.min() - all, box.max() + all};
}

/// Largest and least value of a stroke with its programme, 0 included.
std::pair<double, double> range_of(double stroke, const std::vector<Stage>& programme) {
  double low = std::min(stroke, 0.0), high = std::max(stroke, 0.0);
  for (const Stage& stage : programme)
    low = std::min(low, stage.value), high = std::max(high, stage.value);
  return {low, high};
}

void extend(Box3& way, double stroke, const std::vector<Stage>& programme, const Vec3& direction) {
  const auto [low, high] = range_of(stroke, programme);
  way.extend(low * direction), way.extend(high * direction);
}

double time_of(const Case& data) {
  return (1.0 + data.solver.dwell) * data.solver.duration;
}

Box3 box_in_space(const Tool& tool) {
  const Box3 own = box_of(tool.shape, at_most);
  Box3 box;
  if (own.isEmpty()) return {tool.position, tool.position};
  for (int corner = 0; corner < 8; ++corner)
    box.extend(tool.position + tool.rotation * own.corner(static_cast<Box3::CornerType>(corner)));
  return box;
}

Body body_of(const Case& data, const Tool& tool) {
  Body body{box_in_space(tool)};
  if (tool.motion == Motion::driven) extend(body.way, tool.stroke, tool.programme, tool.direction);
  if (tool.motion == Motion::force) body.way.extend(closing_speed * time_of(data) * tool.direction);
  return body;
}

/// The box of a flat ply; without an outline it is endless at its height.
Box3 box_of_ply(const Case& data, const Ply& ply) {
  Eigen::AlignedBox2d flat = plan_of(data, ply);
  if (flat.isEmpty()) flat = {Vec2::Constant(-endless), Vec2::Constant(endless)};
  const double half = 0.5 * data.fabrics[static_cast<std::size_t>(ply.fabric)].thickness;
  return {Vec3(flat.min().x(), flat.min().y(), ply.z - half),
          Vec3(flat.max().x(), flat.max().y(), ply.z + half)};
}

/// How far a ply may bulge out of its way, mm.
double bulge(const Body& ply) {
  return rise * ply.box.sizes().head<2>().maxCoeff();
}

/// How far a boundary may move the ply it holds, mm.
struct WayOf {
  const Case& data;
  const Body& ply;

  Box3 operator()(const SymmetryPlane&) const { return {Vec3::Zero(), Vec3::Zero()}; }
  Box3 operator()(const HingedFrame& frame) const {
    return grown({Vec3::Zero(), Vec3::Zero()}, std::abs(frame.stroke));
  }
  Box3 operator()(const Grip& grip) const {
    Box3 way{Vec3::Zero(), Vec3::Zero()};
    extend(way, grip.stroke, grip.programme, grip.direction);
    return way;
  }
  Box3 operator()(const Gripper& gripper) const { // by a force it goes where it can
    Box3 way{Vec3::Zero(), Vec3::Zero()};
    const bool drive = gripper.stiffness > 0.0;
    extend(way, drive ? gripper.stroke : ply.box.sizes().maxCoeff(),
           drive ? gripper.programme : std::vector<Stage>{}, gripper.direction);
    return way;
  }
  Box3 operator()(const TensionSpring& spring) const {
    Box3 way{Vec3::Zero(), Vec3::Zero()};
    way.extend(spring.anchor - ply.box.center());
    if (spring.carrier >= 0) {
      const Box3 tool = body_of(data, data.tools[at(spring.carrier)]).way;
      way.extend(spring.anchor - ply.box.center() + tool.min());
      way.extend(spring.anchor - ply.box.center() + tool.max());
    }
    return way;
  }
};

/// All bodies of a case, whose ways and stacks grow until nothing new is reached.
struct Bodies {
  explicit Bodies(const Case& data) : tools(), plies() {
    for (const Tool& tool : data.tools)
      tools.push_back(body_of(data, tool));
    const std::vector<Push> pushed = pushes(data);
    for (std::size_t p = 0; p < data.plies.size(); ++p) {
      Body body{box_of_ply(data, data.plies[p])};
      bool moves = false;
      for (const Push& push : pushed) {
        if (push.ply != p) continue;
        moves = true;
        body.way.extend(push.way);
      }
      for (const Boundary& b : data.boundaries) {
        if (b.ply != -1 && b.ply != static_cast<int>(p)) continue;
        moves = true;
        body.way.extend(std::visit(WayOf{data, body}, b.kind));
      }
      plies.push_back(body);
      found.ply_moves.push_back(moves);
      found.stack.push_back(static_cast<int>(p));
    }
    found.tool_reaches.assign(data.tools.size(), 0);
  }

  /// What a tool meets, it moves; and what pushes it may be pushed back. Whether that is new.
  bool reach_by_tools(const Case& data) {
    bool news = false;
    for (std::size_t t = 0; t < tools.size(); ++t)
      for (std::size_t p = 0; p < plies.size(); ++p) {
        Body &tool = tools[t], &ply = plies[p];
        if (!grown(ply.swept(), bulge(ply)).intersects(tool.swept())) continue;
        news |= raise(found.tool_reaches[t]);
        if (data.tools[t].motion == Motion::fixed) continue;
        news |= raise(found.ply_moves[p]) | extended(ply.way, tool.way);
        if (data.tools[t].motion == Motion::force) news |= extended(tool.way, ply.way);
      }
    return news;
  }

  /// Plies that meet are one stack, and move alike. Whether that is new.
  bool reach_by_plies() {
    bool news = false;
    for (std::size_t a = 0; a < plies.size(); ++a)
      for (std::size_t b = a + 1; b < plies.size(); ++b) {
        Body &one = plies[a], &other = plies[b];
        const double by = std::max(bulge(one), bulge(other));
        if (!grown(one.swept(), by).intersects(other.swept())) continue;
        news |= extended(one.way, other.way) | extended(other.way, one.way);
        char &first = found.ply_moves[a], &second = found.ply_moves[b];
        if (first || second) news |= raise(first) | raise(second);
        int &low = found.stack[a], &high = found.stack[b];
        news |= low != high;
        low = high = std::min(low, high);
      }
    return news;
  }

  std::vector<Body> tools, plies;
  ReachAhead found;

private:
  static bool raise(char& flag) { return std::exchange(flag, 1) == 0; }
  static bool extended(Box3& way, const Box3& by) {
    const Box3 before = way;
    way.extend(by);
    return !way.isApprox(before, 0.0);
  }
};

} // namespace

Eigen::AlignedBox2d plan_of(const Case& data, const Ply& ply) {
  Eigen::AlignedBox2d flat;
  const auto known = static_cast<std::size_t>(ply.blank) < data.blanks.size();
  const Outline outline =
      known ? data.blanks[static_cast<std::size_t>(ply.blank)].outline : Outline{};
  const Eigen::Rotation2Dd turn(ply.rotation);
  for (const Vec2& x : outline.boundary)
    flat.extend(ply.seed + turn * x);
  for (const OutlineArc& arc : outline.arcs) {
    if (arc.hole >= 0) continue;
    const Vec2 round =
        Vec2::Constant((outline.boundary[arc.side % outline.boundary.size()] - arc.centre).norm());
    const Vec2 centre = ply.seed + turn * arc.centre;
    flat.extend(centre - round), flat.extend(centre + round);
  }
  return flat;
}

int ReachAhead::plies_in_stack(std::size_t ply) const {
  return static_cast<int>(std::count(stack.begin(), stack.end(), stack[ply]));
}

int ReachAhead::largest_stack() const {
  const bool none = std::find(ply_moves.begin(), ply_moves.end(), 1) == ply_moves.end();
  int most = 0;
  for (std::size_t p = 0; p < stack.size(); ++p)
    if (none || ply_moves[p]) most = std::max(most, plies_in_stack(p));
  return most;
}

ReachAhead reach_ahead(const Case& data) {
  Bodies bodies(data);
  bool news = true;
  while (news)
    news = bodies.reach_by_tools(data) | bodies.reach_by_plies();
  return bodies.found;
}

Case taking_part(const Case& data) {
  const ReachAhead ahead = reach_ahead(data);
  Case part = data;
  if (std::find(ahead.ply_moves.begin(), ahead.ply_moves.end(), 1) == ahead.ply_moves.end())
    return part;
  keep_plies(part, ahead.ply_moves);
  part.tools.clear();
  for (std::size_t t = 0; t < data.tools.size(); ++t)
    if (ahead.tool_reaches[t]) part.tools.push_back(data.tools[t]);
  return part;
}

} // namespace plyform
