// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/scene_preview.hpp"

#include "base/format.hpp"
#include "base/thread_pool.hpp"
#include "core/input/keys/choices.hpp"
#include "core/input/keys/schema.hpp"
#include "core/model/boundary.hpp"
#include "core/model/motion.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/setup/preview_plies.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <span>

namespace plyform {
namespace {

/// Keys of a tool that a picture of it as it stands does without.
const std::vector<std::string> motion_keys = {"motion", "stroke",    "stroke_programme", "force",
                                              "mass",   "direction", "force_programme",  "name"};

struct Preview {
  const CaseReading& reading;
  const Case& data;
  ScenePreview& seen;
  std::vector<FlatPly> flat{};       ///< of the plies that can be drawn
  std::vector<std::size_t> number{}; ///< their numbers

  /// Keys with mistakes of the part number i of a list. Those that do not exist do no harm.
  std::vector<std::string> mistaken(const std::string& list, std::size_t i) const {
    std::vector<std::string> keys = reading.sketch.mistaken_keys(fmt::format("{}.{}", list, i));
    std::erase_if(keys, [&](const std::string& key) {
      return !key.empty() && pattern_of(list + "[]", key).empty();
    });
    return keys;
  }
};

bool is_moved(const Tool& tool) {
  return tool.motion != Motion::fixed;
}

/// Evenly over the duration, and the ends of all stages.
std::vector<double> times_of(const Preview& p) {
  constexpr int count = 50;
  std::vector<double> shares;
  for (int i = 0; i <= count; ++i)
    shares.push_back(static_cast<double>(i) / count);
  const auto add = [&](std::span<const Stage> stages) {
    for (const Stage& stage : stages)
      if (stage.share > 0.0 && stage.share < 1.0) shares.push_back(stage.share);
  };
  for (const Tool& tool : p.data.tools)
    add(tool.programme);
  for (const Boundary& boundary : p.data.boundaries)
    add(programme_of(boundary));
  std::sort(shares.begin(), shares.end());
  shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
  for (double& share : shares)
    share *= p.seen.duration;
  return shares;
}

template <class Body>
std::vector<double> values_over(const Preview& p, const Body& body) {
  std::vector<double> values;
  for (const double t : p.seen.times)
    values.push_back(motion_at(body, t, p.seen.duration));
  return values;
}

/// s, when a driven tool first comes that far.
std::optional<double> time_of(const Preview& p, const Tool& tool, double stroke) {
  const double duration = p.seen.duration;
  const auto reached = [&](double t) { return motion_at(tool, t, duration) >= stroke - 1e-9; };
  constexpr int pieces = 1000, halvings = 40;
  for (int i = 0; i <= pieces; ++i) {
    double low = duration * std::max(0, i - 1) / pieces, high = duration * i / pieces;
    if (!reached(high)) continue;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (low + high);
      (reached(middle) ? high : low) = middle;
    }
    return high;
  }
  return std::nullopt;
}

/// mm, how far the stack and all tools reach from the origin, for what has no end.
double reach_of(const Preview& p) {
  double reach = 0.0;
  for (const FlatPly& ply : p.flat)
    for (const Vec2& corner : {ply.bounds.min(), ply.bounds.max()})
      reach = std::max(reach, Vec3(corner.x(), corner.y(), ply.z).norm());
  return reach > 0.0 ? reach : 100.0;
}

TriMesh surface_of(const Tool& tool, double reach) {
  const double extent = reach + tool.position.norm();
  const double diagonal = diagonal_of(tool.shape, extent);
  if (!(diagonal > 0.0) || !std::isfinite(diagonal)) return {};
  TriMesh surface = tessellate(tool.shape, diagonal / 100.0, extent);
  for (Vec3& x : surface.x)
    x = tool.position + tool.rotation * x;
  return surface;
}

void set_motion(const Preview& p, const Tool& tool, ToolPreview& seen) {
  for (const auto& choice : motion_choices)
    if (choice.value == tool.motion) seen.motion = choice.word;
  seen.direction = tool.direction;
  if (!(p.seen.duration > 0.0)) return;
  if (tool.motion == Motion::force) {
    seen.moves.forces = values_over(p, tool);
    return;
  }
  seen.moves.strokes = values_over(p, tool);
  for (const double stroke : seen.moves.strokes)
    seen.shifts.emplace_back(stroke * tool.direction);
}

/// Gap at the start and first touch, with the numbers of plies as in the case.
void look_at_plies(const Preview& p, const Tool& tool, ToolPreview& seen) {
  if (p.flat.empty()) return;
  const ToolAhead ahead{tool, seen.surface.x};
  const PlyGap gap = nearest_ply(ahead, Vec3::Zero(), p.flat);
  if (!std::isfinite(gap.gap)) return;
  seen.gap = gap;
  seen.gap->ply = p.number[gap.ply];
  if (seen.motion.empty() || !is_moved(tool)) return;
  const bool driven = tool.motion == Motion::driven;
  const double longest = 1e3 * reach_of(p); // of one that goes until it meets something
  seen.first_contact = first_contact(ahead, driven ? tool.stroke : longest, gap, p.flat);
  if (!seen.first_contact) return;
  seen.first_contact->ply = p.number[seen.first_contact->ply];
  if (driven && p.seen.duration > 0.0)
    seen.first_contact->time = time_of(p, tool, seen.first_contact->stroke);
}

ToolPreview preview_tool(const Preview& p, std::size_t i) {
  const Tool& tool = p.data.tools[i];
  ToolPreview seen;
  seen.name = tool.name;
  seen.shape = i < p.reading.words.tool_shapes.size() ? p.reading.words.tool_shapes[i] : "";
  std::vector<std::string> wrong = p.mistaken("tool", i);
  const bool motion_known = std::none_of(wrong.begin(), wrong.end(), [](const std::string& key) {
    return key != "name" &&
           std::find(motion_keys.begin(), motion_keys.end(), key) != motion_keys.end();
  });
  std::erase_if(wrong, [](const std::string& key) {
    return std::find(motion_keys.begin(), motion_keys.end(), key) != motion_keys.end();
  });
  if (!wrong.empty()) {
    seen.trouble = trouble_with(wrong);
    return seen;
  }
  try {
    seen.surface = surface_of(tool, reach_of(p));
    if (motion_known) set_motion(p, tool, seen);
    if (!seen.surface.triangles.empty()) look_at_plies(p, tool, seen);
  } catch (const std::exception& error) {
    seen.surface = {};
    seen.trouble = error.what();
  }
  return seen;
}

/// Nodes that it holds, of each ply.
std::vector<std::vector<int>> nodes_of(const Preview& p, const Boundary& boundary) {
  std::vector<std::vector<int>> nodes(p.seen.plies.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::vector<Vec3>& x = p.seen.plies[i].x;
    for (std::size_t n = 0; n < x.size(); ++n)
      if (holds(boundary, static_cast<int>(i), x[n].head<2>()))
        nodes[i].push_back(static_cast<int>(n));
  }
  return nodes;
}

BoundaryPreview preview_boundary(const Preview& p, std::size_t i) {
  const Boundary& boundary = p.data.boundaries[i];
  BoundaryPreview seen;
  seen.boundary.name = boundary.name;
  seen.kind = i < p.reading.words.boundary_kinds.size() ? p.reading.words.boundary_kinds[i] : "";
  std::vector<std::string> wrong = p.mistaken("boundary", i);
  std::erase(wrong, "name");
  if (!wrong.empty()) {
    seen.trouble = trouble_with(wrong);
    return seen;
  }
  seen.boundary = boundary;
  if (boundary.ply >= 0) seen.ply = p.data.plies[static_cast<std::size_t>(boundary.ply)].name;
  seen.nodes = nodes_of(p, boundary);
  if (!(p.seen.duration > 0.0)) return seen;
  if (stroke_of(boundary) != 0.0) seen.moves.strokes = values_over(p, boundary);
  if (force_of(boundary) != 0.0) seen.moves.forces = values_over(p, boundary);
  if (boundary.is<HingedFrame>())
    for (const double t : p.seen.times) {
      std::array<Vec3, 4>& hinges = seen.hinges.emplace_back();
      for (std::size_t h = 0; h < 4; ++h) {
        const Vec2& at = boundary.as<HingedFrame>().hinges[h];
        hinges[h] = prescribed_position(boundary, Vec3(at.x(), at.y(), 0.0),
                                        motion_at(boundary, t, p.seen.duration));
      }
    }
  return seen;
}

/// Points of a tool's surface near enough to each other to stand for it.
std::vector<Vec3> points_of(const Tool& tool, const TriMesh& surface, double reach) {
  constexpr std::size_t enough = 5000;
  if (surface.x.size() >= enough || surface.x.empty()) return surface.x;
  return tool_surface(tool, 0.0, reach + tool.position.norm()).x; // sides of large facets divided
}

void set_tool_spacings(Preview& p) {
  if (p.flat.empty()) return;
  std::vector<ToolOnItsWay> tools;
  for (std::size_t i = 0; i < p.seen.tools.size(); ++i) {
    const ToolPreview& seen = p.seen.tools[i];
    ToolOnItsWay& tool = tools.emplace_back();
    if (seen.surface.x.empty() || seen.shifts.empty()) continue;
    tool.tool = &p.data.tools[i];
    tool.points = points_of(*tool.tool, seen.surface, reach_of(p));
    tool.shifts = &seen.shifts;
  }
  p.seen.tool_spacings = tool_spacings(tools, p.flat);
}

void set_whole(Preview& p) {
  ScenePreview& seen = p.seen;
  const CaseSketch& sketch = p.reading.sketch;
  seen.title = p.data.title;
  const double duration = p.data.solver.duration;
  if (std::isfinite(duration) && duration > 0.0) seen.duration = duration;
  if (p.data.gravity.allFinite() && sketch.mistaken_keys("gravity").empty())
    seen.gravity = p.data.gravity;
  for (const PressureLoad& load : p.data.loads)
    if (p.mistaken("load", load.entry).empty() && load.ply >= 0 &&
        static_cast<std::size_t>(load.ply) < seen.plies.size())
      seen.loads.push_back(load);
}

void set_spacings(Preview& p) {
  for (std::size_t i = 0; i + 1 < p.flat.size(); ++i) {
    const FlatPly &a = p.flat[i], &b = p.flat[i + 1];
    if (!a.bounds.intersects(b.bounds)) continue;
    const bool up = a.z <= b.z;
    constexpr double rounding = 1e-9; // mm
    const double gap = std::abs(b.z - a.z) - a.half - b.half;
    p.seen.spacings.push_back(
        {p.number[up ? i : i + 1], p.number[up ? i + 1 : i], std::abs(gap) < rounding ? 0.0 : gap});
  }
  for (const FlatPly& ply : p.flat)
    p.seen.stack_thickness += 2.0 * ply.half;
}

} // namespace

ScenePreview preview_scene(const std::filesystem::path& file,
                           const std::vector<Override>& overrides, int threads) {
  const PickedCase picked = pick_case(file, overrides);
  const CaseReading& reading = picked.reading;
  ScenePreview seen;
  seen.mistakes = reading.errors;
  Preview p{reading, reading.value ? *reading.value : reading.sketch.data, seen};
  ThreadPool pool(threads);
  LaidPlies laid = lay_plies(p.data, reading, pool);
  seen.plies = std::move(laid.plies);
  p.flat = std::move(laid.flat);
  p.number = std::move(laid.number);
  set_whole(p);
  set_spacings(p);
  seen.times = times_of(p);
  seen.tools.resize(p.data.tools.size());
  pool.run(static_cast<int>(seen.tools.size()), [&](int i) {
    const auto number = static_cast<std::size_t>(i);
    seen.tools[number] = preview_tool(p, number);
  });
  set_tool_spacings(p);
  for (std::size_t i = 0; i < p.data.boundaries.size(); ++i)
    seen.boundaries.push_back(preview_boundary(p, i));
  return seen;
}

} // namespace plyform
