// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/pretension.hpp"

#include "core/model/motion.hpp"

#include <algorithm>

namespace plyform {
namespace {

constexpr double rise = 0.1; // of the duration

double end_of_rise(const Scene& s) {
  return rise * s.data.solver.duration;
}

/// Gives stitches the pre-tension of a time, s.
void set_pretension(Scene& s, double time) {
  const double share = smooth_step(1.0, time, end_of_rise(s));
  for (PlyBody& ply : s.plies) {
    Membrane& m = ply.membrane;
    for (std::size_t i = 0; i < m.fabric.stitches.size(); ++i)
      if (const double own = m.fabric.stitches[i].law.taut_at; own < 0.0)
        m.families[m.fabric.families.size() + i].stitch->taut_at = share * own;
  }
}

/// Of plies with pre-tension, the places at the begin of the step; empty of others.
std::vector<std::vector<Vec3>> places_before(const Scene& s) {
  std::vector<std::vector<Vec3>> x(s.plies.size());
  for (std::size_t p = 0; p < x.size(); ++p) {
    const PlyBody& ply = s.plies[p];
    if (!ply.simd || !has_pretension(ply.membrane.fabric)) continue;
    x[p] = ply.x;
    for (std::size_t n = 0; n < x[p].size(); ++n)
      x[p][n] -= ply.motion[n];
  }
  return x;
}

/// Adds `times` what stitches store (N mm) at the present places and at those before.
void add_stored(Scene& s, const std::vector<std::vector<Vec3>>& before, double times,
                ThreadPool& pool) {
  std::vector<double> energy(s.group_blocks.size(), 0.0);
  pool.run(static_cast<int>(energy.size()), [&](int i) {
    const Block& block = s.group_blocks[at(i)];
    const PlyBody& ply = s.plies[at(block.ply)];
    if (before[at(block.ply)].empty()) return;
    for (const std::vector<Vec3>* x : {&ply.x, &before[at(block.ply)]})
      energy[at(i)] +=
          simd_energy(*ply.simd, ply.membrane, *x, s.dt, block.begin, ply.yarns, ply.shear_factors)
              .stitch;
  });
  for (std::size_t b = 0; b < energy.size(); ++b)
    s.plies[at(s.group_blocks[b].ply)].law_work += times * energy[b];
}

} // namespace

void raise_pretension(Scene& s, ThreadPool& pool) {
  const double from = s.tightened_until;
  if (from >= end_of_rise(s)) return; // all of it is there
  const bool any = std::any_of(s.plies.begin(), s.plies.end(), [](const PlyBody& ply) {
    return has_pretension(ply.membrane.fabric);
  });
  if (any && from < s.time) {
    const std::vector<std::vector<Vec3>> before = places_before(s);
    set_pretension(s, from);
    add_stored(s, before, -0.5, pool);
    set_pretension(s, s.time);
    add_stored(s, before, 0.5, pool);
  }
  set_pretension(s, s.time);
  s.tightened_until = s.time;
}

} // namespace plyform
