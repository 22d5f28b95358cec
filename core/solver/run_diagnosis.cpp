// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/run_diagnosis.hpp"

#include "core/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace plyform {
namespace {

// If bending, or friction, has less than this share of the deformation energy, or of the external
// work, leaving it out changes the plies by less than the cost parameters of a run do
// (docs/users/accuracy.md).
constexpr double small_bending = 0.01, small_friction = 1e-3;

constexpr double deep = 0.9;          // of the depth limit of a contact (core/solver/scene.cpp)
constexpr double high_inertia = 0.05; // kinetic over shear energy at the end
constexpr double long_strain = 0.005; // softened yarns; woven ones break at 0.02 to 0.04

void add(PairReport& pair, const ContactTotals& sums, const ContactTime& time) {
  pair.time_share += time.forces + time.search; // in seconds here, divided by the total later
  pair.deepest_mm = std::max(pair.deepest_mm, sums.deepest);
  pair.slip_mm = std::max(pair.slip_mm, sums.slip);
  pair.friction_mJ += sums.friction;
}

/// Tools with plies, then plies with plies; time_share in seconds.
std::vector<PairReport> pairs_of(const Scene& s) {
  std::vector<PairReport> pairs;
  for (const ToolState& t : s.tools)
    for (std::size_t p = 0; p < s.plies.size(); ++p) {
      PairReport pair{.a = t.name, .b = s.plies[p].name};
      pair.friction_coefficient = t.contacts[p].law.friction;
      add(pair, t.contacts[p].sums, t.contacts[p].time);
      pairs.push_back(pair);
    }
  const auto of_plies = [&](int a, int b) -> PairReport& {
    const std::string &low = s.plies[std::min(a, b)].name, &high = s.plies[std::max(a, b)].name;
    for (PairReport& pair : pairs)
      if (pair.a == low && pair.b == high) return pair;
    pairs.push_back({.a = low, .b = high});
    return pairs.back();
  };
  for (const PlyContact& c : s.ply_contacts) {
    PairReport& pair = of_plies(c.slave, c.master);
    pair.friction_coefficient = c.contact.law.friction;
    add(pair, c.contact.sums, c.contact.time);
  }
  for (const PlyEdgeContact& c : s.edge_contacts)
    add(of_plies(c.a, c.b), c.contact.sums, c.contact.time);
  return pairs;
}

/// Computing time (s) of all threads by kind of work.
struct Times {
  double elements = 0.0, contact = 0.0, search = 0.0, motion = 0.0;
  double sum() const { return elements + contact + search + motion; }
};

Times times_of(const Scene& s) {
  Times t;
  for (const Block& b : s.group_blocks)
    t.elements += b.seconds;
  for (const Block& b : s.bending_blocks)
    t.elements += b.seconds;
  for (const Block& b : s.node_blocks)
    t.motion += b.seconds;
  for (const PlyBody& ply : s.plies)
    t.search += ply.search_seconds;
  for (const ToolState& tool : s.tools) {
    t.contact += tool.seconds;
    for (const ToolPlyContact& c : tool.contacts)
      t.search += c.time.search;
  }
  for (const PlyContact& c : s.ply_contacts)
    t.contact += c.contact.time.forces, t.search += c.contact.time.search;
  for (const PlyEdgeContact& c : s.edge_contacts)
    t.contact += c.contact.time.forces, t.search += c.contact.time.search;
  return t;
}

std::string named(const PairReport& pair) {
  return pair.a == pair.b ? pair.a + " with itself" : pair.a + " with " + pair.b;
}

std::vector<std::string> too_much(const Scene& s, const Energies& e, const WorkReport& w) {
  std::vector<std::string> found;
  const bool bending = std::any_of(s.plies.begin(), s.plies.end(),
                                   [](const PlyBody& ply) { return ply.bending.has_value(); });
  const double deformation = e.shear + e.fibre;
  if (bending && deformation > e.floor && e.bending < small_bending * deformation)
    found.push_back(fmt::format("bending: {:.2g} % of the deformation energy; without the fabric's "
                                "bending keys only the size of wrinkles would change",
                                100.0 * e.bending / deformation));
  std::vector<std::string> idle;
  for (const PairReport& pair : w.pairs)
    if (pair.a != pair.b && pair.touched() && pair.friction_coefficient > 0.0 &&
        std::abs(e.external) > e.floor && pair.friction_mJ < small_friction * std::abs(e.external))
      idle.push_back(named(pair));
  if (!idle.empty())
    found.push_back(fmt::format("friction of {}: less than {:g} of the work done each",
                                joined(idle), small_friction));
  for (const ToolState& t : s.tools)
    if (std::none_of(t.contacts.begin(), t.contacts.end(),
                     [](const ToolPlyContact& c) { return c.sums.deepest > 0.0; }))
      found.push_back(fmt::format("tool {}: no ply ever touched it", t.name));
  if (s.data.contact.self == SelfContact::on &&
      std::none_of(w.pairs.begin(), w.pairs.end(),
                   [](const PairReport& pair) { return pair.a == pair.b && pair.touched(); }))
    found.push_back(fmt::format("contact.self: no ply ever touched itself"));
  return found;
}

/// The largest strain of any yarn, and the ply that has it.
std::pair<double, std::string> longest_yarn(const Frame& last) {
  std::pair<double, std::string> found{0.0, ""};
  for (const PlyFrame& ply : last.plies)
    for (const std::vector<double>* strains : {&ply.warp_strain, &ply.weft_strain})
      for (const double strain : *strains)
        if (strain > found.first) found = {strain, ply.name};
  return found;
}

/// Effective softening factor of a ply's yarns, that of the softer family.
double largest_softening(const Scene& s, const std::string& name) {
  double largest = 1.0;
  for (const PlyBody& ply : s.plies)
    if (ply.name == name)
      largest = std::max({largest, ply.membrane.softening[0], ply.membrane.softening[1]});
  return largest;
}

std::vector<std::string> too_little(const Scene& s, const Frame& last, const ContactReport& c) {
  const Energies& e = last.energy;
  std::vector<std::string> found;
  // depth and limit, mm
  std::map<std::pair<std::string, std::string>, std::pair<double, double>> deepest;
  const auto add_depth = [&deepest](const std::string& a, const std::string& b,
                                    const ContactTotals& sums, const ContactLaw& law) {
    auto& [depth, limit] = deepest[std::minmax(a, b)];
    if (sums.deepest >= depth) depth = sums.deepest, limit = law.max_depth;
  };
  for (const ToolState& t : s.tools)
    for (std::size_t p = 0; p < s.plies.size(); ++p)
      add_depth(t.name, s.plies[p].name, t.contacts[p].sums, t.contacts[p].law);
  for (const PlyContact& pair : s.ply_contacts) // both directions
    add_depth(s.plies[pair.slave].name, s.plies[pair.master].name, pair.contact.sums,
              pair.contact.law);
  for (const auto& [names, depth] : deepest)
    if (depth.first > deep * depth.second)
      found.push_back(fmt::format("{} with {}: {:.3f} mm deep at some time, of {:.3g} mm that "
                                  "contact has; a finer mesh spreads the pressure over more nodes",
                                  names.first, names.second, depth.first, depth.second));
  if (const double share = e.kinetic_over_shear(); share > high_inertia)
    found.push_back(fmt::format("inertia: kinetic energy is {:.2g} of the shear energy at the end; "
                                "a longer solver.duration makes it less",
                                share));
  const auto [strain, ply] = longest_yarn(last);
  if (const double by = largest_softening(s, ply); by > 1.0 && strain > long_strain)
    found.push_back(fmt::format("tensile stiffness: yarns of {} are {:.2g} % longer, softened by "
                                "{:g}; a smaller solver.fibre_softening makes it less",
                                ply, 100.0 * strain, by));
  if (c.intersections_within_plies > 0 && !any_self_contact(s))
    found.push_back(fmt::format("self-contact: {} pairs of triangles of one ply cross; "
                                "contact.self = \"on\" keeps folds apart",
                                c.intersections_within_plies));
  return found;
}

} // namespace

WorkReport report_work(const Scene& s, const Frame& last, const ContactReport& contact) {
  WorkReport w;
  w.searches = s.searches;
  w.pairs = pairs_of(s);
  const Times t = times_of(s);
  if (const double all = t.sum(); all > 0.0) {
    w.elements_share = t.elements / all;
    w.contact_share = t.contact / all;
    w.search_share = t.search / all;
    for (PairReport& pair : w.pairs)
      pair.time_share /= all;
  }
  w.could_be_left_out = too_much(s, last.energy, w);
  w.missing = too_little(s, last, contact);
  return w;
}

} // namespace plyform
