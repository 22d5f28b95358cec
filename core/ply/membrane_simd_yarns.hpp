// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of yarns of the kernel of core/ply/membrane_simd.hpp: (N) and the terms of (E) of
// core/ply/membrane.hpp.
#pragma once

#include "core/ply/membrane_simd_cells.hpp"
#include "core/ply/membrane_simd_shape.hpp"

namespace plyform {
namespace {

/// Number of vectors of triangles that pass through each stage of the computation together, so that
/// the processor overlaps the latency of their square roots. Even, so that pairs are not separated.
constexpr int batch = 8;

/// Data that all packs of a block share.
template <class Of>
struct SimdBlockWork {
  const KernelLaw& law;
  const SimdLaw<Of>& lane;
  double* force;
  double per_dt;    ///< 1/s, as of membrane_kernel
  Double4 lost;     ///< twice the work lost
  Double4 torn;     ///< N mm, likewise, of stitches
  Double4 flowed{}; ///< N mm, lost by rates of the process
};

/// Compressive strain beyond the buckling strain; 0 for yarns that have not buckled.
PLYFORM_INLINE Doubles buckled_by(const KernelYarns& yarns, Doubles strain) {
  return larger(all(0.0), -yarns.buckling_strain - strain);
}

/// d_a W_a', N/mm, of a law that the kernel knows. `general`: it does not know all laws of the
/// fabric, or its yarns can buckle.
template <class Of, bool general>
PLYFORM_INLINE Doubles yarn_tension(const SimdBlockWork<Of>& w, int family, Doubles strain) {
  const SimdYarns& yarns = w.lane.yarns[family];
  const KernelYarns& law = w.law.yarns[family];
  const Doubles n = strain * (strain > 0.0 ? yarns.stiffness : yarns.compression);
  return general && law.buckles ? n + law.buckling_drop * buckled_by(law, strain) : n;
}

/// What the yarns of some packs remember at the begin of the step and at its end: their first
/// family, behind which the others stand.
struct StatesOfQuads {
  OfQuads<const SimdYarnStates> begin;
  OfQuads<SimdYarnStates> end;
};

/// Row `row` of what a family remembers at the begin of the step.
PLYFORM_INLINE Doubles remembered(const StatesOfQuads& states, int family, int row) {
  return numbers([&](int q) { return states.begin.of[q][family].of[row]; });
}

/// d_a N of cells (N/mm) at mean stretches. Returns their energy, N/mm.
template <class Of>
PLYFORM_INLINE Doubles find_cells(const SimdBlockWork<Of>& w, const Doubles* mean, Doubles* pull) {
  for_families<Of>(w.law.families, [&](auto a) { pull[a] = all(0.0); });
  Doubles energy = all(0.0);
  for_crossings<Of>(w.law, [&](auto c, auto first, auto second) {
    if (!w.law.crossing[c].crimped) return;
    const SimdCell cell = cell_answer(w.law.crossing[c].cell, mean[first], mean[second]);
    pull[first] += cell.pull[0], pull[second] += cell.pull[1];
    energy += cell.energy;
  });
  return energy;
}

/// What a law loses, N/mm.
struct LostByLaw {
  Doubles lost, flowed;
};

/// Answers of a family's law for some packs, whatever it is; `values`: which of them is returned.
/// end: where it writes what it remembers.
template <class Of, class End>
PLYFORM_INLINE Doubles by_law(const SimdBlockWork<Of>& w, int family, Doubles strain,
                              const OfQuads<const SimdYarnStates>& begin, const End& end,
                              double (KernelAnswers::*values)[simd_width], LostByLaw* lost) {
  alignas(sizeof(Doubles)) double strains[lanes], value[lanes] = {};
  alignas(sizeof(Doubles)) double losses[lanes] = {}, flows[lanes] = {};
  store_lanes(strains, strain);
  for (int q = 0; q < begin.count; ++q) {
    KernelAnswers answers;
    w.law.evaluate(w.law, family, w.per_dt, strains + simd_width * q, begin.of[q], end(q), answers);
    for (int i = 0; i < simd_width; ++i) {
      value[simd_width * q + i] = (answers.*values)[i];
      losses[simd_width * q + i] = answers.lost[i];
      flows[simd_width * q + i] = answers.flowed[i];
    }
  }
  if (lost)
    *lost = {numbers([&](int q) { return losses + simd_width * q; }),
             numbers([&](int q) { return flows + simd_width * q; })};
  return numbers([&](int q) { return value + simd_width * q; });
}

/// The tension of a family by its law, d_a N, N/mm; lost: what it loses.
template <class Of>
PLYFORM_INLINE Doubles tension_by_law(const SimdBlockWork<Of>& w, int family,
                                      const StatesOfQuads& v, Doubles mean, LostByLaw& lost) {
  return by_law(
      w, family, mean - 1.0, v.begin, [&](int q) { return v.end.of[q][family].of; },
      &KernelAnswers::value, &lost);
}

/// What all families of some packs answer where cells couple them.
template <class Of>
struct CellAnswers {
  KernelAnswers of[quads][Of::most_families];
  PLYFORM_INLINE Doubles values(double (KernelAnswers::*which)[simd_width], int family) const {
    return numbers([&](int q) { return of[q][family].*which; });
  }
};

/// mean: stretches; end(q): where a quad writes what it remembers.
template <class Of, class End>
PLYFORM_INLINE void by_cells(const SimdBlockWork<Of>& w, const Doubles* mean,
                             const OfQuads<const SimdYarnStates>& begin, const End& end,
                             CellAnswers<Of>& answers) {
  alignas(32) double strain[Of::most_families][simd_width];
  for (int q = 0; q < quads; ++q) {
    const int from = q < begin.count ? q : 0; // as begin.of: others repeat the first
    if (from < q) {
      for_families<Of>(w.law.families, [&](auto a) { answers.of[q][a] = answers.of[0][a]; });
      continue;
    }
    for_families<Of>(w.law.families, [&](auto a) { store(strain[a], quad(mean[a] - 1.0, q)); });
    w.law.evaluate_cells(w.law, w.per_dt, strain, begin.of[q], end(q), answers.of[q]);
  }
}

/// Tensions as `tensions`. Adds what is lost.
template <class Of>
PLYFORM_INLINE void tensions_of_cells(SimdBlockWork<Of>& w, const StatesOfQuads& v,
                                      const Doubles* mean, Doubles area, Doubles* n) {
  CellAnswers<Of> answers;
  by_cells(
      w, mean, v.begin, [&](int q) { return v.end.of[q]; }, answers);
  for_families<Of>(w.law.families, [&](auto a) {
    n[a] = answers.values(&KernelAnswers::value, a);
    const Doubles lost = area * answers.values(&KernelAnswers::lost, a);
    for (int q = 0; q < v.end.count; ++q)
      w.lost += 2.0 * quad(lost, q);
  });
}

/// Tensions of yarns at their mean stretches, with viscosity while taut, without what holds single
/// triangles. n: d_a N, N/mm. Adds twice the work lost (N mm) to w.lost.
template <class Of, bool general>
PLYFORM_INLINE void yarn_tensions(SimdBlockWork<Of>& w, const StatesOfQuads& v, const Doubles* mean,
                                  Doubles area, Doubles* n) {
  Doubles now[Of::most_families], work = all(0.0), flow = all(0.0), cells[Of::most_families];
  if (general && w.law.crimped) find_cells(w, mean, cells);
  for_families<Of>(w.law.families, [&](auto a) {
    if (general && w.law.yarns[a].by_law) {
      LostByLaw lost;
      n[a] = tension_by_law(w, a, v, mean[a], lost);
      now[a] = all(0.0);
      work += lost.lost + lost.lost;
      flow += lost.flowed;
      return;
    }
    n[a] = yarn_tension<Of, general>(w, a, mean[a] - 1.0);
    if (general && w.law.crimped) n[a] += cells[a];
    const Doubles change = mean[a] - remembered(v, a, 0);
    now[a] = n[a] > 0.0 ? w.lane.yarns[a].viscosity * change : all(0.0);
    work += (now[a] + remembered(v, a, 1)) * change;
  });
  const Doubles lost = area * work, flowed = area * flow;
  for (int q = 0; q < v.end.count; ++q) {
    w.lost += quad(lost, q);
    if (general) w.flowed += quad(flowed, q);
    for_families<Of>(w.law.families, [&](auto a) {
      if (general && w.law.yarns[a].by_law) return;
      SimdYarnStates& end = v.end.of[q][a];
      store(end.of[0], quad(mean[a], q));
      store(end.of[1], quad(now[a], q));
    });
  }
  for_families<Of>(w.law.families, [&](auto a) { n[a] += now[a]; });
}

/// Tension of stitches of a linear law that are whole, N/mm, and how far they are stretched.
template <class Of>
PLYFORM_INLINE Doubles stitch_tension(const SimdBlockWork<Of>& w, int family, Doubles stretch,
                                      Doubles& beyond) {
  const SimdStitches& law = w.lane.stitches[family];
  beyond = larger(all(0.0), stretch - law.taut_at);
  return law.stiffness * beyond;
}

/// Tensions of stitches at their mean stretches. n: d_a N, N/mm. Adds twice what was stored in
/// those that break to w.torn. What those that cannot break remember stays as it was.
template <class Of, bool general>
PLYFORM_INLINE void stitch_tensions(SimdBlockWork<Of>& w, const StatesOfQuads& v,
                                    const Doubles* mean, Doubles area, Doubles* n) {
  Doubles torn = all(0.0);
  for_stitches<Of>(w.law, [&](auto a) {
    if (general && w.law.yarns[a].by_law) {
      LostByLaw lost;
      n[a] = tension_by_law(w, a, v, mean[a], lost);
      torn += lost.lost + lost.lost;
      return;
    }
    Doubles beyond;
    n[a] = stitch_tension(w, a, mean[a], beyond);
    if (!w.law.yarns[a].breaks) return;
    const Longs gone = remembered(v, a, 0) > 0.0, breaks = n[a] > w.lane.stitches[a].breaking;
    const Doubles before = remembered(v, a, 1);
    Doubles was_beyond;
    const Doubles was = stitch_tension(w, a, before, was_beyond); // lost as of StitchYarn
    torn += (breaks & ~gone) ? was * (was_beyond + (mean[a] - before)) : all(0.0);
    n[a] = (breaks | gone) ? all(0.0) : n[a];
    const Doubles next = (breaks | gone) ? all(1.0) : all(0.0);
    const Doubles stretch = gone ? before : mean[a];
    for (int q = 0; q < v.end.count; ++q) {
      store(v.end.of[q][a].of[0], quad(next, q));
      store(v.end.of[q][a].of[1], quad(stretch, q));
    }
  });
  const Doubles lost = area * torn;
  for (int q = 0; q < v.end.count; ++q)
    w.torn += quad(lost, q);
}

/// Tensions of all families and stitches.
template <class Of, bool general>
PLYFORM_INLINE void tensions(SimdBlockWork<Of>& w, const StatesOfQuads& v, const Doubles* mean,
                             Doubles area, Doubles* n) {
  if (general && w.law.cells_by_law)
    tensions_of_cells(w, v, mean, area, n);
  else
    yarn_tensions<Of, general>(w, v, mean, area, n);
  if constexpr (Of::most_families > 2) stitch_tensions<Of, general>(w, v, mean, area, n);
}

/// d_a W_a, N/mm, of a law that the kernel does not know. begin: what it remembers.
template <class Of>
PLYFORM_INLINE Doubles energy_by_law(const SimdBlockWork<Of>& w, int family, Doubles strain,
                                     const OfQuads<const SimdYarnStates>& begin) {
  SimdYarnStates end; // of no use: this is no step
  return by_law(
      w, family, strain, begin, [&](int) { return end.of; }, &KernelAnswers::stored, nullptr);
}

/// d_a W_a, N/mm, what a family stores. begin: what it remembers.
template <class Of, bool general>
PLYFORM_INLINE Doubles yarn_energy(const SimdBlockWork<Of>& w, int family, Doubles strain,
                                   const OfQuads<const SimdYarnStates>& begin) {
  const SimdYarns& yarns = w.lane.yarns[family];
  const KernelYarns& law = w.law.yarns[family];
  if (general && law.by_law) return energy_by_law(w, family, strain, begin);
  const Doubles e = 0.5 * strain * strain * (strain > 0.0 ? yarns.stiffness : yarns.compression);
  if (!general || !law.buckles) return e;
  const Doubles beyond = buckled_by(law, strain);
  return e - 0.5 * law.buckling_drop * beyond * beyond;
}

/// d_a W_a, N/mm, what stitches store that are whole at this stretch.
template <class Of, bool general>
PLYFORM_INLINE Doubles stitch_energy(const SimdBlockWork<Of>& w, int family, Doubles stretch,
                                     const OfQuads<const SimdYarnStates>& begin) {
  const KernelYarns& law = w.law.yarns[family];
  if (general && law.by_law) return energy_by_law(w, family, stretch - 1.0, begin);
  Doubles beyond;
  const Doubles tension = stitch_tension(w, family, stretch, beyond);
  const Doubles e = 0.5 * tension * beyond;
  if (!law.breaks) return e;
  const Doubles broken = numbers([&](int q) { return begin.of[q][family].of[0]; });
  const Longs none = (broken > 0.0) | (tension > w.lane.stitches[family].breaking);
  return none ? all(0.0) : e;
}

/// sum_a d_a W_a at mean stretches, N/mm. begin: what yarns remember.
template <class Of, bool general>
PLYFORM_INLINE Doubles yarn_energies(const SimdBlockWork<Of>& w, const Doubles* mean,
                                     const OfQuads<const SimdYarnStates>& begin) {
  Doubles sum = all(0.0);
  if (general && w.law.cells_by_law) {
    CellAnswers<Of> answers;
    SimdYarnStates end[Of::most_families]; // of no use: this is no step
    by_cells(
        w, mean, begin, [&](int) { return end; }, answers);
    for_families<Of>(w.law.families,
                     [&](auto a) { sum += answers.values(&KernelAnswers::stored, a); });
    return sum;
  }
  for_families<Of>(w.law.families,
                   [&](auto a) { sum += yarn_energy<Of, general>(w, a, mean[a] - 1.0, begin); });
  if (general && w.law.crimped) {
    Doubles pull[Of::most_families]; // of no use here
    sum += find_cells(w, mean, pull);
  }
  return sum;
}

/// Stabilisation and collapse penalty of (E) times d_a, N/mm.
PLYFORM_INLINE Doubles side_energy(const SimdYarns& yarns, Doubles lambda, Doubles delta) {
  const Doubles folded = larger(all(0.0), collapse_stretch - lambda);
  return 0.5 * (yarns.stabilisation * delta * delta + yarns.collapse_penalty * folded * folded);
}

} // namespace
} // namespace plyform
