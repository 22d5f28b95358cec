// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/drawing/dxf_drawing.hpp"

#include "base/archive.hpp"
#include "base/format.hpp"
#include "base/helper_process.hpp"
#include "base/text.hpp"
#include "core/drawing/dxf_blocks.hpp"
#include "core/drawing/dxf_groups.hpp"

#include <algorithm>
#include <cmath>
#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>

namespace plyform {
namespace {

const std::set<std::string> supported{"LINE",   "ARC",    "CIRCLE",     "ELLIPSE",
                                      "SPLINE", "VERTEX", "LWPOLYLINE", "POLYLINE",
                                      "SEQEND", "INSERT", "BLOCK",      "ENDBLK"};
const std::set<std::string> no_geometry{
    "TEXT",   "MTEXT",    "POINT",     "DIMENSION", "LEADER",         "MLEADER", "HATCH", "ATTDEF",
    "ATTRIB", "VIEWPORT", "TOLERANCE", "WIPEOUT",   "ARCALIGNEDTEXT", "XLINE",   "RAY"};

/// Numbers of one entity as dxflib gives them; (x, y, bulge) of each vertex of a polyline; of a
/// spline the degree, (x, y, weight) of each control point, and apart from them the knots; of a
/// BLOCK its base point.
struct RawEntity {
  std::string name, layer;
  std::string block{};    ///< that it is part of; empty in the model space
  std::string inserted{}; ///< name of the block that an INSERT names
  int line = 0, flags = 0;
  bool mirrored = false, tilted = false;
  std::vector<double> numbers{}, knots{};
  std::string fault{};
};

template <class Archive>
void visit(Archive& a, RawEntity& e) {
  visit(a, e.name, e.layer, e.block, e.inserted, e.line, e.flags, e.mirrored, e.tilted, e.numbers,
        e.knots, e.fault);
}

/// Thrown out of dxflib at what follows the end of a drawing, which is no part of it.
struct EndOfDrawing {};

/// Takes what dxflib reads. dxflib tells of an entity when the next one begins.
class Collector : public DL_CreationAdapter {
public:
  int unit = 0;
  bool has_entities = false, ended = false;
  std::vector<RawEntity> entities;

  using DL_CreationAdapter::processCodeValuePair;
  using DL_CreationAdapter::setVariableInt;
  void processCodeValuePair(unsigned int code, const std::string& value) override {
    lines_ += 2;
    if (ended) throw EndOfDrawing{};
    // at which dxflib takes an entity to end, wherever it stands; objects may have texts there
    if (code == 9 && (section_ == "ENTITIES" || section_ == "BLOCKS") &&
        supported.contains(now_.name))
      throw std::runtime_error(
          fmt::format("line {} sets a variable (group 9) within a {}", lines_ - 1, now_.name));
    if (code == 0)
      begin(value);
    else
      now_.groups.add(now_.name, code, value, lines_);
    if (code == 2 && now_.name == "SECTION" && section_.empty()) { // variables have such groups too
      section_ = value;
      has_entities = has_entities || value == "ENTITIES";
    }
    if (code == 8) now_.layer = value;
    if (code == 67 && value == "1") now_.section = "paper space";
  }
  void setVariableInt(const std::string& key, int value, int) override {
    if (key == "$INSUNITS") unit = value;
  }
  void addLine(const DL_LineData& d) override {
    add("LINE", {d.x1, d.y1, d.x2, d.y2}, d.z1 - d.z2);
  }
  void addArc(const DL_ArcData& d) override {
    add("ARC", {d.cx, d.cy, d.radius, d.angle1, d.angle2}, 0.0);
  }
  void addCircle(const DL_CircleData& d) override { add("CIRCLE", {d.cx, d.cy, d.radius}, 0.0); }
  void addEllipse(const DL_EllipseData& d) override {
    add("ELLIPSE", {d.cx, d.cy, d.mx, d.my, d.ratio, d.angle1, d.angle2}, d.mz);
  }
  void addSpline(const DL_SplineData& d) override {
    add("SPLINE", {static_cast<double>(d.degree)}, 0.0);
    if (open_) entities.back().flags = d.flags;
    height_.reset();
  }
  void addKnot(const DL_KnotData& d) override {
    if (open_) entities.back().knots.push_back(d.k);
  }
  void addControlPoint(const DL_ControlPointData& d) override {
    if (!open_) return;
    if (!height_) height_ = d.z;
    RawEntity& spline = entities.back();
    spline.tilted = spline.tilted || is_rise(d.z - *height_);
    spline.numbers.insert(spline.numbers.end(), {d.x, d.y, d.w});
  }
  void addPolyline(const DL_PolylineData& d) override {
    add(before_.name == "LWPOLYLINE" ? "LWPOLYLINE" : "POLYLINE", {}, 0.0);
    if (open_) entities.back().flags = d.flags;
  }
  void addBlock(const DL_BlockData& d) override {
    block_ = d.name;
    add("BLOCK", {d.bpx, d.bpy}, 0.0);
  }
  void endBlock() override { block_.clear(); }
  void addInsert(const DL_InsertData& d) override {
    add("INSERT",
        {d.ipx, d.ipy, d.sx, d.sy, d.angle, static_cast<double>(d.cols),
         static_cast<double>(d.rows)},
        0.0);
    if (open_) entities.back().inserted = d.name;
  }
  void addVertex(const DL_VertexData& d) override {
    if (!open_) return;
    if (before_.name == "VERTEX" && entities.back().fault.empty())
      if (const std::string fault = before_.groups.fault_of("VERTEX"); !fault.empty())
        entities.back().fault = fault + " in a vertex";
    const double x = entities.back().mirrored ? -d.x : d.x;
    const double bulge = entities.back().mirrored ? -d.bulge : d.bulge;
    entities.back().numbers.insert(entities.back().numbers.end(), {x, d.y, bulge});
  }

private:
  struct Begun {
    std::string name, section, layer;
    int line = 0;
    DxfGroups groups{};
  };
  int lines_ = 0;
  std::string section_, block_;
  Begun now_, before_;           ///< the entity whose groups are being read, and the one before
  bool open_ = false;            ///< the last entity may get vertices, knots or control points
  std::optional<double> height_; ///< of the first control point of a spline

  static bool is_rise(double rise) { return std::abs(rise) > 1e-6 * (1.0 + std::abs(rise)); }

  void begin(const std::string& name) {
    before_ = now_;
    if (name == "ENDSEC" || name == "SECTION") section_.clear();
    if (name == "SECTION") block_.clear(); // of a block without an end
    if (name == "EOF") ended = true;
    if (is_geometry() && !supported.contains(before_.name) && !no_geometry.contains(before_.name))
      entities.push_back({before_.name, before_.layer, block_, "", before_.line});
    now_ = {name, section_, "0", lines_};
  }

  bool is_geometry() const {
    return before_.section == "ENTITIES" || (before_.section == "BLOCKS" && !block_.empty());
  }

  /// Takes the numbers that dxflib gives of an entity of this kind.
  void add(std::string_view kind, std::vector<double> numbers, double rise) {
    open_ = is_geometry();
    if (!open_) return;
    if (before_.name != kind)
      throw std::runtime_error(fmt::format("the {} in line {} would be taken for a {}",
                                           shown(before_.name, 30), before_.line, kind));
    RawEntity e{before_.name, before_.layer, block_, "", before_.line};
    const double* normal = getExtrusion()->getDirection();
    // lines and splines are in world coordinates, as are the axes of ellipses
    e.mirrored = before_.name != "LINE" && before_.name != "SPLINE" && normal[2] < 0.0;
    e.tilted = is_rise(rise) || std::hypot(normal[0], normal[1]) > 1e-6 * std::abs(normal[2]);
    e.numbers = std::move(numbers);
    e.fault = before_.groups.fault_of(before_.name);
    entities.push_back(std::move(e));
  }
};

/// All that was collected, as bytes.
std::string packed(const std::filesystem::path& file) {
  Collector collector;
  DL_Dxf dxf;
  try {
    if (!dxf.in(file.string(), &collector)) throw std::runtime_error("cannot be opened");
  } catch (const EndOfDrawing&) {
  }
  SaveArchive archive;
  visit(archive, collector.unit, collector.has_entities, collector.ended, collector.entities);
  return archive.text();
}

ProfileSegment arc_of(const Vec2& centre, double radius, double from, double to, bool mirrored) {
  const auto at = [&](double degrees) {
    const double angle = degrees * degree;
    const double x = centre.x() + radius * std::cos(angle);
    return Vec2(mirrored ? -x : x, centre.y() + radius * std::sin(angle));
  };
  const Vec2 middle(mirrored ? -centre.x() : centre.x(), centre.y());
  return {ProfileSegment::Kind::arc, at(from), at(to), middle, mirrored ? -1 : 1};
}

/// The side of a polyline; bulge: tangent of a quarter of the arc's angle, positive anticlockwise.
ProfileSegment side_of(const Vec2& p, const Vec2& q, double bulge) {
  if (bulge == 0.0) return {ProfileSegment::Kind::line, p, q};
  const Vec2 along = q - p, left(-along.y(), along.x());
  const Vec2 centre = 0.5 * (p + q) + left * ((1.0 - bulge * bulge) / (4.0 * bulge));
  return {ProfileSegment::Kind::arc, p, q, centre, bulge > 0.0 ? 1 : -1};
}

Profile polyline(const RawEntity& e) {
  Profile chain;
  const std::size_t count = e.numbers.size() / 3;
  const auto vertex = [&](std::size_t i) {
    return Vec2(e.numbers[3 * (i % count)], e.numbers[3 * (i % count) + 1]);
  };
  const bool closed = (e.flags & 1) != 0;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i)
    if (vertex(i) != vertex(i + 1))
      chain.push_back(side_of(vertex(i), vertex(i + 1), e.numbers[3 * i + 2]));
  return chain;
}

/// Sets the curve of an ellipse or spline, or why it is none.
template <class Shape>
void set_curve(const Shape& shape, DxfEntity& made) {
  made.fault = fault_of(shape);
  if (made.fault.empty()) made.curve = curve_of(shape);
}

DxfSpline spline_of(const RawEntity& e) {
  DxfSpline s{static_cast<int>(e.numbers[0]), e.knots, {}, (e.flags & 3) != 0};
  for (std::size_t i = 1; i + 2 < e.numbers.size(); i += 3) {
    const double w = e.numbers[i + 2];
    s.points.emplace_back(w * e.numbers[i], w * e.numbers[i + 1], w);
  }
  return s;
}

DxfEntity entity_of(const RawEntity& e) {
  DxfEntity made{e.name, e.layer, e.line, {}, {}, {}, {}, false};
  const std::vector<double>& n = e.numbers;
  constexpr int solid = 8 | 16 | 64, spline = 4; // flags of polylines
  const auto small = [](double x) { return std::abs(x) < 1e9; };
  const bool fits =
      std::all_of(n.begin(), n.end(), small) && std::all_of(e.knots.begin(), e.knots.end(), small);
  const bool round = e.name == "ARC" || e.name == "CIRCLE";
  if (!supported.contains(e.name))
    made.fault = "is not supported";
  else if (!e.fault.empty())
    made.fault = e.fault;
  else if (!fits)
    made.fault = "has a number that is not finite or beyond 1e9";
  else if (e.tilted || (e.name == "POLYLINE" && (e.flags & solid)))
    made.fault = "does not lie in the xy plane";
  else if (e.name == "POLYLINE" && (e.flags & spline))
    made.fault = "is fitted by a spline, which is not supported";
  else if (round && !(n[2] > 0.0))
    made.fault = fmt::format("has the radius {:g}, which must be above 0", n[2]);
  if (!made.fault.empty()) return made;
  if (e.name == "LINE" && Vec2(n[0], n[1]) != Vec2(n[2], n[3]))
    made.chain = {side_of({n[0], n[1]}, {n[2], n[3]}, 0.0)};
  if (e.name == "ARC") made.chain = {arc_of({n[0], n[1]}, n[2], n[3], n[4], e.mirrored)};
  if (e.name == "CIRCLE") {
    made.chain = {arc_of({n[0], n[1]}, n[2], 0.0, 0.0, e.mirrored)};
    made.chain[0].b = made.chain[0].a;
  }
  if (e.name == "ELLIPSE")
    set_curve(DxfEllipse{{n[0], n[1]}, {n[2], n[3]}, n[4], n[5], n[6], e.mirrored}, made);
  if (e.name == "INSERT")
    made.insert =
        DxfInsert{e.inserted, {n[0], n[1]}, {n[2], n[3]}, n[4] * degree, n[5] > 1.0 || n[6] > 1.0,
                  e.mirrored};
  if (e.name == "SPLINE") {
    set_curve(spline_of(e), made);
    made.marked_closed = (e.flags & 1) != 0;
  }
  if (e.name == "POLYLINE" || e.name == "LWPOLYLINE") made.chain = polyline(e);
  return made;
}

DxfDrawing unpacked(const std::string& bytes) {
  DxfDrawing drawing;
  DxfBlocks blocks;
  bool has_entities = false, ended = false;
  std::vector<RawEntity> entities;
  LoadArchive archive(bytes);
  visit(archive, drawing.unit, has_entities, ended, entities);
  if (!has_entities)
    throw std::runtime_error("is no DXF file: it has no ENTITIES; save the drawing as ASCII DXF");
  if (!ended)
    throw std::runtime_error("is cut short: its last line is not EOF; save the drawing anew");
  for (const RawEntity& e : entities)
    if (e.name == "BLOCK" && e.numbers.size() == 2)
      blocks[lower_case(e.block)].base = {e.numbers[0], e.numbers[1]};
    else if (e.name != "BLOCK")
      (e.block.empty() ? drawing.entities : blocks[lower_case(e.block)].entities)
          .push_back(entity_of(e));
  drawing.entities = exploded(drawing.entities, blocks);
  return drawing;
}

/// The content of a file, unless dxflib would take it for an empty drawing.
std::string content_of(const std::filesystem::path& file) {
  if (std::error_code none; !std::filesystem::exists(file, none))
    throw std::runtime_error("is no file; give the path of a drawing, seen from the file that "
                             "names it");
  std::string reason;
  std::optional<std::string> content = read_file(file, most_drawing_bytes, reason);
  if (!content) throw std::runtime_error(reason + "; give the path of a drawing");
  if (content->empty())
    throw std::runtime_error("is empty or cannot be read; save the drawing anew");
  if (content->starts_with("AutoCAD Binary DXF"))
    throw std::runtime_error("is a binary DXF file; save the drawing as ASCII DXF");
  if (content->starts_with("AC10"))
    throw std::runtime_error("is a DWG file; save the drawing as ASCII DXF");
  return *std::move(content);
}

} // namespace

DxfDrawing read_dxf(const std::filesystem::path& file) {
  check_dxf_lines(content_of(file));
  const HelperResult result = in_helper_process([&] { return packed(file); }, HelperLimits{});
  if (result.end == HelperResult::End::timeout)
    throw std::runtime_error("takes too long to read; save the outline alone");
  if (result.end != HelperResult::End::done)
    throw std::runtime_error(
        fmt::format("cannot be read ({}); save the drawing anew", shown(result.text, 200)));
  return unpacked(result.text);
}

} // namespace plyform
