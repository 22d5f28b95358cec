// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/frame_bytes.hpp"

#include "base/archive.hpp"

#include <stdexcept>

namespace plyform {

// Each part with all that results.h5 has of it.

template <class Archive>
void visit(Archive& a, FamilyFrame& family) {
  visit(a, family.name, family.angle_deg);
}

template <class Archive>
void visit(Archive& a, StitchFrame& stitch) {
  visit(a, stitch.name, stitch.angle_deg);
}

template <class Archive>
void visit(Archive& a, CrossingFrame& crossing) {
  visit(a, crossing.suffix);
}

template <class Archive>
void visit(Archive& a, PlyFrame& ply) {
  visit(a, ply.name, ply.angle_deg, ply.x0, ply.x, ply.triangles, ply.families, ply.stitches,
        ply.crossings, ply.load_pressure);
  each_column(ply, [&](const Column&, auto& values) { visit(a, values); });
}

template <class Archive>
void visit(Archive& a, ToolFrame& tool) {
  visit(a, tool.name, tool.surface.x, tool.surface.triangles, tool.displacement, tool.force,
        tool.stroke_mm, tool.force_N, tool.force_raw_N);
}

template <class Archive>
void visit(Archive& a, BoundaryFrame& boundary) {
  visit(a, boundary.name, boundary.force, boundary.stroke_mm, boundary.force_N);
}

template <class Archive>
void visit(Archive& a, Frame& frame) {
  visit(a, frame.time, frame.stroke_mm, frame.step, frame.plies, frame.tools, frame.boundaries);
}

std::string frame_to_bytes(Frame frame) {
  SaveArchive archive;
  visit(archive, frame);
  return archive.text();
}

Frame frame_from_bytes(std::string_view bytes) {
  Frame frame;
  LoadArchive archive(bytes);
  visit(archive, frame);
  if (archive.left() > 0) throw std::runtime_error("bytes follow a frame's");
  return frame;
}

} // namespace plyform
