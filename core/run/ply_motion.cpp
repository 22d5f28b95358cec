// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/ply_motion.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/model/motion.hpp"
#include "core/run/enclosures.hpp"
#include "core/run/rim_forces.hpp"
#include "core/solver/force_kinds.hpp"
#include "core/solver/limit_pressure.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

double kinetic_of(const PlyBody& ply) {
  double sum = 0.0;
  for (std::size_t n = 0; n < ply.velocity.size(); ++n)
    sum += 0.5 * ply.mass[n] * ply.velocity[n].squaredNorm();
  return sum;
}

/// Elastic energy without contact, N mm.
double elastic_of(const Scene& s, std::size_t ply) {
  return BendingForces::elastic(s, ply) + s.ElementForces::elastic(s, ply);
}

std::vector<std::string> doubts_of_flight(const Scene& s, const Frame& last) {
  const LargestMotion motion = largest_motion(s, motion_of_plies(s), last.energy.external);
  if (motion.flying.empty()) return {};
  std::vector<std::string> names, found;
  for (const std::size_t p : motion.flying)
    if (const std::string blown = beyond_limit_pressure(s, p); blown.empty())
      names.push_back(s.plies[p].name);
    else
      found.push_back(fmt::format("do not trust {}, which flies: {}", s.plies[p].name, blown));
  if (names.empty()) return found;
  const bool one = names.size() == 1;
  found.push_back(fmt::format(
      "do not trust forces, draw-in and shear: {} {} at the end, with a kinetic energy of {:.2g} "
      "of "
      "the work that deforms {}, so that speed decides where {}; a longer solver.duration, a "
      "solver.dwell, or holders where nothing holds",
      joined(names), one ? "flies" : "fly", motion.share, one ? "it" : "them",
      one ? "it lies" : "they lie"));
  return found;
}

/// The box around the bodies at the start, and around driven ones over their strokes, mm.
Box3 box_of_scene(const Scene& s, const Frame& last) {
  Box3 box;
  for (const PlyBody& ply : s.plies)
    for (const Vec3& x : ply.x0)
      box.extend(x);
  for (std::size_t t = 0; t < last.tools.size(); ++t)
    for (const Vec3& x : last.tools[t].surface.x) {
      box.extend(x);
      if (s.data.tools[t].motion == Motion::driven)
        box.extend(x + s.data.tools[t].stroke * s.data.tools[t].direction);
    }
  const Vec3 way = Vec3::Constant(longest_strokes(s.data).longest()); // what is drawn goes along
  return {box.min() - way, box.max() + way};
}

/// A body of which nothing is left in the scene, or a part is further away than the scene is large.
std::vector<std::string> doubts_of_places(const Scene& s, const Frame& last) {
  const Box3 scene = box_of_scene(s, last);
  const double size = scene.diagonal().norm();
  std::vector<std::string> found;
  const auto look = [&](const std::string& name, const std::vector<Vec3>& x, const Vec3& moved) {
    double nearest = std::numeric_limits<double>::max(), farthest = 0.0;
    for (const Vec3& p : x) {
      const double away = scene.exteriorDistance(Vec3(p + moved));
      nearest = std::min(nearest, away), farthest = std::max(farthest, away);
    }
    if (x.empty() || !(nearest > 0.0 || farthest > size)) return;
    found.push_back(fmt::format(
        "do not trust {}: at the end {} of it lies {:.3g} mm outside of the scene, which is "
        "{:.3g} mm large, so that nothing held it; less force, more hold, or a boundary that ends "
        "its way",
        name, nearest > 0.0 ? "all" : "a part", nearest > 0.0 ? nearest : farthest, size));
  };
  for (const PlyFrame& ply : last.plies)
    look("ply " + ply.name, ply.x, Vec3::Zero());
  for (std::size_t t = 0; t < last.tools.size(); ++t)
    if (s.data.tools[t].motion == Motion::force)
      look("tool " + last.tools[t].name, last.tools[t].surface.x, last.tools[t].displacement);
  return found;
}

/// Grippers whose force throws the plies instead of drawing them. What mass damping has taken was
/// motion, too.
std::vector<std::string> doubts_of_grippers(const Scene& s, const Frame& last) {
  constexpr double thrown = 0.1; // of the work of the grippers: some 1e-3 where they draw
  std::vector<std::string> names;
  double work = 0.0;
  for (std::size_t b = 0; b < s.boundaries.size(); ++b) {
    if (force_of(s.data.boundaries[b]) == 0.0) continue;
    names.push_back(s.data.boundaries[b].name);
    work += s.boundaries[b].work;
  }
  const double motion = last.energy.kinetic + s.mass_damping_work;
  if (names.empty() || !(motion > thrown * std::max(std::abs(work), s.energy_floor))) return {};
  return {fmt::format("do not trust the way of {}: at the end {:.2g} % of the work of that pull is "
                      "motion, or has been and went into mass damping, so that the force is more "
                      "than what holds the plies; less force, or a drive (stiffness, stroke) in "
                      "its place",
                      joined(names), 100.0 * motion / std::max(std::abs(work), s.energy_floor))};
}

} // namespace

std::vector<PlyMotion> motion_of_plies(const Scene& s) {
  std::vector<PlyMotion> plies;
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    plies.push_back({kinetic_of(s.plies[p]), elastic_of(s, p)});
  for (std::size_t b = 0; b < s.group_blocks.size(); ++b)
    plies[static_cast<std::size_t>(s.group_blocks[b].ply)].deformation += s.lost(b) + s.torn(b);
  return plies;
}

LargestMotion largest_motion(const Scene& s, const std::vector<PlyMotion>& plies, double work) {
  double mean = 0.0;
  for (const PlyMotion& ply : plies)
    mean += ply.deformation / static_cast<double>(plies.size());
  LargestMotion largest;
  for (std::size_t p = 0; p < plies.size(); ++p) {
    const double share = plies[p].kinetic / std::max({plies[p].deformation, mean, s.energy_floor});
    largest.share = std::max(largest.share, share);
    if (share > flying && plies[p].kinetic > counts_as_motion * std::abs(work))
      largest.flying.push_back(p);
  }
  return largest;
}

std::vector<std::string> doubts_of_motion(const Scene& s, const Frame& last) {
  std::vector<std::string> found = doubts_of_flight(s, last);
  for (auto* more : {&doubts_of_places, &doubts_of_grippers})
    for (std::string& doubt : more(s, last))
      found.push_back(std::move(doubt));
  for (auto* more : {&doubts_of_enclosures, &doubts_of_rims})
    for (std::string& doubt : more(s))
      found.push_back(std::move(doubt));
  return found;
}

} // namespace plyform
