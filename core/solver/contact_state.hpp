// SPDX-License-Identifier: GPL-3.0-or-later
// What the contacts of a scene and its boundaries are in a step: tools, pairs of plies, springs and
// grips.
#pragma once

#include "base/archive.hpp"
#include "contact/forces/edge_edge.hpp"
#include "contact/forces/ply_ply.hpp"
#include "contact/forces/tool_ply.hpp"
#include "core/model/attachment.hpp"
#include "core/model/boundary.hpp"
#include "core/solver/force_filter.hpp"

#include <string>
#include <vector>

namespace plyform {

// What a checkpoint keeps of each type stands beside its members: each_member calls f(name,
// member). Where a type has no base it unpacks all members: one more, and it does not compile until
// somebody has said whether it is kept.

/// Forces of a tool: with ToolMotion all that its later steps depend on, but for its contacts.
struct ToolLoad {
  Vec3 force = Vec3::Zero(); ///< N, of the plies on the tool, now
  ForceFilter filter;        ///< of `force`
  double work = 0.0;         ///< N mm, done by the tool on the plies since the start
};

template <class F>
void each_member(ToolLoad& t, F&& f) {
  auto& [force, filter, work] = t;
  f("force", force);
  f("filter", filter);
  f("work", work);
}

/// One tool with its contacts: contacts[i] is with ply i.
struct ToolState : ToolLoad {
  std::string name;
  ToolBody body;
  double force_on = 0.0; ///< N, prescribed force at full load, 0 unless pushed
  std::vector<ToolPlyContact> contacts;
  Vec3 displacement_search = Vec3::Zero();
  double max_displacement = 0.0; ///< mm, largest distance from displacement_search, with what it
                                 ///< may still move in this step
  double path_length = 0.0;      ///< mm, contact/search/active_list.hpp
  bool far = false; ///< core/solver/resting.hpp: it cannot touch a ply before the next search
  std::vector<double> ply_paths; ///< mm, with each ply, with what it may still move in this step
  double seconds = 0.0;          ///< s, computing time of its forces
};

template <class F>
void each_member(ToolState& t, F&& f) {
  each_member(static_cast<ToolLoad&>(t), f);
  f("motion", static_cast<ToolMotion&>(t.body));
  f("displacement_search", t.displacement_search);
  f("max_displacement", t.max_displacement);
  f("path_length", t.path_length);
  f("ply_paths", t.ply_paths);
  f("far", t.far);
  f("contacts", of_fixed_size(t.contacts));
}

/// One pass of the node-to-face contact between two plies, or of a ply with itself.
struct PlyContact {
  int slave = 0, master = 0;
  PlyPlyContact contact;
};

template <class F>
void each_member(PlyContact& pair, F&& f) {
  f("contact", pair.contact);
}

/// Edge-edge contact of two plies, a < b, or of one with itself.
struct PlyEdgeContact {
  int a = 0, b = 0;
  EdgeEdgeContact contact;
};

template <class F>
void each_member(PlyEdgeContact& pair, F&& f) {
  f("contact", pair.contact);
}

/// All contacts of two plies, a < b, or of one with itself, and their forces on the nodes.
struct PlyPair {
  int a = 0, b = 0;
  std::vector<PlyContact> passes; ///< both ways, a as the slave first; of a ply with itself one
  PlyEdgeContact edges;
  std::vector<Vec3> force_a, force_b; ///< N, sums over the contacts; empty until anything may touch
  bool loaded = false;                ///< whether any contact is closed; else the forces are zero
  std::vector<ContactRow> rows_a,
      rows_b; ///< core/solver/contact_rows.hpp; empty if nothing is near
};

template <class F>
void each_member(PlyPair& pair, F&& f) {
  auto& [a, b, passes, edges, force_a, force_b, loaded, rows_a, rows_b] = pair;
  f("passes", of_fixed_size(passes));
  f("edges", edges);
  f("force_a", force_a); // all zero unless loaded
  f("force_b", force_b);
  f("loaded", loaded);
  f("rows_a", rows_a);
  f("rows_b", rows_b);
}

/// Which pass of which pair: PlyContacts::pass_order.
struct PassPlace {
  int pair = 0, pass = 0;
};

/// State of a boundary (Case::boundaries).
struct BoundaryState {
  /// mm, d at the present time; of a gripper its way along its direction, of a spring how much
  /// longer it is than at the start
  double displacement = 0.0;
  double next_displacement = 0.0; ///< mm, d at the end of the coming step
  /// N, (L): positive if it pulls along its stroke; of a gripper along its direction, of a spring
  /// its tension
  double load = 0.0;
  Vec3 force = Vec3::Zero(); ///< N, sum of its forces on the nodes
  double work = 0.0;         ///< N mm, done on the plies since the start
};

template <class F>
void each_member(BoundaryState& boundary, F&& f) {
  auto& [displacement, next_displacement, load, force, work] = boundary;
  f("displacement", displacement);
  f("next_displacement", next_displacement);
  f("load", load);
  f("force", force);
  f("work", work);
}

} // namespace plyform
