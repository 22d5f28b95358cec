// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/membrane_simd.hpp"

#include "base/cpu_features.hpp"
#include "core/ply/membrane_crimp.hpp"

#include <algorithm>

namespace plyform {
namespace {

static_assert(most_yarn_states >= yarn_states);
static_assert(most_kernel_families == most_families && most_kernel_crossings == most_crossings);

/// What temperatures make of the times of four yarns whose pack's states are these.
SimdNumbers time_factors_of(const KernelLaw& law, const SimdYarnStates* begin) {
  if (!law.time_factors) return {{1.0, 1.0, 1.0, 1.0}};
  return law.time_factors[(begin - law.states) / (law.families + law.stitches)];
}

/// A yarn's law in one lane: from its states at `begin` to those at `end`, its answers per mm.
void evaluate(const MembraneFamily& of, const LawInput& in, const SimdYarnStates& begin,
              double (*end)[simd_width], std::size_t lane, KernelAnswers& answers) {
  std::array<double, yarn_states> now{}, next{};
  for (std::size_t k = 0; k < now.size(); ++k)
    now[k] = begin.of[k][lane];
  const LawAnswer a = answer_of(of.law(), in, now.data(), next.data());
  for (std::size_t k = 0; k < next.size(); ++k)
    end[k][lane] = next[k];
  const double d = of.density;
  answers.value[lane] = d * a.value, answers.stored[lane] = d * a.stored;
  answers.lost[lane] = d * a.lost, answers.flowed[lane] = d * a.flowed;
}

void evaluate_yarns(const KernelLaw& law, int family, double per_dt, const double* strain,
                    const SimdYarnStates* begin, double (*end)[simd_width],
                    KernelAnswers& answers) {
  const Membrane& m = *law.membrane;
  const SimdNumbers factors = time_factors_of(law, begin);
  for (std::size_t i = 0; i < simd_width; ++i)
    evaluate(m.families[at(family)], m.input(strain[i], per_dt, {}, factors.of[i]), begin[family],
             end, i, answers);
}

/// Strains and answers of all families at four points; yarns as evaluate_yarns.
void evaluate_cells(const KernelLaw& law, double per_dt, const double (*strain)[simd_width],
                    const SimdYarnStates* begin, SimdYarnStates* end, KernelAnswers* answers) {
  const Membrane& m = *law.membrane;
  const std::size_t families = at(law.families);
  for (std::size_t i = 0; i < simd_width; ++i) {
    OfFamilies strains{};
    for (std::size_t a = 0; a < families; ++a)
      strains[a] = strain[a][i];
    const std::array<LawPoint, most_families> cells = cell_points(m, strains);
    for (std::size_t a = 0; a < families; ++a)
      evaluate(m.families[a], m.input(strains[a], per_dt, cells[a]), begin[a], end[a].of, i,
               answers[a]);
  }
}

/// A cell of a crossing with this shear angle and measure g^2.
ShearResponse cell_of(const MembraneCrossing& c, double gamma, double measure2) {
  return c.shear.respond(gamma, std::max(0.0, measure2 - gamma * gamma));
}

void shear_of_crossing(const KernelLaw& law, int crossing, const double* gamma,
                       const double* measure2, double* p, double* torque) {
  const MembraneCrossing& c = law.membrane->crossings[at(crossing)];
  for (int i = 0; i < simd_width; ++i) {
    const ShearResponse cell = cell_of(c, gamma[i], measure2[i]);
    p[i] = c.cells * cell.secant, torque[i] = c.cells * cell.torque;
  }
}

void shear_energy_of_crossing(const KernelLaw& law, int crossing, const double* gamma,
                              const double* measure2, double* e) {
  const MembraneCrossing& c = law.membrane->crossings[at(crossing)];
  for (int i = 0; i < simd_width; ++i)
    e[i] = c.cells * cell_of(c, gamma[i], measure2[i]).energy;
}

/// The law takes k_1 and the image k of the line across it; here in the plane of both, with k_1
/// along x. Its stresses are turned to the axes: k = across_1 k_1 + across_2 k_2.
void sheet_of_membrane(const KernelLaw& law, const double* a, const double* b, const double* d,
                       SheetAnswers& answers) {
  const Membrane& m = *law.membrane;
  const double u = m.across.x(), v = m.across.y();
  for (int i = 0; i < simd_width; ++i) {
    const double length = std::sqrt(a[i]);
    const Vec3 k1(length, 0.0, 0.0),
        k2(d[i] / length, std::sqrt(std::max(0.0, b[i] - d[i] * d[i] / a[i])), 0.0);
    const SheetResponse r = std::visit(
        [&](const auto& sheet) { return sheet.at(k1, u * k1 + v * k2); }, *m.fabric.sheet);
    answers.s11[i] = r.s11 + 2.0 * u * r.s12 + u * u * r.s22;
    answers.s12[i] = v * (r.s12 + u * r.s22);
    answers.s22[i] = v * v * r.s22;
    answers.energy[i] = r.energy;
  }
}

KernelYarns kernel_yarns(const MembraneFamily& f) {
  KernelYarns k{};
  k.along[0] = f.along.x(), k.along[1] = f.along.y();
  k.stiffness = f.crimped ? 0.0 : f.density * f.yarn.stiffness; // else its cell pulls it
  k.compression = f.density * f.yarn.compression;
  k.viscosity = f.density * f.viscosity;
  k.stabilisation = f.density * f.side.stabilisation;
  k.collapse_penalty = f.density * f.side.collapse_penalty;
  k.by_law = !f.yarn.linear() || has_rates(f.law());
  if (f.stitch) {
    k.taut_at = 1.0 + f.stitch->taut_at;
    k.breaks = std::isfinite(f.stitch->breaking_force);
    k.breaking = f.density * f.stitch->breaking_force;
  }
  k.buckles = f.yarn.buckles();
  if (k.buckles) {
    k.buckling_strain = f.yarn.buckling_strain();
    k.buckling_drop = (1.0 - buckled_share) * k.compression;
  }
  return k;
}

KernelCell kernel_cell(const Membrane& m, const MembraneCrossing& c) {
  KernelCell k{};
  k.heights = c.crimp->heights();
  for (std::size_t i = 0; i < 2; ++i) {
    const MembraneFamily& f = m.families[i == 0 ? c.first : c.second];
    k.half_wave[i] = c.crimp->half_wave[i], k.length[i] = c.crimp->length(i);
    k.stiffness[i] = f.density / k.half_wave[i] * f.yarn.stiffness / k.length[i];
  }
  return k;
}

KernelCrossing kernel_crossing(const Membrane& m, const MembraneCrossing& c) {
  const Vec2 &v = m.families[c.first].along, &w = m.families[c.second].along;
  KernelCrossing k{};
  k.first = static_cast<int>(c.first), k.second = static_cast<int>(c.second);
  k.angle = c.omega0 - 0.5 * M_PI;
  k.sine = std::abs(v.x() * w.y() - v.y() * w.x());
  k.crimped = c.crimp.has_value();
  if (k.crimped) k.cell = kernel_cell(m, c);
  k.both_signs = !c.shear.odd();
  k.piece = c.table.pieces.data(), k.interval = c.table.intervals.data();
  k.intervals = static_cast<int>(c.table.intervals.size()), k.per_width = c.table.per_width;
  const std::size_t terms = std::max(c.shear.k.size(), c.shear.negative_k.size());
  if (c.shear.tabulated() || terms > most_shear_terms) return k;
  k.shear_terms = static_cast<int>(terms);
  const auto term = [](const std::vector<double>& of, std::size_t i) {
    return i < of.size() ? of[i] : 0.0;
  };
  for (std::size_t i = 0; i < terms; ++i) {
    const double plus = term(c.shear.k, i);
    k.shear[i] = c.cells * plus;
    if (!k.both_signs) continue;
    const double minus = term(c.shear.negative_k, i);
    k.shear[i] = 0.5 * c.cells * (plus + minus), k.even[i] = 0.5 * c.cells * (plus - minus);
  }
  return k;
}

KernelLaw kernel_law(const Membrane& m, const MembraneSimd& l,
                     std::span<const SimdYarnStates> states, const LawFactors& factors) {
  KernelLaw law; // only as many families and crossings are set as there are
  law.families = static_cast<int>(m.fabric.families.size());
  law.stitches = static_cast<int>(m.fabric.stitches.size());
  law.crossings = static_cast<int>(m.crossings.size());
  for (std::size_t a = 0; a < m.families.size(); ++a)
    law.yarns[a] = kernel_yarns(m.families[a]);
  for (std::size_t c = 0; c < m.crossings.size(); ++c)
    law.crossing[c] = kernel_crossing(m, m.crossings[c]);
  law.crimped = m.crimped, law.cells_by_law = false;
  for (const MembraneFamily& family : m.families)
    law.cells_by_law = law.cells_by_law || (family.crimped && !family.yarn.linear());
  law.sheet = m.fabric.sheet.has_value();
  law.weave = law.families == 2 && law.crossings == 1 && !law.sheet && !m.fabric.matrix &&
              m.families[0].along == Vec2::UnitX() && m.families[1].along == Vec2::UnitY() &&
              law.crossing[0].first == 0 && law.crossing[0].second == 1;
  law.beta = deviation_weight, law.side_cubic = side_cubic;
  law.viscous = nullptr;
  law.shear_factors = factors.shear.empty() ? nullptr : factors.shear.data();
  law.time_factors = factors.times.empty() ? nullptr : factors.times.data();
  law.states = states.data();
  law.first = l.triangles->data();
  law.membrane = &m;
  law.evaluate = evaluate_yarns;
  law.evaluate_cells = evaluate_cells;
  law.shear = shear_of_crossing;
  law.shear_energy = shear_energy_of_crossing;
  law.sheet_law = sheet_of_membrane;
  return law;
}

static_assert(sizeof(Vec3) == 3 * sizeof(double)); // the kernel reads positions as doubles

/// The kernel's view of block b. states.end, force: arrays of all blocks, or empty if not needed.
KernelBlock kernel_block(const MembraneSimd& l, const Membrane& m, const SimdBlock& b,
                         const LawStates<SimdYarnStates>& states, SimdForce* force) {
  const std::size_t first_state = m.families.size() * at(b.first_group);
  return {l.nodes.data() + b.first_node,
          b.nodes,
          l.triangles->data() + b.first_triangles,
          states.begin.data() + first_state,
          states.end.empty() ? nullptr : states.end.data() + first_state,
          b.pair_packs,
          b.single_packs,
          force ? force + b.first_node : nullptr};
}

KernelEnergy energy_by(const KernelLaw& law, const MembraneSimd& l, const Membrane& m,
                       std::span<const Vec3> x, double per_dt, int block,
                       std::span<const SimdYarnStates> begin) {
  const KernelBlock kernel = kernel_block(l, m, l.blocks[block], {begin, {}}, nullptr);
  const auto run = fastest(membrane_energy_generic, membrane_energy_avx2, membrane_energy_avx512);
  return run(kernel, law, x.data()->data(), per_dt);
}

} // namespace

bool fits_simd(const Membrane& m) {
  return m.fabric.has_yarns();
}

std::vector<SimdYarnStates> states_at_start(const MembraneSimd& l, const Membrane& m) {
  std::vector<SimdYarnStates> of_pack;
  for (const MembraneFamily& family : m.families) {
    std::array<double, yarn_states> start{};
    start_state(family.law(), start.data());
    SimdYarnStates& state = of_pack.emplace_back();
    for (std::size_t k = 0; k < start.size(); ++k)
      std::fill(std::begin(state.of[k]), std::end(state.of[k]), start[k]);
  }
  std::vector<SimdYarnStates> states;
  states.reserve(at(l.packs) * of_pack.size());
  for (int pack = 0; pack < l.packs; ++pack)
    states.insert(states.end(), of_pack.begin(), of_pack.end());
  return states;
}

std::vector<double> remembered_of(const MembraneSimd& l, const Membrane& m,
                                  std::span<const SimdYarnStates> states, std::size_t family,
                                  std::size_t state) {
  std::vector<double> of(m.triangles.size());
  for (std::size_t i = 0; i < l.groups.size(); ++i) {
    if (l.groups[i] < 0) continue;
    const SimdYarnStates& of_pack = states[i / simd_width * m.families.size() + family];
    for (int e = m.group_begin[at(l.groups[i])]; e < m.group_begin[at(l.groups[i]) + 1]; ++e)
      of[at(e)] = of_pack.of[state][i % simd_width];
  }
  return of;
}

std::vector<YarnMemory> memory_of(const MembraneSimd& l, const Membrane& m,
                                  std::span<const SimdYarnStates> states) {
  const std::size_t families = m.families.size();
  std::vector<YarnMemory> of(at(m.groups()) * families);
  for (std::size_t i = 0; i < l.groups.size(); ++i)
    for (std::size_t a = 0; a < families && l.groups[i] >= 0; ++a)
      for (std::size_t k = 0; k < yarn_states; ++k)
        of[at(l.groups[i]) * families + a][k] =
            states[i / simd_width * families + a].of[k][i % simd_width];
  return of;
}

GroupReport simd_forces(MembraneSimd& l, const Membrane& m, std::span<const Vec3> x, double dt,
                        int block, const LawStates<SimdYarnStates>& states,
                        const KernelViscous* viscous, const LawFactors& factors) {
  const SimdBlock& b = l.blocks[block];
  const KernelBlock kernel = kernel_block(l, m, b, states, l.force.data());
  const double per_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  const auto run = fastest(membrane_kernel_generic, membrane_kernel_avx2, membrane_kernel_avx512);
  KernelLaw law = kernel_law(m, l, states.begin, factors);
  law.viscous = viscous;
  const KernelReport report = run(kernel, law, x.data()->data(), per_dt);
  return {report.lost, report.torn, report.flowed, report.collapsed};
}

MembraneEnergy simd_energy(const MembraneSimd& l, const Membrane& m, std::span<const Vec3> x,
                           double dt, int block, std::span<const SimdYarnStates> begin,
                           const LawFactors& factors) {
  const double per_dt = dt > 0.0 ? 1.0 / dt : 0.0;
  const KernelEnergy energy =
      energy_by(kernel_law(m, l, begin, factors), l, m, x, per_dt, block, begin);
  return {energy.fibre, energy.shear, energy.stitch};
}

double simd_shear_energy(const MembraneSimd& l, const Membrane& m, std::span<const Vec3> x,
                         int block, std::span<const SimdYarnStates> begin,
                         std::span<const SimdNumbers> factors) {
  KernelLaw law = kernel_law(m, l, begin, {factors, {}});
  law.sheet = false; // its energy counts as shear
  return energy_by(law, l, m, x, 0.0, block, begin).shear;
}

} // namespace plyform
