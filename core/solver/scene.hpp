// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a running simulation: the layup, and each kind of force with what it owns. Topology
// is constant; the arrays change step by step (core/solver/step.hpp).
#pragma once

#include "core/solver/force_kinds.hpp"

#include <tuple>
#include <type_traits>
#include <vector>

namespace plyform {

/// What all kinds of a list are, in one.
template <class Kinds>
struct AllOf;
template <class... K>
struct AllOf<std::tuple<K...>> : K... {};

struct Scene : Layup, AllOf<Forces> {};

template <class F>
void each_member(Scene& s, F&& f) {
  f("plies", of_fixed_size(s.plies));
  f("tools", of_fixed_size(s.tools));
  f("boundaries", of_fixed_size(s.boundaries));
  f("ply_pairs", of_fixed_size(s.ply_pairs));
  f("node_sums", of_fixed_size(s.node_sums));
  f("elements", static_cast<ElementState&>(s));
  f("progress", static_cast<SceneProgress&>(s));
}

/// f(kind) for each kind of force of a scene, const or not, in an order of the list.
template <InOrder order = InOrder::added, class SomeScene, class F>
void each_kind(SomeScene& s, F&& f) {
  each_kind_of<order>([&]<class K>() {
    f(static_cast<std::conditional_t<std::is_const_v<SomeScene>, const K, K>&>(s));
  });
}

/// visit(contact, who) for all contacts of the scene: NoForce::each_contact.
template <class SomeScene, class Visit>
void each_contact(SomeScene& s, const Visit& visit) {
  each_kind<InOrder::summed>(s, [&](auto& kind) { kind.each_contact(kind, s, visit); });
}

/// Builds the scene of a case: meshes, membranes, bending, contacts with their stiffnesses, and the
/// initial positions. meshes: one per ply; if empty, the blanks are meshed here. threads >= 1.
/// Throws std::runtime_error if a blank cannot be meshed.
Scene make_scene(const Case& data, const std::vector<BlankMesh>& meshes = {}, int threads = 1);

} // namespace plyform
