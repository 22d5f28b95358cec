// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh of an arbitrary outline: regular cells wholly inside it, joined to it by a band of
// triangles.
//
// The cells come from a lattice of sides h along the directions a and b, through the middle of the
// outline's bounding box. The band is meshed by Delaunay refinement between the outline, cut into
// pieces of about h, and the stepped boundary of the cells; lattice nodes in the band are used as
// well. Where refinement has split a side of a cell, that cell is removed, its area is added to the
// band, and the band is meshed again, until no cell has a split side.
#include "core/mesh/mesher_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plyform {
namespace {

/// Smallest distance of lattice nodes and cells from the outline, over h. With half a piece of the
/// outline no node lies in the diametral circle of a piece, where the mesher would split it.
/// Measured with 0.4, 0.45, 0.5, 0.55: smallest height over h 0.23, 0.26, 0.31, 0.34 (grid: 0.71);
/// with 0.5 no piece of h is split.
constexpr double margin = 0.5;
/// Degrees; up to 20.7 the termination of the mesher is proven.
constexpr double min_angle = 20.0;

/// Node (i, j) at origin + i ha + j hb for 0 <= i < ni, 0 <= j < nj; cell (i, j) has it as its p00.
struct Lattice {
  Vec2 origin, ha, hb;
  int ni = 0, nj = 0;

  Vec2 at(double i, double j) const { return origin + ha * i + hb * j; }
  Vec2 coordinates(const Vec2& p) const {
    return Vec2(cross(p - origin, hb), cross(ha, p - origin)) / cross(ha, hb);
  }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(ni) + static_cast<std::size_t>(i);
  }
  bool holds(int i, int j) const { return i >= 0 && j >= 0 && i < ni && j < nj; }
};

Lattice lattice_over(const std::vector<Vec2>& boundary, double h,
                     const CellDirections& directions) {
  Eigen::AlignedBox2d box;
  for (const Vec2& p : boundary)
    box.extend(p);
  Lattice lattice{box.center(), h * directions.a, h * directions.b};
  Eigen::AlignedBox2d range;
  for (const Vec2& p : boundary)
    range.extend(lattice.coordinates(p));
  const Vec2 low = range.min().array().floor(), high = range.max().array().ceil();
  lattice.origin = lattice.at(low.x(), low.y());
  lattice.ni = static_cast<int>(high.x() - low.x()) + 1;
  lattice.nj = static_cast<int>(high.y() - low.y()) + 1;
  return lattice;
}

/// Flags by Lattice::index.
struct Use {
  std::vector<char> node, cell;
};

/// Nodes inside the outline: in each row an odd number of sides lies to the left of them. Nodes
/// within rounding of a side may count as inside or outside.
std::vector<char> nodes_inside(const Lattice& lattice, const Region& outline) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(lattice.nj));
  for (const Edge& e : outline.edges) {
    Vec2 p = lattice.coordinates(outline.x[e[0]]);
    Vec2 q = lattice.coordinates(outline.x[e[1]]);
    if (p.y() > q.y()) std::swap(p, q);
    for (int j = std::max(0, static_cast<int>(std::ceil(p.y()))); j < q.y() && j < lattice.nj; ++j)
      crossings[j].push_back(p.x() + (q.x() - p.x()) * (j - p.y()) / (q.y() - p.y()));
  }
  std::vector<char> inside(lattice.index(0, lattice.nj), 0);
  for (int j = 0; j < lattice.nj; ++j)
    for (int i = 0; i < lattice.ni; ++i) {
      const auto& row = crossings[j];
      inside[lattice.index(i, j)] =
          std::count_if(row.begin(), row.end(), [&](double u) { return u < i; }) % 2 != 0;
    }
  return inside;
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double s = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - s * ab).norm();
}

/// Smallest distance between two segments that do not cross.
double distance(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return std::min({distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
}

/// Distance of cell (i, j) from the piece pq of the outline; 0 if it begins in the cell.
double distance(const Lattice& lattice, int i, int j, const Vec2& p, const Vec2& q) {
  const Vec2 uv = lattice.coordinates(p);
  if (uv.x() >= i && uv.x() <= i + 1 && uv.y() >= j && uv.y() <= j + 1) return 0.0;
  const std::array<Vec2, 4> c{lattice.at(i, j), lattice.at(i + 1, j), lattice.at(i + 1, j + 1),
                              lattice.at(i, j + 1)};
  return std::min({distance(c[0], c[1], p, q), distance(c[1], c[2], p, q),
                   distance(c[2], c[3], p, q), distance(c[3], c[0], p, q)});
}

/// Marks nodes and cells closer than `least` (mm) to the outline as not used.
void keep_away(const Lattice& lattice, const Region& outline, double least, Use& use) {
  const double reach = least * lattice.ha.norm() / cross(lattice.ha, lattice.hb); // in i and j
  for (const Edge& e : outline.edges) {
    const Vec2 p = outline.x[e[0]];
    const Vec2 q = outline.x[e[1]];
    const Vec2 up = lattice.coordinates(p), uq = lattice.coordinates(q);
    const Vec2 low = (up.cwiseMin(uq).array() - reach).floor();
    const Vec2 high = up.cwiseMax(uq).array() + reach;
    for (int j = static_cast<int>(low.y()); j <= high.y(); ++j)
      for (int i = static_cast<int>(low.x()); i <= high.x(); ++i) {
        if (!lattice.holds(i, j)) continue;
        if (distance(lattice.at(i, j), p, q) < least) use.node[lattice.index(i, j)] = 0;
        if (distance(lattice, i, j, p, q) < least) use.cell[lattice.index(i, j)] = 0;
      }
  }
}

/// Nodes inside and away from the outline, and the cells that have all their nodes.
Use usable(const Lattice& lattice, const Region& outline, double least) {
  Use use{nodes_inside(lattice, outline), {}};
  use.cell.assign(use.node.size(), 1);
  keep_away(lattice, outline, least, use);
  const auto node = [&](int i, int j) {
    return lattice.holds(i, j) && use.node[lattice.index(i, j)];
  };
  for (int j = 0; j < lattice.nj; ++j)
    for (int i = 0; i < lattice.ni; ++i)
      if (!(node(i, j) && node(i + 1, j) && node(i + 1, j + 1) && node(i, j + 1)))
        use.cell[lattice.index(i, j)] = 0;
  return use;
}

/// Node numbers in order of use, row by row; -1 for nodes out of use.
std::vector<std::int32_t> number_nodes(const std::vector<char>& use) {
  std::vector<std::int32_t> number(use.size(), -1);
  std::int32_t n = 0;
  for (std::size_t k = 0; k < use.size(); ++k)
    if (use[k]) number[k] = n++;
  return number;
}

/// Corner nodes of every cell in use (lattice index first), row by row.
struct Cells {
  std::vector<std::size_t> index;
  std::vector<std::array<std::int32_t, 4>> corners;
};

Cells cells_in_use(const Lattice& lattice, const Use& use,
                   const std::vector<std::int32_t>& number) {
  Cells cells;
  const auto row = static_cast<std::size_t>(lattice.ni);
  for (std::size_t k = 0; k < use.cell.size(); ++k)
    if (use.cell[k]) {
      cells.index.push_back(k);
      cells.corners.push_back({number[k], number[k + 1], number[k + row + 1], number[k + row]});
    }
  return cells;
}

/// A side of a cell that no other cell shares.
struct Step {
  Edge edge;        ///< anticlockwise around its cell
  std::size_t cell; ///< index into Cells
};

std::vector<Step> steps_of(const Cells& cells) {
  std::vector<Step> sides;
  for (std::size_t c = 0; c < cells.corners.size(); ++c)
    for (std::size_t k = 0; k < 4; ++k)
      sides.push_back({{cells.corners[c][k], cells.corners[c][(k + 1) % 4]}, c});
  const auto before = [](const Step& s, const Step& t) { return s.edge < t.edge; };
  std::sort(sides.begin(), sides.end(), before);
  std::vector<Step> steps;
  for (const Step& s : sides)
    if (!std::binary_search(sides.begin(), sides.end(), Step{{s.edge[1], s.edge[0]}, 0}, before))
      steps.push_back(s);
  return steps;
}

/// Marks cells with a step that the mesh of the band has split as not used. False if there are
/// none.
bool drop_split_cells(const std::vector<Step>& steps, const Cells& cells, const BlankMesh& band,
                      Use& use) {
  std::vector<Edge> edges;
  for (const Triangle& t : band.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({t[(k + 1) % 3], t[k]}); // as seen from the cell beyond
  std::sort(edges.begin(), edges.end());
  bool dropped = false;
  for (const Step& s : steps)
    if (!std::binary_search(edges.begin(), edges.end(), s.edge)) {
      use.cell[cells.index[s.cell]] = 0;
      dropped = true;
    }
  return dropped;
}

/// Lattice nodes in use, then the outline, joined by the outline's edges.
Region corners(const Lattice& lattice, const Region& outline, const std::vector<char>& use) {
  Region region;
  for (int j = 0; j < lattice.nj; ++j)
    for (int i = 0; i < lattice.ni; ++i)
      if (use[lattice.index(i, j)]) region.x.push_back(lattice.at(i, j));
  const auto first = static_cast<std::int32_t>(region.x.size());
  region.x.insert(region.x.end(), outline.x.begin(), outline.x.end());
  for (const Edge& e : outline.edges)
    region.edges.push_back({first + e[0], first + e[1]});
  return region;
}

} // namespace

BlankMesh cut_blank(const BlankSpec& spec, const CellDirections& directions) {
  const double h = spec.element_size;
  const Region outline = sample_outline(spec.outline, h);
  const Lattice lattice =
      lattice_over(spec.outline.arcs.empty() ? spec.outline.boundary : outline.x, h, directions);
  Use use = usable(lattice, outline, margin * h);
  const std::vector<std::int32_t> number = number_nodes(use.node);
  const Region unstepped = corners(lattice, outline, use.node);

  Cells cells;
  BlankMesh band;
  for (bool whole = false; !whole;) { // terminates: each round has fewer cells
    cells = cells_in_use(lattice, use, number);
    const std::vector<Step> steps = steps_of(cells);
    Region region = unstepped;
    for (const Step& s : steps)
      region.edges.push_back(s.edge);
    band = refine(region, min_angle * degree, 0.0);
    whole = !drop_split_cells(steps, cells, band, use);
  }

  BlankMesh mesh{band.x, {}};
  const auto x = [&](std::int32_t n) { return mesh.x[n]; };
  const Vec2 first = cells.corners.empty() ? Vec2(0, 0) : x(cells.corners.front()[0]);
  const auto odd = [&](const Vec2& corner) { // of the cell in the lattice, counted from the first
    const Vec2 d = (corner - first) / spec.element_size;
    return (std::lround(d.dot(directions.a)) + std::lround(d.dot(directions.b))) % 2 != 0;
  };
  for (const auto& c : cells.corners) {
    append_cell(c, static_cast<std::int32_t>(mesh.x.size()), spec.mesh,
                is_skew(directions) != (spec.mesh == MeshKind::alternating && odd(x(c[0]))),
                mesh.triangles);
    if (spec.mesh == MeshKind::crossed) mesh.x.emplace_back((x(c[0]) + x(c[2])) / 2);
  }
  mesh.triangles.insert(mesh.triangles.end(), band.triangles.begin(), band.triangles.end());
  return mesh;
}

} // namespace plyform
