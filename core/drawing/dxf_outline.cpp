// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/drawing/dxf_outline.hpp"

#include "base/format.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "core/drawing/dxf_drawing.hpp"
#include "core/mesh/mesh_blank.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

namespace plyform {
namespace {

struct Fault {
  std::string text;
};

std::string point_text(const Vec2& p) {
  return fmt::format("({:.6g}, {:.6g})", p.x(), p.y());
}

/// A code of $INSUNITS, its unit as base/units.hpp has it, and in words.
struct DrawingUnit {
  int code;
  const char *name, *words;
  double mm() const { return find_unit(name)->factor; }
};
constexpr DrawingUnit drawing_units[] = {
    {1, "in", "inches"}, {2, "ft", "feet"},   {3, "mile", "miles"},     {4, "mm", "mm"},
    {5, "cm", "cm"},     {6, "m", "metres"},  {7, "km", "km"},          {8, "uin", "microinches"},
    {9, "mil", "mils"},  {10, "yd", "yards"}, {12, "nm", "nanometres"}, {13, "um", "micrometres"},
    {14, "dm", "dm"}};

std::string known_codes() {
  std::vector<std::string> codes;
  for (const DrawingUnit& unit : drawing_units)
    codes.push_back(fmt::format("{} {}", unit.code, unit.words));
  return joined(codes);
}

/// mm per unit of the drawing, and the unit in words.
std::pair<double, std::string> unit_of(const DxfDrawing& drawing, const DxfRequest& request) {
  if (request.scale) return {*request.scale, fmt::format("{:g} mm a unit", *request.scale)};
  if (drawing.unit == 0) return {1.0, "no unit given, taken for mm"};
  for (const DrawingUnit& unit : drawing_units)
    if (unit.code == drawing.unit) return {unit.mm(), fmt::format("in {}", unit.words)};
  throw Fault{
      fmt::format("its unit ($INSUNITS = {}) is not known; give the mm per unit (scale), or "
                  "save it in one of {}",
                  drawing.unit, known_codes())};
}

Profile reversed(const Profile& chain) {
  Profile back(chain.rbegin(), chain.rend());
  for (ProfileSegment& s : back) {
    std::swap(s.a, s.b);
    s.turn = -s.turn;
  }
  return back;
}

/// Open chains whose ends are to be joined; end 2 i is the start of chain i, 2 i + 1 its end.
struct Joiner {
  std::vector<const DxfEntity*> pieces;
  double near;  ///< in the drawing's unit
  double scale; ///< mm per unit
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells{};

  Vec2 at(std::size_t end) const {
    const Profile& chain = pieces[end / 2]->chain;
    return end % 2 ? chain.back().b : chain.front().a;
  }
  std::pair<long, long> cell(const Vec2& p) const {
    return {std::lround(std::floor(p.x() / near)), std::lround(std::floor(p.y() / near))};
  }
  std::size_t mate(std::size_t end) const;
  [[noreturn]] void report_gap(std::size_t end) const;
  std::vector<Profile> loops();
};

void Joiner::report_gap(std::size_t end) const {
  const Vec2 p = at(end);
  std::size_t nearest = end;
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < 2 * pieces.size(); ++other)
    if (const double d = (at(other) - p).norm(); other != end && d < gap) gap = d, nearest = other;
  // flag of a spline whose control points are not repeated, and whose knots do not go round
  const bool alone = nearest / 2 == end / 2 && pieces[end / 2]->marked_closed;
  throw Fault{fmt::format("line {}: the outline is open: {} ends at {}, the nearest other end, at "
                          "{}, is {:.3g} mm away, and ends within {:g} mm are joined; {}",
                          pieces[end / 2]->line, pieces[end / 2]->name, point_text(p),
                          point_text(at(nearest)), gap * scale, dxf_join,
                          alone ? "it is marked as closed (group 70), but its knots are those of "
                                  "an open spline, clamped at both ends: save it as a periodic "
                                  "spline or a polyline, or join its ends by a line"
                                : "close it in the drawing")};
}

/// The one other end at the place of an end.
std::size_t Joiner::mate(std::size_t end) const {
  const Vec2 p = at(end);
  const auto [i, j] = cell(p);
  std::vector<std::size_t> found;
  for (long di = -1; di <= 1; ++di)
    for (long dj = -1; dj <= 1; ++dj)
      if (const auto here = cells.find({i + di, j + dj}); here != cells.end())
        for (const std::size_t other : here->second)
          if (other != end && (at(other) - p).norm() <= near) found.push_back(other);
  if (found.empty()) report_gap(end);
  if (found.size() > 1)
    throw Fault{fmt::format("line {}: more than two ends meet at {}; take doubled lines and those "
                            "that are no outline out, or name the outline's layer (layer)",
                            pieces[end / 2]->line, point_text(p))};
  return found[0];
}

std::vector<Profile> Joiner::loops() {
  for (std::size_t end = 0; end < 2 * pieces.size(); ++end)
    cells[cell(at(end))].push_back(end);
  std::vector<Profile> closed;
  std::vector<char> used(pieces.size(), 0);
  for (std::size_t first = 0; first < pieces.size(); ++first) {
    if (used[first]) continue;
    Profile loop;
    for (std::size_t start = 2 * first; !used[start / 2];) {
      used[start / 2] = 1;
      Profile part = pieces[start / 2]->chain;
      if (start % 2) part = reversed(part);
      if (!loop.empty()) part.front().a = loop.back().b; // one and the same point
      loop.insert(loop.end(), part.begin(), part.end());
      const std::size_t end = start ^ 1U;
      start = mate(end);
      if (mate(start) != end) report_gap(end); // never: nearness goes both ways
    }
    loop.back().b = loop.front().a;
    closed.push_back(std::move(loop));
  }
  return closed;
}

struct ClosedLoop {
  Profile chain;
  double area; ///< in the drawing's unit
  Eigen::AlignedBox2d box{};
  std::vector<Vec2> polygon{};
};

ClosedLoop measured(Profile chain) {
  Outline alone;
  append_loop(alone, chain);
  ClosedLoop loop{std::move(chain), area_of(alone)};
  loop.polygon = points_of(alone, std::numbers::pi / 16.0);
  for (const Vec2& p : loop.polygon)
    loop.box.extend(p);
  return loop;
}

bool lies_in(const Vec2& p, const std::vector<Vec2>& polygon) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x()) inside = !inside;
  }
  return inside;
}

std::string extents_text(const ClosedLoop& loop, double scale) {
  const Vec2 size = scale * loop.box.sizes();
  return fmt::format("{:.6g} x {:.6g} mm about {}", size.x(), size.y(),
                     point_text(loop.box.center()));
}

/// The entities of the layer asked for, all of them fit for an outline.
std::vector<DxfEntity*> chosen(DxfDrawing& drawing, const DxfRequest& request) {
  std::vector<DxfEntity*> pieces;
  std::set<std::string> layers;
  for (DxfEntity& e : drawing.entities) {
    layers.insert(e.layer);
    if (!request.layer.empty() && e.layer != request.layer) continue;
    if (!e.fault.empty())
      throw Fault{fmt::format("line {}: {} on layer {} {}; make lines, arcs, circles or polylines "
                              "of it, or name the outline's layer (layer)",
                              e.line, shown(e.name), shown(e.layer), e.fault)};
    if (!e.chain.empty() || e.curve) pieces.push_back(&e);
  }
  if (!pieces.empty()) return pieces;
  const std::string names = joined({layers.begin(), layers.end()});
  if (!request.layer.empty() && !layers.empty())
    throw Fault{fmt::format("layer {} has no lines, arcs, circles or polylines; the layers that "
                            "have any are {}",
                            shown(request.layer), shown(names, 300))};
  throw Fault{"has no lines, arcs, circles or polylines; draw the outline as a closed line"};
}

std::vector<ClosedLoop> closed_loops(const std::vector<DxfEntity*>& pieces, double scale) {
  std::vector<ClosedLoop> loops;
  Joiner joiner{{}, dxf_join / scale, scale};
  for (const DxfEntity* piece : pieces) {
    const Profile& chain = piece->chain;
    if (chain.empty()) continue; // a curve of no length
    if (chain.front().a == chain.back().b)
      loops.push_back(measured(chain));
    else
      joiner.pieces.push_back(piece);
  }
  for (Profile& loop : joiner.loops())
    loops.push_back(measured(std::move(loop)));
  std::stable_sort(loops.begin(), loops.end(),
                   [](const ClosedLoop& a, const ClosedLoop& b) { return a.area > b.area; });
  return loops;
}

/// Outlines drawn in another unit than the file says.
void check_size(const ClosedLoop& loop, double scale, const std::string& unit,
                const DxfRequest& request) {
  constexpr double least = 5.0, most = 20000.0; // mm
  const double size = scale * loop.box.sizes().maxCoeff();
  if (request.scale || (size >= least && size <= most)) return;
  throw Fault{fmt::format("the outline is {}, {}, and blanks are {:g} to {:g} mm long; give the mm "
                          "per unit (scale): {}",
                          extents_text(loop, scale), unit, least, most,
                          size < least   ? "1000 if it is drawn in metres, 25.4 if in inches"
                          : scale == 1.0 ? "0.001 if it is drawn in micrometres"
                                         : "1 if it is drawn in mm")};
}

DxfOutline outline_of(DxfDrawing drawing, const DxfRequest& request) {
  constexpr std::size_t most = 20000;
  const std::vector<DxfEntity*> pieces = chosen(drawing, request);
  const auto [scale, unit] = unit_of(drawing, request);
  std::size_t count = 0;
  for (DxfEntity* piece : pieces) {
    if (piece->curve && count <= most)
      piece->chain = divided(*piece->curve, request.spacing / scale, most + 1);
    count += piece->chain.size();
  }
  if (count > most)
    throw Fault{fmt::format("has {} lines and arcs, more than {}; name the outline's layer (layer)",
                            count, most)};
  if (count == 0) throw Fault{"has curves of no length only; draw the outline as a closed line"};
  const std::vector<ClosedLoop> loops = closed_loops(pieces, scale);
  DxfOutline made;
  for (const ClosedLoop& loop : loops) {
    if (&loop != &loops[0] && !lies_in(loop.polygon[0], loops[0].polygon))
      throw Fault{fmt::format("has two outlines, of {} and of {}, and a blank has one; leave one "
                              "of them, or name its layer (layer)",
                              extents_text(loops[0], scale), extents_text(loop, scale))};
    Profile chain = loop.chain;
    for (ProfileSegment& s : chain)
      s.a *= scale, s.b *= scale, s.centre *= scale;
    append_loop(made.outline, chain);
  }
  check_size(loops[0], scale, unit, request);
  std::set<std::string> layers;
  for (const DxfEntity* piece : pieces)
    layers.insert(piece->layer);
  const Vec2 size = scale * loops[0].box.sizes();
  made.description = fmt::format("{}: {:.4g} x {:.4g} mm, {} hole{}, layer {}, {}",
                                 request.file.filename().string(), size.x(), size.y(),
                                 loops.size() - 1, loops.size() == 2 ? "" : "s",
                                 shown(joined({layers.begin(), layers.end()}), 200), unit);
  return made;
}

} // namespace

double unit_named_in(const std::string& description) {
  for (const DrawingUnit& unit : drawing_units)
    if (description.ends_with(fmt::format("in {}", unit.words))) return unit.mm();
  return 1.0;
}

DxfOutline read_dxf_outline(const DxfRequest& request) {
  const std::string name = request.file.string();
  try {
    return outline_of(read_dxf(request.file), request);
  } catch (const Fault& fault) {
    throw std::runtime_error(name + ": " + fault.text);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(name + " " + error.what());
  }
}

} // namespace plyform
