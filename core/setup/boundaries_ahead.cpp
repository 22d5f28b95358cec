// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/boundaries_ahead.hpp"

#include "base/format.hpp"
#include "core/solver/attached_motion.hpp"
#include "core/solver/stable_time_step.hpp"

#include <algorithm>

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

/// Whether a ply that resists bending can fold along a plane of symmetry: where planes are not at
/// right angles.
bool is_hinge(const Scene& s, const Boundary& boundary) {
  for (std::size_t p = 0; p < s.plies.size(); ++p)
    if (s.plies[p].bending && s.plies[p].planes.empty() &&
        (boundary.ply < 0 || at(boundary.ply) == p))
      return true;
  return false;
}

/// What the line of a boundary says of its kind, and of what it does.
struct KindAhead {
  const Scene& s;
  int boundary;

  struct Words {
    std::string kind;   ///< "spring of 0.5 N/mm", "gripper"
    std::string action; ///< ", moves 20 mm"; empty for a plane of symmetry
  };

  Words operator()(const Grip& grip) const { return {"grip", moves(grip.stroke, {})}; }
  Words operator()(const HingedFrame& frame) const { return {"frame", moves(frame.stroke, {})}; }
  Words operator()(const SymmetryPlane&) const { return {"plane of symmetry", {}}; }
  Words operator()(const TensionSpring& spring) const {
    const Attachment& attached = *attachment_of(s, boundary);
    std::string text = fmt::format(", {:.4g} mm long, {:.4g} mm without a load, {:.4g} N at the "
                                   "start",
                                   attached.length, attached.natural_length,
                                   spring_tension(spring, attached, attached.length, 1.0));
    if (spring.carrier >= 0) text += ", carried by " + s.data.tools[spring.carrier].name;
    return {fmt::format("spring of {:g} N/mm", spring.stiffness), text};
  }
  Words operator()(const Gripper& gripper) const {
    const Vec3& way = gripper.direction;
    const std::string along =
        fmt::format(" along ({:.3g}, {:.3g}, {:.3g})", way.x(), way.y(), way.z());
    const std::string action =
        gripper.force > 0.0
            ? fmt::format(", pulled by {:g} N{}{}", gripper.force, along, stages())
            : fmt::format(", on {:g} N/mm{}", gripper.stiffness, moves(gripper.stroke, along));
    return {gripper.guided ? "gripper on a rail" : "gripper", action};
  }

private:
  std::string moves(double stroke, const std::string& along) const {
    if (stroke == 0.0) return ", stays";
    return fmt::format(", moves {:g} mm{}{}", stroke, along, stages());
  }
  std::string stages() const {
    const std::size_t count = programme_of(s.data.boundaries[boundary]).size();
    if (count == 0) return {};
    return fmt::format(" at most, in {} {}", count, count == 1 ? "stage" : "stages");
  }
};

/// Warns of a spring or drive that is stiffer, for the mass of its nodes, than any element: steps
/// get shorter by it.
void describe_stiff(const Scene& s, const Attachment& attached, std::vector<std::string>& lines) {
  ContactRows rows;
  for (std::size_t p = 0; p < s.plies.size(); ++p) {
    rows.emplace_back(s.plies[p].x.size());
    add_attachment_stiffness(s, s, p, rows.back());
  }
  double ratio = 0.0; // of omega^2
  for (const AttachedNode& node : attached.nodes) {
    const PlyBody& ply = s.plies[node.ply];
    ratio = std::max(ratio, rows[node.ply][node.node].stiffness / ply.mass[node.node] /
                                element_omega2(ply));
  }
  if (ratio <= 1.0) return;
  const Boundary& b = s.data.boundaries[attached.boundary];
  const bool spring = b.is<TensionSpring>();
  lines.push_back(fmt::format("    warning: {:g} N/mm on so little mass shorten the step, of "
                              "elements alone {:.2g} times as "
                              "long; {}",
                              spring ? b.as<TensionSpring>().stiffness : b.as<Gripper>().stiffness,
                              std::sqrt(1.0 + ratio),
                              spring ? "less stiffness, or more of the edge for it, avoid it"
                                     : "less stiffness, or the mass of the gripper, avoid it"));
}

} // namespace

std::vector<std::string> boundaries_ahead(const Scene& s) {
  std::vector<std::string> lines;
  bool part = false, hinge = false;
  for (std::size_t b = 0; b < s.data.boundaries.size(); ++b) {
    const Boundary& boundary = s.data.boundaries[b];
    const int index = static_cast<int>(b);
    const bool plane = boundary.is<SymmetryPlane>();
    part = part || plane;
    hinge = hinge || (plane && is_hinge(s, boundary));
    const KindAhead::Words words = std::visit(KindAhead{s, index}, boundary.kind);
    lines.push_back(fmt::format("boundary {}: {}, holds {}{}", boundary.name, words.kind,
                                nodes_held(s, index), words.action));
    if (const Attachment* attached = attachment_of(s, index)) describe_stiff(s, *attached, lines);
  }
  if (!s.data.part_at.empty())
    lines.emplace_back("symmetry: forces, energies and fields are those of the whole");
  else if (part)
    lines.emplace_back(
        "symmetry: forces and energies, of tools too, are those of the part modelled; "
        "a tool's given force acts on that part");
  if (hinge)
    lines.emplace_back(
        "    note: bending takes planes of symmetry that are not at right angles for free "
        "edges: the ply can fold along them as on hinges");
  return lines;
}

} // namespace plyform
