// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_biaxial.hpp"

#include "base/format.hpp"
#include "core/identify/biaxial_model.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr std::array<const char*, 2> yarns_words{"warp", "weft"};

/// The cell of the fabric's crimp, or spacings of a plain weave, mm.
std::array<double, 2> half_waves_of(const Fabric& fabric) {
  const Crossing& crossing = fabric.crossings[0];
  if (crossing.crimp) return crossing.crimp->half_wave;
  return crossing_spacing(fabric, crossing);
}

Place place_of(const BiaxialCurve& curve) {
  return {curve.file, curve.line.front(), 1};
}

bool enough_load(const std::vector<BiaxialCurve>& curves, Diagnostics& diagnostics) {
  constexpr int least = 8;
  double largest = 0.0;
  for (const BiaxialCurve& curve : curves)
    for (const auto& loads : curve.load)
      largest = std::max(largest, *std::max_element(loads.begin(), loads.end()));
  int rows = 0;
  for (const BiaxialCurve& curve : curves)
    for (std::size_t i = 0; i < curve.size(); ++i)
      rows += std::max(curve.load[0][i], curve.load[1][i]) > noise_share * largest;
  if (largest > 0.0 && rows >= least) return true;
  diagnostics.error(place_of(curves.front()), "", "",
                    largest > 0.0 ? fmt::format("only {} rows bear a load, there must be at least "
                                                "{}",
                                                rows, least)
                                  : std::string("no row bears a load: the strains end within the "
                                                "toe, where yarns only straighten"),
                    "test to larger strains, or record more rows");
  return false;
}

FitQuality quality_of_loads(const BiaxialModel& model, const BiaxialSolution& s) {
  std::vector<double> at, measured, fitted;
  const Eigen::VectorXd target = model.measured();
  Eigen::Index row = 0;
  for (const BiaxialCurve& curve : *model.curves)
    for (std::size_t i = 0; i < curve.size(); ++i)
      for (std::size_t a = 0; a < 2; ++a, ++row) {
        if (curve.free[a]) continue;
        at.push_back(curve.strain[a][i]);
        measured.push_back(target[row]);
        fitted.push_back(s.fitted[row]);
      }
  return quality_of(at, measured, fitted);
}

struct BiaxialSolved {
  BiaxialModel model;
  BiaxialSolution solution;
  std::array<double, 2> shape{}; ///< how far crimps move with half of a table's pieces
  double rms() const { return quality_of_loads(model, solution).rms; }
};

/// Largest elongation of a yarn.
double longest_of(const BiaxialSolved& solved, std::size_t a) {
  double largest = 0.0;
  const Eigen::VectorXd measured = solved.model.measured();
  for (auto i = static_cast<Eigen::Index>(a); i < measured.size(); i += 2)
    largest = std::max(largest, measured[i]);
  return solved.model.yarn(solved.solution.p, a).strain_at(largest);
}

constexpr int table_pieces = 10;

/// Tables of that many pieces, from a solution of fewer.
BiaxialSolved table_from(const BiaxialSolved& fewer, int pieces) {
  BiaxialSolved table = fewer;
  table.model.pieces = pieces;
  for (int round = 0; round < 3; ++round) { // how long yarns get follows from their laws
    const BiaxialSolved before = table.solution.p.size() == table.model.numbers() ? table : fewer;
    for (std::size_t a = 0; a < 2; ++a)
      table.model.longest[a] = longest_of(before, a);
    const BiaxialSolution nearby =
        solve_biaxial(table.model, start_from(table.model, before.model, before.solution.p));
    const BiaxialSolution anywhere = solve_biaxial(table.model);
    table.solution = nearby.squares < anywhere.squares ? nearby : anywhere;
  }
  return table;
}

/// Lines, or tables where those do better.
BiaxialSolved lines_or_tables(const BiaxialModel& model) {
  BiaxialSolved line{model, solve_biaxial(model)};
  if (line.rms() <= noisy) return line;
  const BiaxialSolved coarse = table_from(line, table_pieces / 2);
  BiaxialSolved table = table_from(coarse, table_pieces);
  for (std::size_t a = 0; a < 2; ++a)
    table.shape[a] =
        std::abs(table.model.crimp(table.solution.p, a) - coarse.model.crimp(coarse.solution.p, a));
  return table.rms() < 0.5 * line.rms() ? table : line;
}

/// Largest change of a crimp or of a yarn's largest slope from one solution to another.
double change_between(const BiaxialSolved& from, const BiaxialSolved& to) {
  double change = 0.0;
  for (std::size_t a = 0; a < 2; ++a) {
    const double c0 = from.model.crimp(from.solution.p, a), c1 = to.model.crimp(to.solution.p, a);
    const double k0 = from.model.yarn(from.solution.p, a).largest_slope(),
                 k1 = to.model.yarn(to.solution.p, a).largest_slope();
    change = std::max({change, std::abs(c0 / c1 - 1.0), std::abs(k0 / k1 - 1.0)});
  }
  return std::isfinite(change) ? change : 1e9;
}

struct FoundZero {
  StrainZero zero;
  BiaxialSolved with;
  double chance = 1.0, change = 0.0;
};

std::vector<StrainZero> zeros_that_may_be(const std::vector<BiaxialCurve>& curves) {
  std::vector<StrainZero> all;
  for (std::size_t a = 0; a < 2; ++a) {
    if (curves.size() > 1) all.push_back({std::nullopt, a});
    for (std::size_t n = 0; n < curves.size(); ++n)
      if (!curves[n].free[a]) all.push_back({n, a});
  }
  return all;
}

/// The wrong zero that explains the rows best, if one does.
std::optional<FoundZero> find_zero(const BiaxialSolved& plain) {
  std::optional<FoundZero> best;
  const std::vector<StrainZero> all = zeros_that_may_be(*plain.model.curves);
  for (const StrainZero& zero : all) {
    const auto same = [&](const StrainZero& other) {
      return other.file == zero.file && other.direction == zero.direction;
    };
    if (std::any_of(plain.model.zeros.begin(), plain.model.zeros.end(), same)) continue;
    FoundZero here{zero, plain};
    here.with.model.zeros.push_back(zero);
    here.with.solution =
        solve_biaxial(here.with.model, start_from(here.with.model, plain.model, plain.solution.p));
    if (best && here.with.solution.squares >= best->with.solution.squares) continue;
    best = std::move(here);
  }
  if (!best) return best;
  const BiaxialSolution& s = best->with.solution;
  best->chance = static_cast<double>(all.size()) *
                 chance_of_gain(plain.solution.squares, s.squares, s.freedom);
  best->change = change_between(plain, best->with);
  best->zero.amount = s.p[s.p.size() - 1];
  best->zero.limits = s.limits(s.p.size() - 1);
  if (!(best->chance < by_chance && best->change > noisy)) return std::nullopt;
  return best;
}

std::string zero_words(const StrainZero& zero, const std::vector<BiaxialCurve>& curves) {
  return fmt::format("{} strain{} too large by {:.3g} (+- {:.1g})", yarns_words[zero.direction],
                     zero.file ? " of " + curves[*zero.file].file : " of all files", zero.amount,
                     zero.limits);
}

/// Takes zeros off, or reports the best; returns false after an error.
bool judge_zeros(BiaxialSolved& solved, const BiaxialOptions& options, Diagnostics& diagnostics) {
  if (solved.model.pieces > 1 && !options.fit_zeros) return true; // tables follow wrong zeros
  constexpr int most = 4;
  for (int i = 0; i < (options.fit_zeros ? most : 1); ++i) {
    auto found = find_zero(solved);
    if (!found) return true;
    if (options.fit_zeros) {
      solved = std::move(found->with);
      continue;
    }
    const std::vector<BiaxialCurve>& curves = *solved.model.curves;
    const std::string rule =
        fmt::format("the rows show a wrong zero of strain: {}; without it a crimp or a stiffness "
                    "is {:.2g} % wrong",
                    zero_words(found->zero, curves), 100.0 * found->change);
    const std::string remedy =
        "set strains to 0 where the specimen lies without load; --toe fit takes it off";
    const Place at = place_of(curves[found->zero.file.value_or(0)]);
    if (found->change <= useless || found->chance > surely_not_chance || options.doubtful) {
      diagnostics.warning(at, rule + "; " + remedy);
      return true;
    }
    diagnostics.error(at, "", "", rule, remedy + ", --yes-doubtful leaves it in");
    return false;
  }
  return true;
}

/// Half width of the 95 % limits, with what the pieces of a table leave open.
double crimp_limits_of(const BiaxialSolved& solved, std::size_t a) {
  return std::hypot(solved.solution.limits(2 * solved.model.pieces + static_cast<Eigen::Index>(a)),
                    solved.shape[a]);
}

/// Whether all files were strained in one ratio.
bool one_ratio(const std::vector<BiaxialCurve>& curves) {
  std::vector<double> ratios;
  for (const BiaxialCurve& curve : curves) {
    if (curve.free[0] || curve.free[1]) {
      ratios.push_back(curve.free[0] ? 1e9 : -1e9);
      continue;
    }
    ratios.push_back(std::atan2(curve.strain[1].back(), curve.strain[0].back()));
  }
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  constexpr double same = 0.1;
  return *most - *least < same;
}

/// Reports crimps that the rows do not show.
bool shows_crimps(const BiaxialSolved& solved, const BiaxialOptions& options,
                  Diagnostics& diagnostics) {
  const std::vector<BiaxialCurve>& curves = *solved.model.curves;
  for (std::size_t a = 0; a < 2; ++a) {
    const double crimp = solved.model.crimp(solved.solution.p, a);
    const double limits = crimp_limits_of(solved, a);
    const bool one = one_ratio(curves); // noise-free curves of one show it by their bend alone
    if (limits < crimp && !one) continue;
    const std::string value = fmt::format("{:.3g} +- {:.2g}", crimp, limits);
    const std::string rule =
        std::string("is not shown by the curves") +
        (one ? ": they are all of one strain ratio, which a fabric without crimp "
               "could make as well"
             : ": its 95 % limits are as large as itself");
    const std::string remedy =
        "add curves at other strain ratios (0.5, 1, 2) and with either direction free, strained "
        "beyond the toe; of straight yarns identify warp and weft alone";
    if (options.doubtful) {
      diagnostics.warning(
          place_of(curves.front()),
          fmt::format("crimp of {} = {} {}; {}", yarns_words[a], value, rule, remedy));
      continue;
    }
    diagnostics.error(place_of(curves.front()), fmt::format("crimp of {}", yarns_words[a]), value,
                      rule, remedy);
    return false;
  }
  return true;
}

/// Largest change of a crimp if all strains of one direction were too large by 0.001.
double sensitivity_of(const BiaxialSolved& solved) {
  double change = 0.0;
  for (std::size_t a = 0; a < 2; ++a) {
    std::vector<BiaxialCurve> moved = *solved.model.curves;
    for (BiaxialCurve& curve : moved)
      for (double& strain : curve.strain[a])
        strain += 1e-3;
    const BiaxialModel model{&moved, solved.model.half_wave, solved.model.pieces,
                             solved.model.longest, solved.model.zeros};
    const BiaxialSolution s = solve_biaxial(model, solved.solution.p);
    for (std::size_t b = 0; b < 2; ++b)
      change = std::max(
          change, std::abs(model.crimp(s.p, b) / solved.model.crimp(solved.solution.p, b) - 1.0));
  }
  return change;
}

BiaxialFit result_of(const BiaxialSolved& solved, const Fabric& fabric) {
  const BiaxialModel& model = solved.model;
  const BiaxialSolution& s = solved.solution;
  BiaxialFit fit;
  fit.line = model.pieces == 1;
  const CrimpedCell cell = model.cell(s.p);
  for (std::size_t a = 0; a < 2; ++a) {
    fit.yarn[a] = model.yarn(s.p, a);
    if (fit.line)
      fit.stiffness_limits[a] = fit.yarn[a].stiffness * s.limits(static_cast<Eigen::Index>(a));
    fit.crimp[a] = cell.crimp[a];
    fit.crimp_limits[a] = crimp_limits_of(solved, a);
    fit.height[a] = cell.height(a);
  }
  Fabric plain = fabric;
  plain.crossings[0].crimp.reset();
  fit.plain = std::abs(half_waves_of(plain)[0] / model.half_wave[0] - 1.0) < 1e-6;
  fit.zeros = model.zeros;
  for (std::size_t z = 0; z < fit.zeros.size(); ++z) {
    const Eigen::Index at = 2 * model.pieces + 2 + static_cast<Eigen::Index>(z);
    fit.zeros[z].amount = s.p[at];
    fit.zeros[z].limits = s.limits(at);
  }
  fit.quality = quality_of_loads(model, s);
  Eigen::Index row = 0;
  for (std::size_t n = 0; n < model.curves->size(); ++n)
    for (std::size_t i = 0; i < (*model.curves)[n].size(); ++i, row += 2) {
      const BiaxialCurve& curve = (*model.curves)[n];
      fit.strain.push_back({curve.strain[0][i], curve.strain[1][i]});
      fit.measured.push_back({curve.load[0][i], curve.load[1][i]});
      fit.fitted.push_back({s.fitted[row], s.fitted[row + 1]});
      fit.specimen.push_back(n);
    }
  return fit;
}

} // namespace

std::optional<BiaxialFit> identify_biaxial(const std::vector<BiaxialCurve>& curves,
                                           const Fabric& fabric, const BiaxialOptions& options,
                                           Diagnostics& diagnostics) {
  if (!enough_load(curves, diagnostics)) return std::nullopt;
  BiaxialSolved solved = lines_or_tables({.curves = &curves, .half_wave = half_waves_of(fabric)});
  if (!judge_zeros(solved, options, diagnostics)) return std::nullopt;
  BiaxialFit fit = result_of(solved, fabric);
  Curve named;
  named.file = curves.front().file;
  named.line = curves.front().line;
  if (!check_quality(named, fit.quality, fmt::format("a strain of {:.3g}", fit.quality.largest_at),
                     "no cell of two crimped yarns makes these curves: check the columns, the "
                     "numbers of yarns and the zeros of strain (--toe fit)",
                     diagnostics) ||
      !shows_crimps(solved, options, diagnostics))
    return std::nullopt;
  for (std::size_t a = 0; a < 2; ++a)
    if (!check_usual(place_of(curves.front()),
                     fmt::format("stiffness of a {} yarn", yarns_words[a]),
                     fit.yarn[a].largest_slope(), usual_stiffness, "N per yarn", options.doubtful,
                     diagnostics))
      return std::nullopt;
  fit.sensitivity = sensitivity_of(solved);
  return fit;
}

} // namespace plyform
