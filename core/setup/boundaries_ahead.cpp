// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/boundaries_ahead.hpp"

#include "core/solver/attached_motion.hpp"
#include "core/solver/stable_time_step.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace plyform {
namespace {

const Attachment* attachment_of(const Scene& s, int boundary) {
  for (const Attachment& attached : s.attachments)
    if (attached.boundary == boundary) return &attached;
  return nullptr;
}

/// "77 nodes of ply lower, 12 of ply upper": the nodes that a boundary prescribes along some axis,
/// or pulls. (Nodes that an earlier boundary prescribes along all those axes are not counted.)
std::string nodes_held(const Scene& s, int boundary) {
  std::vector<int> count(s.plies.size(), 0);
  for (const PrescribedNode& held : s.held) {
    const auto end = held.boundary.begin() + held.count;
    if (std::find(held.boundary.begin(), end, boundary) != end) ++count[held.ply];
  }
  if (const Attachment* attached = attachment_of(s, boundary))
    for (const AttachedNode& node : attached->nodes)
      ++count[node.ply];
  std::string text;
  for (std::size_t p = 0; p < count.size(); ++p)
    if (count[p] > 0)
      text += fmt::format("{}{}{} of ply {}", text.empty() ? "" : ", ", count[p],
                          text.empty() ? " nodes" : "", s.plies[p].name);
  return text.empty() ? "no nodes that others do not hold" : text;
}

bool holds_bending_ply(const Scene& s, const Boundary& boundary) {
  if (boundary.ply >= 0) return s.plies[boundary.ply].bending.has_value();
  return std::any_of(s.plies.begin(), s.plies.end(),
                     [](const PlyBody& ply) { return ply.bending.has_value(); });
}

/// "spring of 0.5 N/mm", "gripper"
std::string kind_text(const Boundary& b) {
  switch (b.kind) {
  case BoundaryKind::grip:
    return "grip";
  case BoundaryKind::frame:
    return "frame";
  case BoundaryKind::symmetry:
    return "plane of symmetry";
  case BoundaryKind::spring:
    return fmt::format("spring of {:g} N/mm", b.stiffness);
  case BoundaryKind::gripper:
    return b.guided ? "gripper on a rail" : "gripper";
  }
  return {};
}

std::string stages_text(const Boundary& b) {
  if (b.programme.empty()) return {};
  return fmt::format(" at most, in {} {}", b.programme.size(),
                     b.programme.size() == 1 ? "stage" : "stages");
}

/// ", moves 20 mm": what a boundary does; empty for a plane of symmetry.
std::string action_text(const Scene& s, int boundary) {
  const Boundary& b = s.data.boundaries[boundary];
  const auto along = [&b] {
    return fmt::format(" along ({:.3g}, {:.3g}, {:.3g})", b.direction.x(), b.direction.y(),
                       b.direction.z());
  };
  if (b.kind == BoundaryKind::symmetry) return {};
  if (b.kind == BoundaryKind::spring) {
    const Attachment& spring = *attachment_of(s, boundary);
    std::string text = fmt::format(", {:.4g} mm long, {:.4g} mm without a load, {:.4g} N at the "
                                   "start",
                                   spring.length, spring.natural_length,
                                   spring_tension(b, spring, spring.length, 1.0));
    if (b.carrier >= 0) text += ", carried by " + s.data.tools[b.carrier].name;
    return text;
  }
  if (b.force > 0.0) return fmt::format(", pulled by {:g} N{}{}", b.force, along(), stages_text(b));
  const std::string on =
      b.kind == BoundaryKind::gripper ? fmt::format(", on {:g} N/mm", b.stiffness) : std::string();
  if (b.stroke == 0.0) return on + ", stays";
  return fmt::format("{}, moves {:g} mm{}{}", on, b.stroke,
                     b.kind == BoundaryKind::gripper ? along() : std::string(), stages_text(b));
}

/// Warns of a spring or drive that is stiffer, for the mass of its nodes, than any element: steps
/// get shorter by it.
void describe_stiff(const Scene& s, const Attachment& attached, std::vector<std::string>& lines) {
  ContactRows rows;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    rows.emplace_back(s.plies[p].x.size());
    add_attachment_stiffness(s, p, rows.back());
  }
  double ratio = 0.0; // of omega^2
  for (const AttachedNode& node : attached.nodes) {
    const PlyBody& ply = s.plies[node.ply];
    ratio = std::max(ratio, rows[node.ply][node.node].stiffness / ply.mass[node.node] /
                                element_omega2(ply));
  }
  if (ratio <= 1.0) return;
  const Boundary& b = s.data.boundaries[attached.boundary];
  lines.push_back(fmt::format("    warning: {:g} N/mm on so little mass shorten the step, of "
                              "elements alone {:.2g} times as "
                              "long; {}",
                              b.stiffness, std::sqrt(1.0 + ratio),
                              b.kind == BoundaryKind::spring
                                  ? "less stiffness, or more of the edge for it, avoid it"
                                  : "less stiffness, or the mass of the gripper, avoid it"));
}

} // namespace

std::vector<std::string> boundaries_ahead(const Scene& s) {
  std::vector<std::string> lines;
  bool part = false, hinge = false;
  for (std::size_t b = 0; b < s.data.boundaries.size(); ++b) {
    const Boundary& boundary = s.data.boundaries[b];
    const int index = static_cast<int>(b);
    const bool plane = boundary.kind == BoundaryKind::symmetry;
    part = part || plane;
    hinge = hinge || (plane && holds_bending_ply(s, boundary));
    lines.push_back(fmt::format("boundary {}: {}, holds {}{}", boundary.name, kind_text(boundary),
                                nodes_held(s, index), action_text(s, index)));
    if (const Attachment* attached = attachment_of(s, index)) describe_stiff(s, *attached, lines);
  }
  if (part)
    lines.emplace_back(
        "symmetry: forces and energies, of tools too, are those of the part modelled; "
        "a tool's given force acts on that part");
  if (hinge)
    lines.emplace_back(
        "    note: bending takes a plane of symmetry for a free edge: the ply can fold "
        "along it as on a hinge");
  return lines;
}

} // namespace plyform
