// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/run_diagnosis.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "core/run/sliding_ranges.hpp"
#include "core/solver/force_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace plyform {
namespace {

// If bending, or friction, has less than this share of the deformation energy, or of the external
// work, leaving it out changes the plies by less than the cost parameters of a run do
// (docs/users/accuracy.md).
constexpr double small_bending = 0.01, small_friction = 1e-3;

constexpr double deep = 0.9;          // of the depth limit of a contact (core/solver/scene.cpp)
constexpr double high_inertia = 0.05; // kinetic energy over the work of deformation at the end
constexpr double long_strain = 0.005; // softened yarns; woven ones break at 0.02 to 0.04

std::vector<PairSeen> all_seen(const Scene& s) {
  std::vector<PairSeen> seen;
  each_kind<InOrder::summed>(s, [&](const auto& kind) { kind.add_seen(s, seen); });
  return seen;
}

/// Tools with plies, then plies with plies; time_share in seconds.
std::vector<PairReport> pairs_of(const Scene& s) {
  std::vector<PairReport> pairs;
  const auto report = [&](const std::string& a, const std::string& b) -> PairReport& {
    for (PairReport& pair : pairs)
      if (pair.a == a && pair.b == b) return pair;
    PairReport& made = pairs.emplace_back();
    made.a = a, made.b = b;
    return made;
  };
  for (const PairSeen& seen : all_seen(s)) {
    PairReport& pair = report(seen.a, seen.b);
    if (!seen.of_edges) pair.friction_coefficient = seen.law.friction;
    pair.time_share += seen.seconds; // divided by the total later
    pair.deepest_mm = std::max(pair.deepest_mm, seen.sums.deepest);
    pair.slip_mm = std::max(pair.slip_mm, seen.sums.slip);
    pair.friction_mJ += seen.sums.friction;
    if (seen.law.sliding && !seen.of_edges) {
      pair.friction_law = seen.law.sliding->spec().name;
      add_ranges(*seen.law.sliding, seen.sums.sliding, pair);
    }
  }
  for (PairReport& pair : pairs)
    end_ranges(pair);
  return pairs;
}

Times times_of(const Scene& s) {
  Times t;
  for (const Block& b : s.node_blocks)
    t.motion += b.seconds;
  for (const PlyBody& ply : s.plies)
    t.search += ply.search_seconds;
  each_kind<InOrder::summed>(s, [&](const auto& kind) { kind.add_times(t); });
  return t;
}

std::string named(const PairReport& pair) {
  return pair.a == pair.b ? pair.a + " with itself" : pair.a + " with " + pair.b;
}

std::vector<std::string> too_much(const Scene& s, const Energies& e, const WorkReport& w) {
  std::vector<std::string> found;
  const bool bending = std::any_of(s.plies.begin(), s.plies.end(),
                                   [](const PlyBody& ply) { return ply.bending.has_value(); });
  const double deformation = e.shear + e.fibre + e.stitch;
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

/// The larger elongation of the two yarns of a crimped cell in triangle e: what its strain has
/// straightened does not count.
double longest_of_cell(const Membrane& m, const MembraneCrossing& c, const PlyFrame& ply,
                       std::size_t e) {
  const std::array<double, 2> strain{ply.families[c.first].strain[e],
                                     ply.families[c.second].strain[e]};
  const CrimpedCell& cell = *c.crimp;
  const double height =
      answer_of(cell, strain, m.families[c.first].yarn, m.families[c.second].yarn).height;
  const auto elongation = [&](std::size_t a, double of_wave) {
    return std::hypot(cell.half_wave[a] * (1.0 + strain[a]), of_wave) / cell.length(a) - 1.0;
  };
  return std::max(elongation(0, height), elongation(1, cell.heights() - height));
}

/// The largest elongation of any yarn, and the ply that has it.
std::pair<double, std::string> longest_yarn(const Scene& s, const Frame& last) {
  std::pair<double, std::string> found{0.0, ""};
  const auto look_at = [&](double elongation, const std::string& ply) {
    if (elongation > found.first) found = {elongation, ply};
  };
  for (const PlyFrame& ply : last.plies) {
    std::vector<char> crimped(ply.families.size(), 0);
    for (const PlyBody& body : s.plies)
      for (const MembraneCrossing& c : body.membrane.crossings) {
        if (body.name != ply.name || !c.crimp) continue;
        crimped[c.first] = crimped[c.second] = 1;
        for (std::size_t e = 0; e < ply.families[c.first].strain.size(); ++e)
          look_at(longest_of_cell(body.membrane, c, ply, e), ply.name);
      }
    for (std::size_t a = 0; a < ply.families.size(); ++a)
      for (const double strain : ply.families[a].strain)
        if (!crimped[a]) look_at(strain, ply.name);
  }
  return found;
}

/// Effective softening factor of a ply's yarns, that of the softest family.
double largest_softening(const Scene& s, const std::string& name) {
  double largest = 1.0;
  for (const PlyBody& ply : s.plies)
    if (ply.name == name)
      for (const MembraneFamily& family : ply.membrane.families)
        largest = std::max(largest, family.softening);
  return largest;
}

std::vector<std::string> too_little(const Scene& s, const Frame& last) {
  const Energies& e = last.energy;
  std::vector<std::string> found;
  // depth and limit, mm
  std::map<std::pair<std::string, std::string>, std::pair<double, double>> deepest;
  for (const PairSeen& seen : all_seen(s)) { // of plies both directions
    if (seen.of_edges) continue;
    auto& [depth, limit] = deepest[std::minmax(seen.a, seen.b)];
    const double beyond = seen.sums.deepest - seen.law.packed(); // of what gives way
    if (beyond >= depth) depth = beyond, limit = seen.law.max_depth;
  }
  for (const auto& [names, depth] : deepest)
    if (depth.first > deep * depth.second)
      found.push_back(fmt::format("{} with {}: {:.3f} mm deep at some time, of {:.3g} mm that "
                                  "contact has; a finer mesh spreads the pressure over more nodes",
                                  names.first, names.second, depth.first, depth.second));
  if (const double share = e.kinetic_over_deformation(); share > high_inertia)
    found.push_back(fmt::format("inertia: kinetic energy is {:.2g} of the work of deformation at "
                                "the end; a longer solver.duration makes it less",
                                share));
  const auto [strain, ply] = longest_yarn(s, last);
  if (const double by = largest_softening(s, ply); by > 1.0 && strain > long_strain)
    found.push_back(fmt::format("tensile stiffness: yarns of {} are {:.2g} % longer, softened by "
                                "{:g}; a smaller solver.fibre_softening makes it less",
                                ply, 100.0 * strain, by));
  return found;
}

} // namespace

WorkReport report_work(const Scene& s, const Frame& last) {
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
  w.missing = too_little(s, last);
  return w;
}

} // namespace plyform
