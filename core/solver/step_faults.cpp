// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/step_faults.hpp"

#include "contact/intersections.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace plyform {
namespace {

// Degrees: beyond, no woven fabric shears. Tried with five plies under 2000 N of a blank-holder
// (docs/users/fabrics.md#locking).
constexpr double sheared_too_far = 70.0;
constexpr const char* sheared_remedy =
    ", where its yarns lie on each other; those of a weave lock at 40 to 60 degrees: give the "
    "fabric a shear law that rises beyond its locking angle, or let less force or friction hold "
    "the plies";

std::string when(const Scene& s) {
  return fmt::format("stopped at step {}, time {:.6g} s", s.step, s.time);
}

/// Whether triangles of a ply intersect each other: the side of its faces on which a node is then
/// has no meaning.
bool crosses_itself(const PlyBody& ply) {
  if (!std::all_of(ply.x.begin(), ply.x.end(), [](const Vec3& x) { return x.allFinite(); }))
    return false;
  const std::vector<MeshView> sheet{{ply.x, ply.membrane.triangles}};
  return !find_intersections(sheet).within.empty();
}

/// What to do about plies that are where they cannot be: `advice`, unless a ply has folded through
/// itself, which its neighbours feel as well.
std::string remedy_for(const Scene& s, const char* advice) {
  const auto folded = std::find_if(s.plies.begin(), s.plies.end(), [](const PlyBody& ply) {
    return !ply.self_contact && crosses_itself(ply);
  });
  if (folded == s.plies.end()) return advice;
  return fmt::format("ply {} has folded through itself: set contact.self = \"on\"", folded->name);
}

} // namespace

std::optional<Stop> find_not_finite(const Scene& s) {
  for (const PlyBody& ply : s.plies)
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      if (!ply.x[n].allFinite() || ply.x[n].cwiseAbs().maxCoeff() > furthest_place ||
          ply.motion[n].cwiseAbs().maxCoeff() > furthest_place)
        return Stop{fmt::format("{}: ply {}, node {}: position is not finite, or a thousand "
                                "kilometres away; a smaller solver.step_factor or more damping may "
                                "help",
                                when(s), ply.name, n)};
  return std::nullopt;
}

std::optional<Stop> find_fault(const Scene& s) {
  for (const PlyContact& pair : s.ply_contacts) {
    const ContactFault& fault = pair.contact.fault;
    if (fault.node < 0) continue;
    const PlyBody &slave = s.plies[pair.slave], &master = s.plies[pair.master];
    return Stop{fmt::format(
        "{}: ply {}, node {} has gone through ply {}, triangle {}: {:.3g} mm apart, thickness "
        "{:.3g} mm; {}",
        when(s), slave.name, fault.node, master.name, fault.face, fault.distance,
        pair.contact.distance,
        remedy_for(s, "give the stack more room between the tools, a slower stroke, or a smaller "
                      "solver.step_factor"))};
  }
  return std::nullopt;
}

std::optional<Stop> find_squeezed(const Scene& s) {
  constexpr double least = 1e-4; // of the longest step: with less the run would practically not end
  if (s.next_dt > least * s.max_dt) return std::nullopt;
  std::string who = "plies";
  double ratio = std::numeric_limits<double>::infinity();
  const auto first = [&ratio](const ContactTotals& sums) {
    const bool closer = sums.step_ratio < ratio;
    if (closer) ratio = sums.step_ratio;
    return closer;
  };
  const auto deepest = [](const auto& points) {
    return std::min_element(points.begin(), points.end(),
                            [](const auto& a, const auto& b) { return a.gap < b.gap; })
        ->node;
  };
  const auto ply = [&s](int p) -> const std::string& { return s.plies[p].name; };
  for (const ToolState& t : s.tools)
    for (std::size_t p = 0; p < s.plies.size(); ++p)
      if (first(t.contacts[p].sums))
        who = fmt::format("ply {}, node {}, and tool {}", s.plies[p].name,
                          deepest(t.contacts[p].points), t.name);
  for (const PlyContact& pair : s.ply_contacts)
    if (first(pair.contact.sums))
      who = fmt::format("ply {}, node {}, and ply {}", ply(pair.slave),
                        deepest(pair.contact.points), ply(pair.master));
  for (const PlyEdgeContact& pair : s.edge_contacts)
    if (first(pair.contact.sums))
      who = fmt::format("edges of plies {} and {}", ply(pair.a), ply(pair.b));
  return Stop{fmt::format("{}: {} are squeezed: the step in which they keep apart has fallen from "
                          "{:.2g} to {:.2g} s; {}",
                          when(s), who, s.max_dt, s.next_dt,
                          remedy_for(s, "give the stack more room between the tools, a slower "
                                        "stroke, or a pushed tool less force"))};
}

std::optional<Stop> find_collapsed(const Scene& s) {
  for (const PlyBody& ply : s.plies)
    for (std::size_t e = 0; e < ply.membrane.triangles.size(); ++e) {
      const FibreState f = fibre_state(ply.membrane, ply.x, static_cast<int>(e));
      if (!collapsed(f)) continue;
      const double shear = std::abs(f.gamma) * 180.0 / M_PI;
      return Stop{fmt::format("{}: ply {}, triangle {} has collapsed: stretch {:.3g} along warp, "
                              "{:.3g} along weft, sheared by {:.3g} degrees{}",
                              when(s), ply.name, e, f.lambda1, f.lambda2, shear,
                              shear < sheared_too_far ? "" : sheared_remedy)};
    }
  return std::nullopt;
}

} // namespace plyform
