// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_variants.hpp"

#include "core/mesh/bisection.hpp"

#include <utility>

namespace plyform {

BlankMesh bisected(const BlankMesh& mesh) {
  Bisection b = start_bisection(mesh);
  bisect(b, std::vector<char>(mesh.triangles.size(), 1));
  return std::move(b.mesh);
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
