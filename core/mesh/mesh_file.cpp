// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the mesh of a blank from STL, OBJ, PLY or OFF as a triangle soup. Triangles are
// oriented anticlockwise and equal nodes merged (STL repeats them); any other defect is an error.
#include "base/format.hpp"
#include "base/polygon_file.hpp"
#include "core/mesh/mesher_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace plyform {
namespace {

/// Largest deviation from a plane over the blank's size; a binary STL rounds to 6e-8.
constexpr double flat = 1e-6;
/// Height over longest side below which a triangle counts as having no area.
constexpr double thin = 1e-6;

std::string text(const Vec2& p) {
  return fmt::format("({:.6g}, {:.6g})", p.x(), p.y());
}

void check_soup(const PolygonSoup& soup) {
  constexpr double most = 1e5; // mm, as lengths in a case
  if (soup.polygons.empty())
    throw std::runtime_error("holds no triangles; it may be cut short, export it again");
  Eigen::AlignedBox3d box;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    if (soup.polygons[f].size() != 3)
      throw std::runtime_error(fmt::format("face {} has {} corners; export the mesh as triangles",
                                           f, soup.polygons[f].size()));
    for (const std::size_t n : soup.polygons[f]) {
      const Vec3& x = soup.points[n];
      if (x.cwiseAbs().maxCoeff() > most)
        throw std::runtime_error(
            fmt::format("node {} of face {} lies more than 100 m away; check the file's "
                        "unit, which is taken for mm",
                        n, f));
      box.extend(x);
    }
  }
  const double rise = box.sizes().z();
  if (!(rise <= flat * box.sizes().head<2>().maxCoeff()))
    throw std::runtime_error(
        fmt::format("is not flat, z runs from {:g} to {:g} mm; a blank needs the same z everywhere",
                    box.min().z(), box.max().z()));
}

/// Merges equal nodes, numbers used ones in order of first use and orients triangles anticlockwise.
BlankMesh join(const PolygonSoup& soup) {
  BlankMesh mesh;
  std::map<std::pair<double, double>, std::int32_t> node;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = soup.points[soup.polygons[f][k]];
      const auto next = static_cast<std::int32_t>(mesh.x.size());
      const auto [entry, added] = node.try_emplace({p.x(), p.y()}, next);
      if (added) mesh.x.emplace_back(p.x(), p.y());
      t[k] = entry->second;
    }
    const Vec2 a = mesh.x[t[0]];
    const Vec2 ab = mesh.x[t[1]] - a;
    const Vec2 ac = mesh.x[t[2]] - a;
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    if (!(std::abs(cross(ab, ac)) > thin * longest))
      throw std::runtime_error(fmt::format(
          "triangle {} at {} has no area; collapse its shortest edge or mesh the blank again", f,
          text(a)));
    if (cross(ab, ac) < 0) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// The directed edges, sorted. Throws unless each, and each reverse, occurs at most once
/// (manifold).
std::vector<Edge> checked_edges(const BlankMesh& mesh) {
  std::vector<Edge> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({t[k], t[(k + 1) % 3]});
  std::sort(edges.begin(), edges.end());
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice != edges.end())
    throw std::runtime_error(
        fmt::format("is not manifold, triangles overlap along the edge from {} to {}: it is shared "
                    "by more than "
                    "two triangles or two on the same side; remove the surplus ones",
                    text(mesh.x[(*twice)[0]]), text(mesh.x[(*twice)[1]])));
  return edges;
}

/// Throws if more than one boundary edge starts at a node: parts of the mesh then meet at it only.
void check_nodes(const BlankMesh& mesh, const std::vector<Edge>& edges) {
  std::vector<char> touches_boundary_edge(mesh.x.size(), 0);
  for (const Edge& e : edges) {
    if (std::binary_search(edges.begin(), edges.end(), Edge{e[1], e[0]})) continue;
    char& seen = touches_boundary_edge[e[0]];
    if (seen)
      throw std::runtime_error(fmt::format(
          "is not manifold, parts of it meet only in the node at {}; join them along an "
          "edge or part them",
          text(mesh.x[e[0]])));
    seen = 1;
  }
}

void check_one_piece(const BlankMesh& mesh, const std::vector<Edge>& edges) {
  std::vector<std::int32_t> root(mesh.x.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t n) {
    while (root[n] != n)
      n = root[n] = root[root[static_cast<std::size_t>(n)]];
    return n;
  };
  for (const Edge& e : edges)
    root[find(e[0])] = find(e[1]);
  for (std::int32_t n = 0; n < static_cast<std::int32_t>(mesh.x.size()); ++n)
    if (find(n) != find(0))
      throw std::runtime_error(
          fmt::format("falls into separate pieces, one at {}, one at {}; join nodes that should be "
                      "one, or give each piece as a blank of its own",
                      text(mesh.x[0]), text(mesh.x[n])));
}

} // namespace

BlankMesh blank_from_file(const std::filesystem::path& file) {
  try {
    const PolygonSoup soup = read_polygons(file);
    check_soup(soup);
    BlankMesh mesh = join(soup);
    const std::vector<Edge> edges = checked_edges(mesh);
    check_nodes(mesh, edges);
    check_one_piece(mesh, edges);
    return mesh;
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("blank file {}: {}", file.string(), error.what()));
  }
}

} // namespace plyform
