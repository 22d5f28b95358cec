// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/step_faults.hpp"

#include "base/format.hpp"
#include "contact/intersections.hpp"
#include "core/solver/limit_pressure.hpp"

#include <algorithm>
#include <cmath>
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

std::string when(const Layup& layup) {
  return fmt::format("stopped at step {}, time {:.6g} s", layup.step, layup.time);
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
std::string remedy_for(const Layup& layup, const char* advice) {
  const auto folded = std::find_if(layup.plies.begin(), layup.plies.end(), [](const PlyBody& ply) {
    return !ply.self_contact && crosses_itself(ply);
  });
  if (folded == layup.plies.end()) return advice;
  return fmt::format("ply {} has folded through itself: set contact.self = \"on\"", folded->name);
}

/// What a ply whose triangles collapse is told besides. shear: degrees.
std::string why_collapsed(const Layup& layup, std::size_t ply, double shear) {
  if (const std::string blown = beyond_limit_pressure(layup, ply); !blown.empty())
    return "; " + blown;
  const bool yarns = !layup.plies[ply].membrane.families.empty();
  return yarns && shear >= sheared_too_far ? sheared_remedy : "";
}

} // namespace

std::optional<Stop> find_not_finite(const Layup& layup) {
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    const PlyBody& ply = layup.plies[p];
    for (std::size_t n = 0; n < ply.x.size(); ++n)
      if (!ply.x[n].allFinite() || ply.x[n].cwiseAbs().maxCoeff() > furthest_place ||
          ply.motion[n].cwiseAbs().maxCoeff() > furthest_place) {
        const std::string blown = beyond_limit_pressure(layup, p);
        return Stop{fmt::format(
            "{}: ply {}, node {}: position is not finite, or a thousand "
            "kilometres away; {}",
            when(layup), ply.name, n,
            blown.empty() ? "a smaller solver.step_factor or more damping may help" : blown)};
      }
  }
  return std::nullopt;
}

std::optional<Stop> find_fault(const PlyContacts& contacts, const Layup& layup) {
  const PlyContact* found = nullptr;
  each_pass(contacts, [&](const PlyContact& pass) {
    if (!found && pass.contact.fault.node >= 0) found = &pass;
  });
  if (!found) return std::nullopt;
  const ContactFault& fault = found->contact.fault;
  const PlyBody &slave = layup.plies[at(found->slave)], &master = layup.plies[at(found->master)];
  return Stop{fmt::format(
      "{}: ply {}, node {} has gone through ply {}, triangle {}: {:.3g} mm apart, thickness "
      "{:.3g} mm; {}",
      when(layup), slave.name, fault.node, master.name, fault.face, fault.distance,
      found->contact.distance,
      remedy_for(layup, "give the stack more room between the tools, a slower stroke, or a smaller "
                        "solver.step_factor"))};
}

std::optional<Stop> find_squeezed(const Scene& s) {
  constexpr double least = 1e-4; // of the longest step: with less the run would practically not end
  if (s.next_dt > least * s.max_dt) return std::nullopt;
  if (!std::isfinite(s.next_dt))
    return Stop{fmt::format("{}: the stable step is no number: a stiffness is beyond what numbers "
                            "hold; check the numbers of the fabrics",
                            when(s))};
  std::string who = "plies";
  double ratio = std::numeric_limits<double>::infinity();
  each_contact(s, [&](const auto& contact, const auto& between) {
    if (contact.sums.step_ratio < ratio) ratio = contact.sums.step_ratio, who = between();
  });
  return Stop{fmt::format("{}: {} are squeezed: the step in which they keep apart has fallen from "
                          "{:.2g} to {:.2g} s; {}",
                          when(s), who, s.max_dt, s.next_dt,
                          remedy_for(s, "give the stack more room between the tools, a slower "
                                        "stroke, or a pushed tool less force"))};
}

std::optional<Stop> find_collapsed(const Layup& layup) {
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    const PlyBody& ply = layup.plies[p];
    for (std::size_t e = 0; e < ply.membrane.triangles.size(); ++e) {
      const AxesState f = axes_state(ply.membrane, ply.x, static_cast<int>(e));
      if (!collapsed(f)) continue;
      const double shear = std::abs(f.gamma) / degree;
      const auto [along, across] = axes_words(ply.membrane.fabric);
      return Stop{fmt::format("{}: ply {}, triangle {} has collapsed: stretch {:.3g} along {}, "
                              "{:.3g} {}, sheared by {:.3g} degrees{}",
                              when(layup), ply.name, e, f.lambda1, along, f.lambda2, across, shear,
                              why_collapsed(layup, p, shear))};
    }
  }
  return std::nullopt;
}

} // namespace plyform
