// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of force, in one list. Each says here once what every part of a step asks of it: its
// tasks, its part in the force on a node, its energies, its stiffness and its words in a report.
// What asks goes through the list (each_kind), so that a new kind is one type and its place there.
//
// A kind is a type without members: its data stands in the scene, in parts of its own. What it does
// not have, it inherits from NoForce.
#pragma once

#include "base/thread_pool.hpp"
#include "core/model/energies.hpp"
#include "core/results/summary.hpp"
#include "core/solver/contact_rows.hpp"
#include "core/solver/frequencies.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/stiffness_products.hpp"
#include "core/solver/stop.hpp"

#include <concepts>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace plyform {

/// Computing time (s) of all threads by kind of work.
struct Times {
  double elements = 0.0, contact = 0.0, search = 0.0, motion = 0.0;
  double sum() const { return elements + contact + search + motion; }
};

/// What a contact of two bodies has seen, for reports.
struct PairSeen {
  std::string a, b;
  const ContactLaw& law;
  const ContactTotals& sums;
  double seconds = 0.0;
  bool of_edges = false; ///< its depth is no penetration of surfaces
};

/// A kind of force that is nowhere and does nothing: what a kind does not have.
struct NoForce {
  /// How many pieces of work its forces are, each for one thread.
  static int tasks(const Scene&) { return 0; }
  /// Where in the stack a task is, 0 to 1: threads take tasks that are neighbours.
  static double place(const Scene&, int) { return 0.0; }
  /// Forces of a task at the present positions, into arrays of its own.
  static void run(Scene&, int) {}
  /// After all tasks.
  static void finish(Scene&, ThreadPool&) {}
  /// The step whose forces were computed is taken: what laws remember of its end is now that of the
  /// begin of the next. Until then computing them again is harmless, but for contacts.
  static void end_step(Scene&) {}
  /// Adds its forces (N) on nodes begin .. end - 1, kept by nodes in blocks, to f[0 ..].
  static void add_to_nodes(const PlyBody&, int, int, Vec3*) {}
  /// Appends its arrays of forces per node that are not zero in this step to
  /// PlyCache::nodal_forces.
  static void list_arrays(Scene&) {}
  /// Adds its energies and works.
  static void add_energies(const Scene&, ThreadPool&, Energies&) {}
  /// Adds the row sums of its stiffness and damping on the nodes of a ply.
  static void add_rows(const Scene&, std::size_t, std::span<ContactRow>) {}
  /// Adds its bound of omega^2 and damping of a ply's elements.
  static void add_bound(const PlyBody&, Frequencies&) {}
  /// The same without what its Product has.
  static void add_bound_of_rest(const PlyBody&, Frequencies&) {}
  using Product = NoProduct;
  /// visit(contact, who) for each of its contacts, whose `sums`, `law` and `renew_depth` it has in
  /// common with others; who(): between which bodies it is, at the deepest.
  template <class SomeScene, class Visit>
  static void each_contact(SomeScene&, const Visit&) {}
  /// Why the run cannot go on, found in its last forces.
  static std::optional<Stop> fault(const Scene&) { return std::nullopt; }
  static void add_times(const Scene&, Times&) {}
  static void add_seen(const Scene&, std::vector<PairSeen>&) {}
  /// What `plyform check` says of it before a run, a line each.
  static void describe(const Scene&, std::vector<std::string>&) {}
};

/// Membranes of plies: alone to know whether a ply is computed by packs or one by one.
struct ElementForces : NoForce {
  static int tasks(const Scene& s) { return static_cast<int>(s.group_blocks.size()); }
  static double place(const Scene& s, int task);
  static void run(Scene& s, int task);
  static void end_step(Scene& s);
  static void add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f);
  static void add_energies(const Scene& s, ThreadPool& pool, Energies& e);
  static void add_bound(const PlyBody& ply, Frequencies& of);
  static void add_bound_of_rest(const PlyBody& ply, Frequencies& of);
  using Product = ElementProduct;
  static std::optional<Stop> fault(const Scene& s);
  static void add_times(const Scene& s, Times& times);
  /// N mm, lost by a block of yarns since the start, in the step computed, too.
  static double lost(const Scene& s, std::size_t block) {
    return s.group_sums[block] + s.group_lost[block];
  }
  /// N mm, likewise: what its stitches had stored when they broke.
  static double torn(const Scene& s, std::size_t block) {
    return s.torn_sums[block] + s.group_torn[block];
  }
  /// Elastic energy of one ply, N mm.
  static double elastic(const Scene& s, std::size_t ply);
};

struct BendingForces : NoForce {
  static int tasks(const Scene& s) { return static_cast<int>(s.bending_blocks.size()); }
  static double place(const Scene& s, int task);
  static void run(Scene& s, int task);
  static void add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f);
  static void add_energies(const Scene& s, ThreadPool& pool, Energies& e);
  static void add_bound(const PlyBody& ply, Frequencies& of);
  static void add_bound_of_rest(const PlyBody& ply, Frequencies& of) { add_bound(ply, of); }
  static void add_times(const Scene& s, Times& times);
  static double elastic(const Scene& s, std::size_t ply);
};

/// What membranes resist by rates: core/ply/viscous_membrane.hpp. The kernel of elements computes
/// its forces with theirs. What it stores is energy of shear; its stiffness is in the bounds of the
/// elements.
struct ViscousForces : NoForce {
  static void finish(Scene& s, ThreadPool&);
  static void end_step(Scene& s);
  static void add_energies(const Scene& s, ThreadPool&, Energies& e);
  static void describe(const Scene& s, std::vector<std::string>& lines);
};

/// What bending resists by rates: core/ply/viscous_bending.hpp, likewise in the kernel of bending.
/// ViscousForces takes its steps.
struct ViscousBendingForces : NoForce {
  static void add_energies(const Scene& s, ThreadPool&, Energies& e);
  static void add_bound(const PlyBody& ply, Frequencies& of);
  static void add_bound_of_rest(const PlyBody& ply, Frequencies& of) { add_bound(ply, of); }
  static void describe(const Scene& s, std::vector<std::string>& lines);
};

/// Springs, grippers and reactions of prescribed nodes. Reactions follow from all other forces
/// (core/solver/prescribed_motion.hpp).
struct BoundaryForces : NoForce {
  static void finish(Scene& s, ThreadPool&);
  static void list_arrays(Scene& s);
  static void add_energies(const Scene& s, ThreadPool&, Energies& e);
  static void add_rows(const Scene& s, std::size_t ply, std::span<ContactRow> rows);
  using Product = BoundaryProduct;
};

struct ToolContacts : NoForce {
  static int tasks(const Scene& s) { return static_cast<int>(s.tools.size()); }
  static double place(const Scene& s, int task);
  static void run(Scene& s, int task);
  static void list_arrays(Scene& s);
  static void add_energies(const Scene& s, ThreadPool&, Energies& e);
  static void add_rows(const Scene& s, std::size_t ply, std::span<ContactRow> rows);
  using Product = ToolProduct;
  static void add_times(const Scene& s, Times& times);
  static void add_seen(const Scene& s, std::vector<PairSeen>& seen);
  static std::string who(const Scene& s, std::size_t tool, std::size_t ply);
  template <class SomeScene, class Visit>
  static void each_contact(SomeScene& s, const Visit& visit) {
    for (std::size_t t = 0; t < s.tools.size(); ++t)
      for (std::size_t p = 0; p < s.tools[t].contacts.size(); ++p)
        visit(s.tools[t].contacts[p], [&s, t, p] { return who(s, t, p); });
  }
};

/// Contacts between plies, and of a ply with itself.
struct PlyContacts : NoForce {
  static int tasks(const Scene& s) { return static_cast<int>(s.ply_pairs.size()); }
  static double place(const Scene& s, int task);
  static void run(Scene& s, int task);
  static void list_arrays(Scene& s);
  static void add_energies(const Scene& s, ThreadPool&, Energies& e);
  static void add_rows(const Scene& s, std::size_t ply, std::span<ContactRow> rows);
  using Product = PlyProduct;
  static std::optional<Stop> fault(const Scene& s);
  static void add_times(const Scene& s, Times& times);
  static void add_seen(const Scene& s, std::vector<PairSeen>& seen);
  static std::string who(const Scene& s, const PlyContact& pass);
  static std::string who(const Scene& s, const PlyEdgeContact& edges);
  template <class SomeScene, class Visit>
  static void each_contact(SomeScene& s, const Visit& visit) {
    each_pass(s, [&](auto& pass) { visit(pass.contact, [&] { return who(s, pass); }); });
    each_edge_contact(s, [&](auto& edges) { visit(edges.contact, [&] { return who(s, edges); }); });
  }
};

/// Bound of the stiffness of pressures, at each node.
class PressureProduct : public NoProduct {
public:
  PressureProduct(const Scene& s, const TangentFactors& factors);
  void add_on_ply(std::size_t ply, const PerPly& y, PerPly& f) const;

private:
  std::vector<std::vector<double>> on_ply_; ///< N/mm, times the factor; empty without a pressure
};

/// Pressures on faces of plies. A task a ply: core/solver/pressure_forces.cpp.
struct PressureForces : NoForce {
  static int tasks(const Scene& s) {
    return s.data.loads.empty() ? 0 : static_cast<int>(s.plies.size());
  }
  static double place(const Scene& s, int task);
  static void run(Scene& s, int task);
  static void end_step(Scene& s);
  static void list_arrays(Scene& s);
  static void add_energies(const Scene& s, ThreadPool&, Energies& e);
  static void add_rows(const Scene& s, std::size_t ply, std::span<ContactRow> rows);
  using Product = PressureProduct;
  static void describe(const Scene& s, std::vector<std::string>& lines);
};

/// What contacts do in the plane of plies, whose thickness follows their area:
/// core/solver/thickness_forces.cpp. Its energy is that of the contacts, its stiffness in their
/// rows (ContactLaw::spread).
struct ThicknessForces : NoForce {
  static void finish(Scene& s, ThreadPool& pool);
  static void list_arrays(Scene& s);
};

/// The list, in the order in which forces are added on a node. The first kind sets them.
using Forces =
    std::tuple<ElementForces, BendingForces, ViscousForces, ViscousBendingForces, BoundaryForces,
               PressureForces, ToolContacts, PlyContacts, ThicknessForces>;
/// The order in which threads begin them, the longest first.
using TasksOfForces =
    std::tuple<PlyContacts, ToolContacts, ElementForces, BendingForces, ViscousBendingForces,
               ViscousForces, PressureForces, BoundaryForces, ThicknessForces>;
/// The order of sums over kinds.
using SumsOfForces =
    std::tuple<ToolContacts, PlyContacts, ElementForces, BendingForces, ViscousForces,
               ViscousBendingForces, BoundaryForces, PressureForces, ThicknessForces>;

template <class K>
concept ForceKind = std::derived_from<K, NoForce> && std::is_empty_v<K> &&
    requires(const Scene& seen, Scene& s, const PlyBody& ply, ThreadPool& pool, Vec3* f,
             Energies& e, std::span<ContactRow> rows, Times& times, std::vector<PairSeen>& pairs,
             Frequencies& of, std::vector<std::string>& lines) {
  { K::tasks(seen) } -> std::same_as<int>;
  { K::place(seen, 0) } -> std::same_as<double>;
  K::run(s, 0);
  K::finish(s, pool);
  K::end_step(s);
  K::add_to_nodes(ply, 0, 0, f);
  K::list_arrays(s);
  K::add_energies(seen, pool, e);
  K::add_rows(seen, std::size_t{0}, rows);
  K::add_bound(ply, of);
  K::add_bound_of_rest(ply, of);
  requires std::derived_from<typename K::Product, NoProduct>;
  { K::fault(seen) } -> std::same_as<std::optional<Stop>>;
  K::add_times(seen, times);
  K::add_seen(seen, pairs);
  K::describe(seen, lines);
};

/// f.operator()<K>() for each kind K of a list, in its order.
template <class Kinds = Forces, class F>
void each_kind(F&& f) {
  [&f]<class... K>(std::type_identity<std::tuple<K...>>) {
    static_assert((ForceKind<K> && ...));
    (f.template operator()<K>(), ...);
  }(std::type_identity<Kinds>());
}

static_assert(std::tuple_size_v<Forces> == std::tuple_size_v<SumsOfForces> &&
              std::tuple_size_v<Forces> == std::tuple_size_v<TasksOfForces>);

/// The products of the kinds of a list.
template <class Kinds>
struct ProductsOfKinds;
template <class... K>
struct ProductsOfKinds<std::tuple<K...>> {
  using Type = std::tuple<typename K::Product...>;
  static Type make(const Scene& s, const TangentFactors& factors) {
    return Type{typename K::Product(s, factors)...};
  }
};
template <class Kinds>
using ProductsOf = typename ProductsOfKinds<Kinds>::Type;
template <class Kinds>
ProductsOf<Kinds> products_of(const Scene& s, const TangentFactors& factors) {
  return ProductsOfKinds<Kinds>::make(s, factors);
}

/// visit(contact, who) for all contacts of the scene: NoForce::each_contact.
template <class SomeScene, class Visit>
void each_contact(SomeScene& s, const Visit& visit) {
  each_kind<SumsOfForces>([&]<class K>() { K::each_contact(s, visit); });
}

} // namespace plyform
