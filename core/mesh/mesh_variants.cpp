// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_variants.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace plyform {
namespace {

using SideNodes = std::pair<std::int32_t, std::int32_t>;

SideNodes side_of(const Triangle& t, std::size_t k) {
  return std::minmax(t[k], t[(k + 1) % 3]);
}

/// The number (0 to 2) of the longest side; of sides that are equal up to rounding the one with the
/// lower node numbers, for both triangles beside it.
std::size_t longest_of(const BlankMesh& mesh, const Triangle& t) {
  const auto key = [&](std::size_t k) {
    const SideNodes side = side_of(t, k);
    const double length2 = (mesh.x[at(side.second)] - mesh.x[at(side.first)]).squaredNorm();
    return std::tuple(-static_cast<float>(length2), side);
  };
  std::size_t longest = 0;
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
    if (key(k) < key(longest)) longest = k;
  return longest;
}

/// Appends the triangle, or its halves where its side k, with a node in the middle, is cut; halves
/// are cut likewise at their sides of the old mesh.
void append_cut(const std::map<SideNodes, std::int32_t>& middles, const Triangle& t, std::size_t k,
                std::vector<Triangle>& out) {
  const auto middle = middles.find(side_of(t, k));
  if (middle == middles.end()) {
    out.push_back(t);
    return;
  }
  const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], m = middle->second;
  append_cut(middles, {c, a, m}, 0, out); // side c a
  append_cut(middles, {b, c, m}, 0, out);
}

} // namespace

BlankMesh bisected(const BlankMesh& mesh) {
  BlankMesh fine{mesh.x, {}};
  std::map<SideNodes, std::int32_t> middles;
  for (const Triangle& t : mesh.triangles) {
    const SideNodes side = side_of(t, longest_of(mesh, t));
    if (!middles.emplace(side, static_cast<std::int32_t>(fine.x.size())).second) continue;
    fine.x.emplace_back(0.5 * (mesh.x[at(side.first)] + mesh.x[at(side.second)]));
  }
  for (const Triangle& t : mesh.triangles)
    append_cut(middles, t, longest_of(mesh, t), fine.triangles);
  return fine;
}

BlankMesh renumbered(BlankMesh mesh) {
  std::uint64_t state = 1;
  for (std::size_t left = mesh.triangles.size(); left > 1; --left) {
    state = state * 6364136223846793005u + 1442695040888963407u; // Knuth's MMIX generator
    std::swap(mesh.triangles[left - 1], mesh.triangles[(state >> 33) % left]);
  }
  return mesh;
}

} // namespace plyform
