// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/bending_simd.hpp"

#include "base/cpu_features.hpp"
#include "core/ply/viscous_kernel.hpp"

#include <algorithm>
#include <stdexcept>

namespace plyform {
namespace {

/// The slots of one stencil: indices of its nodes within the stencil (0: its centre), the ring
/// first.
struct StencilSlots {
  int stencil = 0;
  std::vector<int> ring, others;
};

/// The nodes around the centre, in the order of the triangles. If the triangles do not form a
/// closed ring, the centre node, whose difference is zero, is inserted between the last and the
/// first.
std::vector<int> ring_of(const Bending& b, std::size_t stencil) {
  std::vector<std::array<int, 2>> links; // the two other nodes of each triangle
  for (auto i = static_cast<std::size_t>(b.fan_begin[stencil]);
       i < static_cast<std::size_t>(b.fan_begin[stencil + 1]); ++i) {
    Triangle t = b.fan[i];
    std::rotate(t.begin(), std::find(t.begin(), t.end(), 0), t.end());
    links.push_back({t[1], t[2]});
  }
  std::vector<int> ring;
  while (!links.empty()) {
    const auto is_start = [&](const auto& link) {
      return std::none_of(links.begin(), links.end(),
                          [&](const auto& other) { return other[1] == link[0]; });
    };
    auto next = std::find_if(links.begin(), links.end(), is_start);
    if (next == links.end()) next = links.begin(); // closed
    const int start = (*next)[0];
    ring.push_back(start);
    while (next != links.end()) {
      ring.push_back((*next)[1]);
      links.erase(next);
      next = std::find_if(links.begin(), links.end(),
                          [&](const auto& link) { return link[0] == ring.back(); });
    }
    if (links.empty() && ring.front() == start && ring.back() == start)
      ring.pop_back(); // closed: the first node is not repeated
    else
      ring.push_back(0);
  }
  return ring;
}

StencilSlots slots_of(const Bending& b, int stencil) {
  const auto p = static_cast<std::size_t>(stencil);
  StencilSlots s{stencil, ring_of(b, p), {}};
  for (int i = 1; i < b.begin[p + 1] - b.begin[p]; ++i)
    if (std::find(s.ring.begin(), s.ring.end(), i) == s.ring.end()) s.others.push_back(i);
  if (s.ring.size() + s.others.size() > most_stencil_slots)
    throw std::length_error("bending: too many nodes around one");
  return s;
}

/// Builds the blocks one after the other.
class BendingBlockMaker {
public:
  BendingBlockMaker(const Bending& bending, BendingSimd& lanes_,
                    std::vector<SimdNumbers>& constants_)
      : b(bending), out(lanes_), constants(constants_),
        local(bending.area.size() + bending.images.size(), -1) {}

  void add(int stencil) {
    const auto p = static_cast<std::size_t>(stencil);
    const std::span<const std::int32_t> nodes(b.node.data() + b.begin[p],
                                              b.node.data() + b.begin[p + 1]);
    const auto fresh =
        std::count_if(nodes.begin(), nodes.end(), [&](int n) { return local[n] < 0; });
    if (static_cast<int>(list.size()) + static_cast<int>(fresh) > most_block_nodes) close();
    for (const int n : nodes) {
      std::int32_t& number = local[n];
      if (number < 0) number = static_cast<std::int32_t>(list.size()), list.push_back(n);
    }
    stencils.push_back(slots_of(b, stencil));
  }

  void close() {
    if (list.empty()) return;
    BendingBlock block;
    block.first_node = static_cast<int>(out.nodes.size());
    block.nodes = static_cast<int>(list.size());
    block.first_group = static_cast<int>(out.stencils.size());
    block.first_slot = out.slots.size() / simd_width;
    add_groups();
    block.groups = static_cast<int>(out.stencils.size()) - block.first_group;
    block.first_image = static_cast<int>(out.images.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto n = static_cast<std::size_t>(list[i]);
      if (n >= b.area.size())
        out.images.push_back({static_cast<std::int32_t>(i), b.images[n - b.area.size()].mirror});
      out.nodes.push_back(static_cast<std::int32_t>(b.of_ply(list[i])));
    }
    block.images = static_cast<int>(out.images.size()) - block.first_image;
    out.blocks.push_back(block);
    for (const int n : list)
      local[n] = -1;
    list.clear(), stencils.clear();
  }

private:
  /// Stencils of one group; null for a SIMD lane without a stencil.
  using Group = std::array<const StencilSlots*, simd_width>;

  static auto size_of(const StencilSlots& p) { return std::pair(p.ring.size(), p.others.size()); }

  /// Groups stencils of equal size by four; the remainders of all sizes are grouped with padding.
  /// Within a size each SIMD lane takes one contiguous quarter of the stencils, so that
  /// neighbouring stencils are computed in successive groups of one lane, not in one group, where
  /// they would add forces to the same nodes at once.
  void add_groups() {
    std::stable_sort(
        stencils.begin(), stencils.end(),
        [](const StencilSlots& p, const StencilSlots& q) { return size_of(p) > size_of(q); });
    std::vector<const StencilSlots*> left;
    for (std::size_t begin = 0, end = 0; begin < stencils.size(); begin = end) {
      while (end < stencils.size() && size_of(stencils[end]) == size_of(stencils[begin]))
        ++end;
      const std::size_t groups = (end - begin) / simd_width;
      for (std::size_t g = 0; g < groups; ++g) {
        Group four;
        for (std::size_t lane = 0; lane < simd_width; ++lane)
          four[lane] = &stencils[begin + lane * groups + g];
        add_group(four);
      }
      for (std::size_t i = begin + simd_width * groups; i < end; ++i)
        left.push_back(&stencils[i]);
    }
    for (std::size_t i = 0; i < left.size(); i += simd_width) {
      Group four{};
      for (std::size_t lane = 0; lane < simd_width && i + lane < left.size(); ++lane)
        four[lane] = left[i + lane];
      add_group(four);
    }
  }

  void add_group(const Group& four) {
    SimdStencils& group = out.stencils.emplace_back();
    std::size_t ring = 0, others = 0;
    for (const StencilSlots* p : four)
      if (p) ring = std::max(ring, p->ring.size()), others = std::max(others, p->others.size());
    group.ring = static_cast<std::int32_t>(ring);
    group.slots = static_cast<std::int32_t>(ring + others);
    const std::size_t first = out.slots.size();
    out.slots.resize(first + simd_width * (ring + others));
    constants.resize(out.slots.size() / simd_width * slot_numbers());
    const std::size_t first_yarns = out.of_yarns.size();
    if (!b.in_plane.empty()) out.of_yarns.resize(first_yarns + b.law.families.size());
    for (std::size_t lane = 0; lane < simd_width; ++lane) {
      const StencilSlots& p = four[lane] ? *four[lane] : *four[0];
      const auto n = static_cast<std::size_t>(p.stencil);
      group.area[lane] = four[lane] ? b.area[n] : 0.0;
      for (std::size_t k = 0; k < b.law.families.size() && !b.in_plane.empty(); ++k)
        out.of_yarns[first_yarns + k].of[lane] = b.in_plane[n * b.law.families.size() + k];
      group.own[lane] = at(p, 0);
      // padded by repeating the last node: its triangle is degenerate
      std::vector<int> padded = p.ring;
      padded.resize(ring, p.ring.back());
      padded.insert(padded.end(), p.others.begin(), p.others.end());
      padded.resize(ring + others, 0);
      std::vector<char> done(static_cast<std::size_t>(b.begin[n + 1] - b.begin[n]), 0);
      for (std::size_t i = 0; i < padded.size(); ++i) {
        out.slots[first + simd_width * i + lane] = at(p, padded[i]);
        char& before = done[padded[i]];
        if (padded[i] != 0 && !before) set_constants(first / simd_width + i, lane, p, padded[i]);
        before = 1;
      }
    }
  }

  std::size_t slot_numbers() const { return b.in_plane.empty() ? 3 : 5; }

  std::size_t index(const StencilSlots& p, int place) const {
    return static_cast<std::size_t>(b.begin[p.stencil] + place);
  }

  std::uint16_t at(const StencilSlots& p, int place) const {
    const auto node = static_cast<std::size_t>(b.node[index(p, place)]);
    return static_cast<std::uint16_t>(local[node] * 32);
  }

  void set_constants(std::size_t slot, std::size_t lane, const StencilSlots& p, int place) {
    SimdNumbers* to = constants.data() + slot * slot_numbers();
    const std::size_t i = index(p, place);
    for (std::size_t k = 0; k < 3; ++k)
      to[k].of[lane] = b.b[i][k];
    for (std::size_t k = 0; k < 2 && !b.in_plane.empty(); ++k)
      to[3 + k].of[lane] = b.a[i][k];
  }

  const Bending& b;
  BendingSimd& out;
  std::vector<SimdNumbers>& constants;
  std::vector<std::int32_t> local; ///< per node of the ply: its index in the current block, or -1
  std::vector<std::int32_t> list;  ///< nodes of the current block
  std::vector<StencilSlots> stencils; ///< of the current block
};

void moment_of_table(const BendingKernelLaw& law, int family, const double* kappa, double* m) {
  for (int i = 0; i < simd_width; ++i)
    m[i] = law.law->families[at(family)].law.at(kappa[i]).value;
}

BendingKernelFamily kernel_family(const FamilyBending& family) {
  const Vec3 p = family.of_axes();
  return {{family.along.x(), family.along.y()}, {p[0], p[1], p[2]}, !family.law.curvature.empty()};
}

BendingKernelLaw kernel_law(const BendingSimd& l) {
  const BendingLaw& law = l.law;
  BendingKernelLaw k; // only as many families are set as there are
  BendingLaw linear{{}, law.coupling, law.twist};
  k.families = static_cast<int>(law.families.size());
  k.table = false;
  for (std::size_t a = 0; a < law.families.size(); ++a) {
    k.family[a] = kernel_family(law.families[a]);
    k.table = k.table || k.family[a].table;
    if (!k.family[a].table) linear.families.push_back(law.families[a]);
  }
  const Eigen::Matrix3d d = linear.stiffness_at_rest();
  k.stiffness[0] = d(0, 0), k.stiffness[1] = d(1, 1), k.coupling = d(0, 1);
  k.oblique[0] = d(0, 2), k.oblique[1] = d(1, 2), k.twist = d(2, 2);
  k.weave = law.families.size() == 2 && law.families[0].along == Vec2::UnitX() &&
            law.families[1].along == Vec2::UnitY();
  k.in_plane = l.in_plane;
  k.viscous = nullptr;
  k.law = &law;
  k.moment = moment_of_table;
  return k;
}

std::size_t slot_numbers(const BendingSimd& l) {
  return l.in_plane ? 5 : 3;
}

/// Where D_g of a group stand in `of_yarns`.
std::size_t in_plane_begin(const BendingSimd& l, int group) {
  return l.in_plane ? at(group) * l.law.families.size() : 0;
}

KernelMirror kernel_mirror(const Mirror& mirror) {
  KernelMirror k;
  for (int i = 0; i < 3; ++i) {
    k.shift[i] = mirror.shift[i];
    for (int j = 0; j < 3; ++j)
      k.turn[3 * i + j] = mirror.turn(i, j);
  }
  return k;
}

/// The places (mm) of a block's nodes.
std::vector<Vec3> places_of(const BendingSimd& l, const BendingBlock& block,
                            std::span<const Vec3> x) {
  std::vector<Vec3> places;
  for (int i = 0; i < block.nodes; ++i)
    places.push_back(x[at(l.nodes[at(block.first_node + i)])]);
  for (int i = block.first_image; i < block.first_image + block.images; ++i) {
    const KernelMirror& m = l.mirrors[at(l.images[at(i)].mirror)];
    Vec3& place = places[at(l.images[at(i)].entry)];
    place = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.turn) * place +
            Eigen::Map<const Vec3>(m.shift);
  }
  return places;
}

/// The shape of the stencil in one SIMD lane. slot: number of the group's first slot; places: of
/// the block's nodes.
StencilShape shape_in_lane(const BendingSimd& l, const SimdStencils& p, std::size_t slot,
                           std::size_t lane, const std::vector<Vec3>& places) {
  const auto at = [&](std::uint16_t place) -> const Vec3& { return places[place / 32]; };
  const auto difference = [&](int i) {
    const std::size_t of = (slot + static_cast<std::size_t>(i)) * simd_width + lane;
    return Vec3(at(l.slots[of]) - at(p.own[lane]));
  };
  StencilShape s;
  const SimdNumbers* constants = l.constants->data() + slot * slot_numbers(l);
  for (int i = 0; i < p.slots; ++i, constants += slot_numbers(l)) {
    const Vec3 d = difference(i);
    for (std::size_t k = 0; k < 3; ++k)
      s.second[k] += constants[k].of[lane] * d;
    for (std::size_t k = 0; k < 2 && l.in_plane; ++k)
      s.first[k] += constants[3 + k].of[lane] * d;
  }
  Vec3 sum = Vec3::Zero(), before = difference(p.ring - 1);
  for (int i = 0; i < p.ring; ++i) {
    const Vec3 d = difference(i);
    sum += before.cross(d);
    before = d;
  }
  set_normal(s, sum);
  return s;
}

} // namespace

BendingSimd make_bending_simd(const Bending& b, std::span<const Vec3> x) {
  if (b.law.families.size() > most_kernel_families)
    throw std::length_error("bending: too many families");
  BendingSimd out;
  out.law = b.law;
  out.in_plane = !b.in_plane.empty();
  out.omega2 = b.omega2;
  for (const Mirror& mirror : b.mirrors)
    out.mirrors.push_back(kernel_mirror(mirror));
  Box3 box;
  for (const Vec3& p : x)
    box.extend(p);
  std::vector<SimdNumbers> constants;
  BendingBlockMaker maker(b, out, constants);
  for (const int node : morton_order(x, box))
    maker.add(node);
  maker.close();
  out.nodes.shrink_to_fit(), out.stencils.shrink_to_fit(), out.of_yarns.shrink_to_fit();
  constants.shrink_to_fit(), out.slots.shrink_to_fit();
  out.constants = std::make_shared<const std::vector<SimdNumbers>>(std::move(constants));
  find_node_forces(out, x.size());
  return out;
}

void bending_forces(BendingSimd& l, std::span<const Vec3> x, int block,
                    const KernelViscousBending* viscous) {
  const BendingBlock& of = l.blocks[block];
  BendingKernelLaw law = kernel_law(l);
  KernelViscousBending of_block;
  if (viscous) {
    of_block = *viscous;
    of_block.begin += of_block.states * of.first_group;
    of_block.end += of_block.states * of.first_group;
    if (of_block.factors) of_block.factors += of.first_group;
    law.viscous = &of_block;
  }
  const BendingKernelBlock kernel{l.nodes.data() + of.first_node,
                                  of.nodes,
                                  l.stencils.data() + of.first_group,
                                  of.groups,
                                  l.constants->data() + of.first_slot * slot_numbers(l),
                                  l.slots.data() + of.first_slot * simd_width,
                                  l.of_yarns.data() + in_plane_begin(l, of.first_group),
                                  l.force.data() + of.first_node,
                                  l.images.data() + of.first_image,
                                  of.images,
                                  l.mirrors.data()};
  const auto run = fastest(bending_kernel_generic, bending_kernel_avx2, bending_kernel_avx512);
  run(kernel, law, x.data()->data());
}

double bending_energy(const BendingSimd& l, std::span<const Vec3> x) {
  double sum = 0.0;
  std::vector<double> in_plane(l.in_plane ? l.law.families.size() : 0);
  for (const BendingBlock& block : l.blocks) {
    std::size_t slot = block.first_slot;
    const std::vector<Vec3> places = places_of(l, block, x);
    for (int g = block.first_group; g < block.first_group + block.groups; ++g) {
      const SimdStencils& p = l.stencils[static_cast<std::size_t>(g)];
      for (std::size_t lane = 0; lane < simd_width; ++lane) {
        if (!(p.area[lane] > 0.0)) continue;
        for (std::size_t a = 0; a < in_plane.size(); ++a)
          in_plane[a] = l.of_yarns[in_plane_begin(l, g) + a].of[lane];
        sum +=
            p.area[lane] * bending_energy(l.law, in_plane, shape_in_lane(l, p, slot, lane, places));
      }
      slot += static_cast<std::size_t>(p.slots);
    }
  }
  return sum;
}

} // namespace plyform
