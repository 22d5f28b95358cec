// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in a DXF drawing, as far as outlines need it. Types of dxflib are used in
// dxf_drawing.cpp only.
#pragma once

#include "core/drawing/dxf_curve.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// The insertion of a block, in the drawing's unit.
struct DxfInsert {
  std::string block;
  Vec2 at = Vec2::Zero(), scale = Vec2::Ones();
  double angle = 0.0; ///< rad
  bool array = false, from_below = false;
};

/// An entity of the model space, in the drawing's unit.
struct DxfEntity {
  /// LINE, ARC, CIRCLE, ELLIPSE, SPLINE, LWPOLYLINE, POLYLINE, INSERT, or one that is not supported
  std::string name;
  std::string layer;
  int line = 0;                      ///< of the file, where it begins
  Profile chain{};                   ///< lines and arcs; empty if it has no length or is a curve
  std::optional<DxfCurve> curve{};   ///< of an ellipse or a spline, which are to be divided
  std::optional<DxfInsert> insert{}; ///< resolved in what read_dxf returns, unless it has a fault
  std::string fault{};               ///< why it cannot be part of an outline; empty if it can
  bool marked_closed = false;        ///< a spline that is said to be closed, whether it is or not
};

struct DxfDrawing {
  int unit = 0; ///< $INSUNITS, 0 if there is none
  std::vector<DxfEntity> entities;
};

/// Reads an ASCII DXF file by dxflib, in a process of its own, with blocks where they are inserted
/// (core/drawing/dxf_blocks.hpp). Left out are texts, dimensions and
/// other entities that are no geometry. Throws std::runtime_error ("rule; remedy", without the
/// file's name): no such file, DWG, binary, no DXF, cut short, lines that dxflib would take
/// for others, dxflib crashed.
DxfDrawing read_dxf(const std::filesystem::path& file);

} // namespace plyform
