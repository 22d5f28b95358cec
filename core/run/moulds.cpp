// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/moulds.hpp"

#include "core/model/motion.hpp"

#include <algorithm>
#include <numeric>

namespace plyform {
namespace {

constexpr double closed_room = 1.2;        // of the thickness of all plies
constexpr std::size_t most_samples = 5000; // of a tool's surface, to find whether it closes

double thickness_of_plies(const Scene& s) {
  return std::accumulate(s.plies.begin(), s.plies.end(), 0.0,
                         [](double sum, const PlyBody& ply) { return sum + ply.thickness; });
}

bool any_driven(const Scene& s) {
  return std::any_of(s.data.tools.begin(), s.data.tools.end(),
                     [](const Tool& t) { return t.motion == Motion::driven; });
}

/// Whether tools with these displacements leave no more room than plies between them need.
bool is_closed(const Scene& s, std::size_t b, const TriMesh& surface_of_a,
               const Vec3& displacement_a, const Vec3& displacement_b) {
  ToolBody other = s.tools[b].body;
  other.displacement = displacement_b;
  const double room = closed_room * thickness_of_plies(s);
  SurfaceHint hint;
  const std::vector<Vec3>& x = surface_of_a.x;
  const std::size_t stride = 1 + x.size() / most_samples;
  for (std::size_t i = 0; i < x.size(); i += stride)
    if (distance_to_tool(other, x[i] + displacement_a, hint).distance <= room) return true;
  return false;
}

/// The displacement of a tool at the end of its programme.
Vec3 last_displacement(const Scene& s, std::size_t t) {
  const Tool& tool = s.data.tools[t];
  if (tool.motion != Motion::driven) return s.tools[t].body.displacement;
  const double duration = s.data.solver.duration;
  return motion_at(tool, duration, duration) * tool.direction;
}

/// Pairs of tools that may close on each other. Where tools are driven, those that are pushed are
/// holders.
std::vector<Mould> mould_pairs(const Scene& s) {
  const Motion mover = any_driven(s) ? Motion::driven : Motion::force;
  std::vector<Mould> found;
  for (std::size_t a = 0; a < s.tools.size(); ++a)
    for (std::size_t b = 0; b < s.tools.size(); ++b) {
      const Motion other = s.data.tools[b].motion;
      if (a == b || s.data.tools[a].motion != mover) continue;
      if (other == Motion::force || (other == mover && b < a)) continue;
      found.push_back({a, b});
    }
  return found;
}

/// Whether the tools of a mould are closed now, or will be at the end of the run.
bool is_closed(const Scene& s, const Mould& m, const std::vector<TriMesh>& surfaces, bool at_end) {
  if (!at_end)
    return is_closed(s, m.to, surfaces[m.from], s.tools[m.from].body.displacement,
                     s.tools[m.to].body.displacement);
  return !any_driven(s) || is_closed(s, m.to, surfaces[m.from], last_displacement(s, m.from),
                                     last_displacement(s, m.to));
}

} // namespace

Moulds moulds_of(const Scene& s, const std::vector<TriMesh>& surfaces) {
  Moulds moulds;
  moulds.pairs = mould_pairs(s);
  moulds.any = std::any_of(moulds.pairs.begin(), moulds.pairs.end(),
                           [&](const Mould& m) { return is_closed(s, m, surfaces, true); });
  for (const Mould& m : moulds.pairs)
    if (moulds.any && is_closed(s, m, surfaces, false))
      moulds.closed.push_back(m), moulds.closed.push_back({m.to, m.from});
  return moulds;
}

} // namespace plyform
