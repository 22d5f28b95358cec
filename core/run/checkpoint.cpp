// SPDX-License-Identifier: GPL-3.0-or-later
// Not kept: the models of plies, tools and boundaries, which come from the case; forces, which the
// next step computes; times for the report.
#include "core/run/checkpoint.hpp"

#include "core/run/checkpoint_checks.hpp"

#include <algorithm>
#include <stdexcept>

namespace plyform {
namespace {

/// mm, how far a contact is deeper than its cloth gives way; 0: it is not.
template <class Contact>
double beyond_packing(const Contact& contact) {
  return std::max(contact.sums.penetration - contact.law.packed(), 0.0);
}

/// The lists name members of a scene that is not const; saving, comparing and hashing change none.
Scene& listed(const Scene& s) {
  return const_cast<Scene&>(s);
}

} // namespace

std::string save_state(const Scene& scene, const RunState& run) {
  SaveArchive archive;
  visit(archive, listed(scene), const_cast<RunState&>(run));
  return archive.text();
}

void load_state(const std::string& bytes, Scene& scene, RunState& run) {
  const std::vector<ArraySizes> made = sizes_of(scene);
  LoadArchive archive(bytes);
  visit(archive, scene, run);
  if (archive.left() > 0) throw std::runtime_error("is longer than its scene");
  check_loaded(scene, run, made);
  for (PlyBody& ply : scene.plies)
    ply.tree->refit(ply.x_search); // as the last search left it
}

std::string first_difference(const Scene& scene, const std::string& bytes) {
  CompareArchive archive(bytes);
  visit(archive, listed(scene));
  return archive.first_difference();
}

std::uint64_t state_hash(const Scene& scene) {
  HashArchive archive;
  visit(archive, listed(scene));
  return archive.hash();
}

void keep(const Scene& s, const Energies& energy, Snapshot& snapshot) {
  snapshot.plies.resize(s.plies.size());
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    snapshot.plies[p] = s.plies[p]; // copies into existing arrays
  snapshot.tool_motions.resize(s.tools.size());
  snapshot.tool_loads.resize(s.tools.size());
  for (std::size_t t = 0; t < s.tools.size(); ++t) {
    snapshot.tool_motions[t] = s.tools[t].body;
    snapshot.tool_loads[t] = s.tools[t];
  }
  snapshot.boundaries = s.boundaries;
  snapshot.elements = s;
  snapshot.progress = s;
  snapshot.energy = energy;
  snapshot.tool_penetration = snapshot.ply_penetration = 0.0;
  for (const ToolState& t : s.tools)
    for (const ToolPlyContact& c : t.contacts)
      snapshot.tool_penetration = std::max(snapshot.tool_penetration, beyond_packing(c));
  each_pass(s, [&](const PlyContact& pass) {
    snapshot.ply_penetration = std::max(snapshot.ply_penetration, beyond_packing(pass.contact));
  });
}

void restore(Scene& s, const Snapshot& snapshot) {
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    static_cast<PlyState&>(s.plies[p]) = snapshot.plies[p];
  for (std::size_t t = 0; t < s.tools.size(); ++t) {
    static_cast<ToolMotion&>(s.tools[t].body) = snapshot.tool_motions[t];
    static_cast<ToolLoad&>(s.tools[t]) = snapshot.tool_loads[t];
  }
  s.boundaries = snapshot.boundaries;
  static_cast<ElementState&>(s) = snapshot.elements;
  static_cast<SceneProgress&>(s) = snapshot.progress;
  for (std::vector<double>* lost : {&s.group_lost, &s.group_torn, &s.group_flowed}) // no step's
    std::fill(lost->begin(), lost->end(), 0.0);
}

} // namespace plyform
