// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/occlusion.hpp"

#include "core/solver/follow_thickness.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// The ply adjacent to `from` in the stack in the direction of `to`.
int next_ply(int from, int to) {
  return from + (to > from) - (to < from);
}

} // namespace

bool neighbours(const PlyContact& pair) {
  return pair.slave != pair.master && pair.master == next_ply(pair.slave, pair.master);
}

void mark_occluded(const Layup& layup, PlyBody& slave, const PlyContact& pair,
                   const PlyBody& master) {
  const double path_length = slave.path_length + master.path_length;
  // A third ply between two keeps its least distance from both.
  const PlyPlyContact& contact = pair.contact;
  const double room =
      (contact.distance - 2.0 * contact.law.depth_limit()) * std::min(layup.thinnest, 1.0);
  std::vector<char>& occluded = slave.occluded[pair.master > pair.slave];
  occluded.assign(slave.x.size(), 0);
  for (std::size_t p = 0; p < pair.contact.points.size(); ++p) {
    const PlyPlyPoint& c = pair.contact.points[p];
    char inside = pair.contact.list.free_until[p] - path_length < room;
    for (int i = c.first_face; i < c.end_face; ++i)
      inside &= !master.touches_boundary_edge[pair.contact.faces[static_cast<std::size_t>(i)]];
    occluded[c.node] |= inside;
  }
}

std::span<const char> occluded_nodes(const Layup& layup, int slave_ply, int master_ply,
                                     double reach) {
  const PlyBody& slave = layup.plies[slave_ply];
  if (slave_ply == master_ply)
    return reach > reach_of(layup, slave.thickness) ? std::span<const char>() : slave.unfolded;
  if (next_ply(slave_ply, master_ply) == master_ply) return {};
  const PlyBody& between = layup.plies[next_ply(slave_ply, master_ply)];
  // Occluding plies were searched within contact distance + skin only: not valid for a larger
  // reach.
  if (reach > reach_of(layup, 0.5 * (slave.thickness + between.thickness))) return {};
  return slave.occluded[master_ply > slave_ply];
}

bool may_meet(Box3 a, const Box3& b, double reach) {
  a.min().array() -= reach;
  a.max().array() += reach;
  return a.intersects(b);
}

} // namespace plyform
