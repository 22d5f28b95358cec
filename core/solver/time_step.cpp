// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/time_step.hpp"

#include "core/solver/displacements.hpp"
#include "core/solver/mass_scaling.hpp"
#include "core/solver/stable_time_step.hpp"

#include <algorithm>
#include <limits>

namespace plyform {
namespace {

/// Of a step over the one before. Nodes that a deep contact has thrown back move fast towards the
/// next one; the step must not be long again before that one has felt them.
constexpr double largest_growth = 1.25;

/// Updates masses, the stable time step, and the depths of contacts with tools for which it holds.
void use_rows(Scene& s, ThreadPool& pool) {
  const ContactRows touching = contact_rows(s, pool);
  if (s.step % mass_scaling_interval == 0) scale_masses(s, s.tools, touching);
  s.stable_dt = s.data.solver.step_factor * stable_step(s, touching).dt;
  for (ToolState& tool : s.tools)
    for (ToolPlyContact& contact : tool.contacts)
      contact.renew_depth = depth_ahead(contact.law, contact.sums.penetration);
}

} // namespace

void renew_stable_step(Scene& s, ThreadPool& pool) {
  renew_rows(s, s.ply_pairs, pool);
  s.bound_displacement = largest_displacement(s, s.tools);
  use_rows(s, pool);
}

void renew_deepened_step(Scene& s, ThreadPool& pool) {
  renew_deepened_rows(s, s.ply_pairs, pool);
  use_rows(s, pool);
}

bool contacts_deepened(const Scene& s) {
  bool deepened = false;
  each_contact(s, [&](const auto& contact, const auto&) {
    deepened = deepened || contact.sums.penetration > contact.renew_depth;
  });
  return deepened;
}

void set_step(Scene& s) {
  double ratio = std::numeric_limits<double>::infinity();
  each_contact(s, [&](const auto& contact, const auto&) {
    ratio = std::min(ratio, contact.sums.step_ratio);
  });
  s.next_dt =
      s.dt > 0.0 ? std::min(s.stable_dt, s.dt * std::min(ratio, largest_growth)) : s.stable_dt;
  s.min_dt = s.min_dt > 0.0 ? std::min(s.min_dt, s.next_dt) : s.next_dt;
  s.max_dt = std::max(s.max_dt, s.next_dt);
}

} // namespace plyform
