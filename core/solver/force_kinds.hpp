// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of force, in one list. Each owns what it adds to a layup (tools, pairs of plies,
// boundaries, blocks of elements), and says here once what every part of a step asks of it: its
// tasks, its part in the force on a node, its energies, its stiffness and its words in a report.
// What asks goes through the list (each_kind), so that a new kind is one type and its place there.
//
// A kind sees the layup and its own members. What it does not have, it inherits from NoForce.
#pragma once

#include "base/thread_pool.hpp"
#include "core/model/energies.hpp"
#include "core/solver/contact_state.hpp"
#include "core/solver/frequencies.hpp"
#include "core/solver/layup.hpp"
#include "core/solver/stiffness_products.hpp"
#include "core/solver/stop.hpp"

#include <array>
#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace plyform {

struct Scene;

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
  int tasks(const Layup&) const { return 0; }
  /// Where in the stack a task is, 0 to 1: threads take tasks that are neighbours.
  double place(const Layup&, int) const { return 0.0; }
  /// Forces of a task at the present positions, into arrays of its own.
  void run(Layup&, int) {}
  /// After all tasks; here a kind may look at others.
  void finish(Scene&, ThreadPool&) {}
  /// The step whose forces were computed is taken: what laws remember of its end is now that of the
  /// begin of the next. Until then computing them again is harmless, but for contacts.
  void end_step(Layup&) {}
  /// Adds its forces (N) on nodes begin .. end - 1, kept by nodes in blocks, to f[0 ..].
  static void add_to_nodes(const PlyBody&, int, int, Vec3*) {}
  /// Appends its arrays of forces per node that are not zero in this step to
  /// PlyCache::nodal_forces.
  void list_arrays(Layup&) {}
  /// Adds its energies and works.
  void add_energies(const Layup&, ThreadPool&, Energies&) const {}
  /// Adds the row sums of its stiffness and damping on the nodes of a ply.
  void add_rows(const Layup&, std::size_t, std::span<ContactRow>) const {}
  /// Adds its bound of omega^2 and damping of a ply's elements.
  static void add_bound(const PlyBody&, Frequencies&) {}
  /// The same without what its Product has.
  static void add_bound_of_rest(const PlyBody&, Frequencies&) {}
  using Product = NoProduct;
  /// visit(contact, who) for each of its contacts, whose `sums`, `law` and `renew_depth` it has in
  /// common with others; who(): between which bodies it is, at the deepest. self: the kind, const
  /// or not.
  template <class Self, class Visit>
  static void each_contact(Self&, const Layup&, const Visit&) {}
  /// Why the run cannot go on, found in its last forces.
  std::optional<Stop> fault(const Layup&) const { return std::nullopt; }
  void add_times(Times&) const {}
  void add_seen(const Layup&, std::vector<PairSeen>&) const {}
  /// What `plyform check` says of it before a run, a line each.
  void describe(const Layup&, std::vector<std::string>&) const {}
};

/// What is kept of the elements' past: N mm, in the steps taken, one per group block.
struct ElementState {
  std::vector<double> group_sums;  ///< lost by yarns
  std::vector<double> torn_sums;   ///< that stitches had stored when they broke
  std::vector<double> flowed_sums; ///< lost by rates of yarns
};

template <class F>
void each_member(ElementState& elements, F&& f) {
  auto& [group_sums, torn_sums, flowed_sums] = elements;
  f("group_sums", group_sums);
  f("torn_sums", torn_sums);
  f("flowed_sums", flowed_sums);
}

/// Membranes of plies, with their laws of rates, whose forces the same kernel computes: what these
/// store is energy of shear, their stiffness is in the bounds of the elements.
struct ElementForces : NoForce, ElementState {
  static constexpr int begun = 2, summed = 2;
  std::vector<Block> group_blocks;
  /// As the sums, in the step computed, until taken.
  std::vector<double> group_lost, group_torn, group_flowed;
  std::vector<char> group_collapsed; ///< whether a triangle has collapsed

  int tasks(const Layup&) const { return static_cast<int>(group_blocks.size()); }
  double place(const Layup& layup, int task) const;
  void run(Layup& layup, int task);
  void finish(Scene& s, ThreadPool&);
  void end_step(Layup& layup);
  static void add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f);
  void add_energies(const Layup& layup, ThreadPool& pool, Energies& e) const;
  static void add_bound(const PlyBody& ply, Frequencies& of);
  static void add_bound_of_rest(const PlyBody& ply, Frequencies& of);
  using Product = ElementProduct;
  std::optional<Stop> fault(const Layup& layup) const;
  void add_times(Times& times) const;
  void describe(const Layup& layup, std::vector<std::string>& lines) const;
  /// N mm, lost by a block of yarns since the start, in the step computed, too.
  double lost(std::size_t block) const { return group_sums[block] + group_lost[block]; }
  /// N mm, likewise: what its stitches had stored when they broke.
  double torn(std::size_t block) const { return torn_sums[block] + group_torn[block]; }
  /// N mm, likewise: lost by rates of yarns.
  double flowed(std::size_t block) const { return flowed_sums[block] + group_flowed[block]; }
  /// Elastic energy of one ply, N mm.
  double elastic(const Layup& layup, std::size_t ply) const;
};

/// Bending of plies, with what resists its rates.
struct BendingForces : NoForce {
  static constexpr int begun = 3, summed = 3;
  std::vector<Block> bending_blocks;

  int tasks(const Layup&) const { return static_cast<int>(bending_blocks.size()); }
  double place(const Layup& layup, int task) const;
  void run(Layup& layup, int task);
  void finish(Scene& s, ThreadPool&);
  void end_step(Layup& layup);
  static void add_to_nodes(const PlyBody& ply, int begin, int end, Vec3* f);
  void add_energies(const Layup& layup, ThreadPool& pool, Energies& e) const;
  static void add_bound(const PlyBody& ply, Frequencies& of);
  static void add_bound_of_rest(const PlyBody& ply, Frequencies& of) { add_bound(ply, of); }
  void add_times(Times& times) const;
  void describe(const Layup& layup, std::vector<std::string>& lines) const;
  static double elastic(const Layup& layup, std::size_t ply);
};

/// Springs, grippers and reactions of prescribed nodes. Reactions follow from all other forces
/// (core/solver/prescribed_motion.hpp).
struct BoundaryForces : NoForce {
  static constexpr int begun = 5, summed = 4;
  std::vector<BoundaryState> boundaries; ///< one per entry of Case::boundaries
  std::vector<PrescribedNode> held;      ///< ascending by ply and node
  std::vector<Attachment> attachments;   ///< springs and grippers, ascending by boundary

  void finish(Scene& s, ThreadPool&);
  void list_arrays(Layup& layup);
  void add_energies(const Layup& layup, ThreadPool&, Energies& e) const;
  void add_rows(const Layup& layup, std::size_t ply, std::span<ContactRow> rows) const;
  using Product = BoundaryProduct;
};

struct ToolContacts : NoForce {
  static constexpr int begun = 1, summed = 0;
  std::vector<ToolState> tools;

  int tasks(const Layup&) const { return static_cast<int>(tools.size()); }
  double place(const Layup& layup, int task) const;
  void run(Layup& layup, int task);
  void list_arrays(Layup& layup);
  void add_energies(const Layup& layup, ThreadPool&, Energies& e) const;
  void add_rows(const Layup& layup, std::size_t ply, std::span<ContactRow> rows) const;
  using Product = ToolProduct;
  void add_times(Times& times) const;
  void add_seen(const Layup& layup, std::vector<PairSeen>& seen) const;
  std::string who(const Layup& layup, std::size_t tool, std::size_t ply) const;
  template <class Self, class Visit>
  static void each_contact(Self& self, const Layup& layup, const Visit& visit) {
    for (std::size_t t = 0; t < self.tools.size(); ++t)
      for (std::size_t p = 0; p < self.tools[t].contacts.size(); ++p)
        visit(self.tools[t].contacts[p], [&, t, p] { return self.who(layup, t, p); });
  }
};

/// Contacts between plies, and of a ply with itself.
struct PlyContacts : NoForce {
  static constexpr int begun = 0, summed = 1;
  std::vector<PlyPair> ply_pairs; ///< adjacent plies first, which take longest to compute
  /// The passes of all ply_pairs ascending by slave and master, those of a ply with itself last:
  /// the order of sums over them.
  std::vector<PassPlace> pass_order;

  int tasks(const Layup&) const { return static_cast<int>(ply_pairs.size()); }
  double place(const Layup& layup, int task) const;
  void run(Layup& layup, int task);
  void list_arrays(Layup& layup);
  void add_energies(const Layup& layup, ThreadPool&, Energies& e) const;
  void add_rows(const Layup& layup, std::size_t ply, std::span<ContactRow> rows) const;
  using Product = PlyProduct;
  std::optional<Stop> fault(const Layup& layup) const;
  void add_times(Times& times) const;
  void add_seen(const Layup& layup, std::vector<PairSeen>& seen) const;
  static std::string who(const Layup& layup, const PlyContact& pass);
  static std::string who(const Layup& layup, const PlyEdgeContact& edges);
  template <class Self, class Visit>
  static void each_contact(Self& self, const Layup& layup, const Visit& visit);
};

/// visit(pass) for every PlyContact, in pass_order. of: PlyContacts or a Scene, const or not.
template <class SomeContacts, class Visit>
void each_pass(SomeContacts& of, const Visit& visit) {
  for (const PassPlace& at : of.pass_order)
    visit(
        of.ply_pairs[static_cast<std::size_t>(at.pair)].passes[static_cast<std::size_t>(at.pass)]);
}

/// visit(edges) for every PlyEdgeContact, in the same order.
template <class SomeContacts, class Visit>
void each_edge_contact(SomeContacts& of, const Visit& visit) {
  for (const PassPlace& at : of.pass_order)
    if (at.pass == 0) visit(of.ply_pairs[static_cast<std::size_t>(at.pair)].edges);
}

template <class Self, class Visit>
void PlyContacts::each_contact(Self& self, const Layup& layup, const Visit& visit) {
  each_pass(self, [&](auto& pass) { visit(pass.contact, [&] { return who(layup, pass); }); });
  each_edge_contact(self,
                    [&](auto& edges) { visit(edges.contact, [&] { return who(layup, edges); }); });
}

/// Bound of the stiffness of pressures, at each node.
class PressureProduct : public NoProduct {
public:
  PressureProduct(const struct PressureForces&, const Layup& layup, const TangentFactors& factors);
  void add_on_ply(std::size_t ply, const PerPly& y, PerPly& f) const;

private:
  std::vector<std::vector<double>> on_ply_; ///< N/mm, times the factor; empty without a pressure
};

/// Pressures on faces of plies. A task a ply: core/solver/pressure_forces.cpp.
struct PressureForces : NoForce {
  static constexpr int begun = 4, summed = 5;

  int tasks(const Layup& layup) const {
    return layup.data.loads.empty() ? 0 : static_cast<int>(layup.plies.size());
  }
  double place(const Layup& layup, int task) const;
  void run(Layup& layup, int task);
  void end_step(Layup& layup);
  void list_arrays(Layup& layup);
  void add_energies(const Layup& layup, ThreadPool&, Energies& e) const;
  void add_rows(const Layup& layup, std::size_t ply, std::span<ContactRow> rows) const;
  using Product = PressureProduct;
  void describe(const Layup& layup, std::vector<std::string>& lines) const;
};

/// What contacts do in the plane of plies, whose thickness follows their area:
/// core/solver/thickness_forces.cpp. Its energy is that of the contacts, its stiffness in their
/// rows (ContactLaw::thickness_coupling).
struct ThicknessForces : NoForce {
  static constexpr int begun = 6, summed = 6;

  void finish(Scene& s, ThreadPool& pool);
  void list_arrays(Layup& layup);
};

/// The list.
using Forces = std::tuple<ElementForces, BendingForces, BoundaryForces, PressureForces,
                          ToolContacts, PlyContacts, ThicknessForces>;
constexpr std::size_t kinds = std::tuple_size_v<Forces>;

/// Orders of the list. added: on a node, as it stands there, the first kind sets the force. begun:
/// by threads, the longest tasks first. summed: over kinds.
enum class InOrder { added, begun, summed };

template <class K>
concept ForceKind = std::derived_from<K, NoForce> &&
    requires(const K& seen, K& kind, const Layup& at, Layup& layup, Scene& s, const PlyBody& ply,
             ThreadPool& pool, Vec3* f, Energies& e, std::span<ContactRow> rows, Times& times,
             std::vector<PairSeen>& pairs, Frequencies& of, std::vector<std::string>& lines) {
  { K::begun + K::summed } -> std::same_as<int>;
  { seen.tasks(at) } -> std::same_as<int>;
  { seen.place(at, 0) } -> std::same_as<double>;
  kind.run(layup, 0);
  kind.finish(s, pool);
  kind.end_step(layup);
  K::add_to_nodes(ply, 0, 0, f);
  kind.list_arrays(layup);
  seen.add_energies(at, pool, e);
  seen.add_rows(at, std::size_t{0}, rows);
  K::add_bound(ply, of);
  K::add_bound_of_rest(ply, of);
  requires std::derived_from<typename K::Product, NoProduct>;
  { seen.fault(at) } -> std::same_as<std::optional<Stop>>;
  seen.add_times(times);
  seen.add_seen(at, pairs);
  seen.describe(at, lines);
};

/// Places of the kinds in the list, in an order.
template <InOrder order, class... K>
constexpr std::array<std::size_t, kinds> places_of(std::type_identity<std::tuple<K...>>) {
  static_assert((ForceKind<K> && ...));
  const std::array<int, kinds> begun{K::begun...}, summed{K::summed...};
  std::array<std::size_t, kinds> places{};
  for (std::size_t i = 0; i < kinds; ++i) {
    const int rank = order == InOrder::begun    ? begun[i]
                     : order == InOrder::summed ? summed[i]
                                                : static_cast<int>(i);
    places.at(static_cast<std::size_t>(rank)) = i;
  }
  return places;
}

/// f.operator()<K>() for each kind K, in an order of the list.
template <InOrder order = InOrder::added, class F>
void each_kind_of(F&& f) {
  constexpr auto places = places_of<order>(std::type_identity<Forces>());
  [&f, &places ]<std::size_t... i>(std::index_sequence<i...>) {
    (f.template operator()<std::tuple_element_t<places[i], Forces>>(), ...);
  }
  (std::make_index_sequence<kinds>());
}

} // namespace plyform
