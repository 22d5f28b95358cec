// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/pretension.hpp"

#include "core/model/motion.hpp"

#include <algorithm>

namespace plyform {
namespace {

constexpr double rise = 0.1; // of the duration

double end_of_rise(const Layup& layup) {
  return rise * layup.data.solver.duration;
}

/// Gives stitches the pre-tension of a time, s.
void set_pretension(Layup& layup, double time) {
  const double share = smooth_step(1.0, time, end_of_rise(layup));
  for (PlyBody& ply : layup.plies) {
    Membrane& m = ply.membrane;
    for (std::size_t i = 0; i < m.fabric.stitches.size(); ++i)
      if (const double own = m.fabric.stitches[i].law.taut_at; own < 0.0)
        m.families[m.fabric.families.size() + i].stitch->taut_at = share * own;
  }
}

/// Of plies with pre-tension, the places at the begin of the step; empty of others.
std::vector<std::vector<Vec3>> places_before(const Layup& layup) {
  std::vector<std::vector<Vec3>> x(layup.plies.size());
  for (std::size_t p = 0; p < x.size(); ++p) {
    const PlyBody& ply = layup.plies[p];
    if (!ply.simd || !has_pretension(ply.membrane.fabric)) continue;
    x[p] = ply.x;
    for (std::size_t n = 0; n < x[p].size(); ++n)
      x[p][n] -= ply.motion[n];
  }
  return x;
}

/// Adds `times` what stitches store (N mm) at the present places and at those before.
void add_stored(Layup& layup, const std::vector<Block>& blocks,
                const std::vector<std::vector<Vec3>>& before, double times, ThreadPool& pool) {
  std::vector<double> energy(blocks.size(), 0.0);
  pool.run(static_cast<int>(energy.size()), [&](int i) {
    const Block& block = blocks[at(i)];
    const PlyBody& ply = layup.plies[at(block.ply)];
    if (before[at(block.ply)].empty()) return;
    for (const std::vector<Vec3>* x : {&ply.x, &before[at(block.ply)]})
      energy[at(i)] += simd_energy(*ply.simd, ply.membrane, *x, layup.dt, block.begin, ply.yarns,
                                   ply.law_factors())
                           .stitch;
  });
  for (std::size_t b = 0; b < energy.size(); ++b)
    layup.plies[at(blocks[b].ply)].law_work += times * energy[b];
}

} // namespace

void raise_pretension(Layup& layup, const std::vector<Block>& blocks, ThreadPool& pool) {
  const double from = layup.tightened_until;
  if (from >= end_of_rise(layup)) return; // all of it is there
  const bool any = std::any_of(layup.plies.begin(), layup.plies.end(), [](const PlyBody& ply) {
    return has_pretension(ply.membrane.fabric);
  });
  if (any && from < layup.time) {
    const std::vector<std::vector<Vec3>> before = places_before(layup);
    set_pretension(layup, from);
    add_stored(layup, blocks, before, -0.5, pool);
    set_pretension(layup, layup.time);
    add_stored(layup, blocks, before, 0.5, pool);
  }
  set_pretension(layup, layup.time);
  layup.tightened_until = layup.time;
}

} // namespace plyform
