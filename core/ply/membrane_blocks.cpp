// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of strain groups for core/ply/membrane_simd.hpp.
#include "core/ply/membrane_simd.hpp"

namespace plyform {
namespace {

constexpr int block_groups = 512; // groups per block: outweighs scheduling, still balances threads

/// Numbers of the strain groups in an order in which neighbours are near each other (Morton).
std::vector<int> ordered_groups(const Membrane& m, std::span<const Vec3> x) {
  Box3 box;
  for (const Vec3& p : x)
    box.extend(p);
  std::vector<Vec3> centres;
  for (int p = 0; p < m.groups(); ++p) {
    const Triangle& t = m.triangles[m.group_begin[static_cast<std::size_t>(p)]];
    Vec3& centre = centres.emplace_back(Vec3::Zero());
    for (const int n : t)
      centre += x[n] / 3.0;
  }
  return morton_order(centres, box);
}

/// Builds the blocks one after the other.
class MembraneBlockMaker {
public:
  MembraneBlockMaker(const Membrane& membrane, std::size_t nodes, MembraneSimd& lanes_,
                     std::vector<SimdTriangles>& triangles_)
      : m(membrane), out(lanes_), triangles(triangles_), local(nodes, -1) {}

  void add(int group) {
    if (static_cast<int>(pairs.size() + singles.size()) == block_groups ||
        static_cast<int>(list.size()) + 4 > most_block_nodes)
      close();
    (size(group) == 2 ? pairs : singles).push_back(group);
    for (int e = first(group); e < first(group) + size(group); ++e)
      for (const int n : m.triangles[e]) {
        std::int32_t& number = local[n];
        if (number < 0) number = static_cast<std::int32_t>(list.size()), list.push_back(n);
      }
  }

  void close() {
    if (list.empty()) return;
    SimdBlock block;
    block.first_node = static_cast<int>(out.nodes.size());
    block.nodes = static_cast<int>(list.size());
    block.first_triangles = static_cast<int>(triangles.size());
    block.first_group = out.packs;
    block.pair_packs = add_groups(pairs, 2);
    block.single_packs = add_groups(singles, 1);
    out.blocks.push_back(block);
    out.nodes.insert(out.nodes.end(), list.begin(), list.end());
    for (const int n : list)
      local[n] = -1;
    list.clear(), pairs.clear(), singles.clear();
  }

private:
  int first(int group) const { return m.group_begin[group]; }
  int size(int group) const {
    return m.group_begin[static_cast<std::size_t>(group) + 1] - first(group);
  }

  int add_groups(const std::vector<int>& groups, int of) {
    // Each SIMD lane takes one contiguous quarter of the groups, so that neighbouring groups are
    // computed in successive packs of one lane, not in one pack, where they would add forces to the
    // same nodes at once.
    const std::size_t packs = (groups.size() + simd_width - 1) / simd_width;
    for (std::size_t pack = 0; pack < packs; ++pack) {
      for (std::size_t lane = 0; lane < simd_width; ++lane) {
        const std::size_t i_group = lane * packs + pack;
        out.groups.push_back(i_group < groups.size() ? groups[i_group] : -1);
      }
      for (int i = 0; i < of; ++i) {
        SimdTriangles& t = triangles.emplace_back();
        for (std::size_t lane = 0; lane < simd_width; ++lane) {
          const std::size_t i_group = lane * packs + pack;
          const bool filler = i_group >= groups.size();
          const int group = groups[filler ? groups.size() - 1 : i_group];
          set(t, lane, group, first(group) + i, filler);
        }
      }
    }
    out.packs += static_cast<int>(packs);
    return static_cast<int>(packs);
  }

  void set(SimdTriangles& t, std::size_t lane, int group, int triangle, bool filler) const {
    const auto e = static_cast<std::size_t>(triangle);
    const AxesGradients& c = m.c[e];
    t.c11[lane] = c.c11, t.c12[lane] = c.c12, t.c21[lane] = c.c21, t.c22[lane] = c.c22;
    double group_area = 0.0;
    for (int i = first(group); i < first(group) + size(group); ++i)
      group_area += m.area[i];
    t.area[lane] = filler ? 0.0 : m.area[e];
    t.share[lane] = m.area[e] / group_area;
    for (std::size_t corner = 0; corner < 3; ++corner)
      t.node[corner][lane] = static_cast<std::uint16_t>(local[m.triangles[e][corner]] * 32);
  }

  const Membrane& m;
  MembraneSimd& out;
  std::vector<SimdTriangles>& triangles;
  std::vector<std::int32_t> local; ///< per node of the ply: its index in the current block, or -1
  std::vector<std::int32_t> list;  ///< nodes of the current block
  std::vector<int> pairs, singles;
};

} // namespace

MembraneSimd make_membrane_simd(const Membrane& m, std::span<const Vec3> x) {
  MembraneSimd out;
  std::vector<SimdTriangles> triangles;
  MembraneBlockMaker maker(m, x.size(), out, triangles);
  for (const int group : ordered_groups(m, x))
    maker.add(group);
  maker.close();
  triangles.shrink_to_fit(), out.nodes.shrink_to_fit();
  out.triangles = std::make_shared<const std::vector<SimdTriangles>>(std::move(triangles));
  find_node_forces(out, x.size());
  return out;
}

} // namespace plyform
