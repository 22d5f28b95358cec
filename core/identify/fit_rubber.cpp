// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/fit_rubber.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

constexpr double most_strain = 10.0, told_within = 0.1;
constexpr std::size_t least_rows = 4;

/// s of each strain x per constant: columns mu, or C10 and C01.
Eigen::MatrixXd stresses_of(RubberTest test, bool neo, const Eigen::VectorXd& x) {
  Eigen::MatrixXd a(x.size(), neo ? 1 : 2);
  const auto stress = [test](const MooneyRivlinLaw& law, double stretch) {
    return test == RubberTest::uniaxial ? uniaxial_load(law, stretch)
                                        : equibiaxial_load(law, stretch);
  };
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double stretch = 1.0 + std::max(0.0, x[i]);
    a(i, 0) = stress({neo ? 0.5 : 1.0, 0.0}, stretch);
    if (!neo) a(i, 1) = stress({0.0, 1.0}, stretch);
  }
  return a;
}

/// Compared from a tenth of the largest strain on.
std::vector<double> places_up_to(double strain) {
  std::vector<double> places;
  for (int i = 1; i <= 10; ++i)
    places.push_back(0.1 * i * strain);
  return places;
}

LinearLaw rubber_law(RubberTest test, bool neo, double largest) {
  LinearLaw law;
  law.loads = [test, neo](const Eigen::VectorXd& x) { return stresses_of(test, neo, x); };
  if (neo) law.richer = [test](const Eigen::VectorXd& x) { return stresses_of(test, false, x); };
  law.probes = law.loads(vector_of(places_up_to(largest)));
  return law;
}

struct RubberRows {
  Curve curve; ///< x: strain, y: N/mm^2
  RubberTest test;
  Corrected corrected;
};

/// Takes 1 off stretches; reports an error and returns false if they are none.
bool take_stretch(Curve& curve, Diagnostics& diagnostics) {
  if (curve.x_is != Quantity::stretch) return true;
  if (!curve.x.empty() && curve.x.front() < 0.5) {
    diagnostics.error(place_of(curve), curve.x_name,
                      written(curve.x_written, curve.x_name, 0, curve.x.front()),
                      "a stretch is 1 where nothing pulls",
                      "give --x-unit % or mm/mm if the "
                      "column is a strain");
    return false;
  }
  for (double& x : curve.x)
    x -= 1.0;
  return true;
}

/// Reports an error and returns false where the stress falls by more than noise.
bool stress_rises(const Curve& curve, Diagnostics& diagnostics) {
  double most = 0.0;
  for (const double y : curve.y)
    most = std::max(most, y);
  double before = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    before = std::max(before, curve.y[i]);
    if (curve.y[i] >= before - 2.0 * noise_share * most) continue;
    diagnostics.error(place_of(curve, i), curve.y_name, written_y(curve, i),
                      fmt::format("the stress falls by more than {:g} % of its largest value",
                                  200.0 * noise_share),
                      "take out rows that are no loading, or end the curve with --to before the "
                      "specimen breaks or slips");
    return false;
  }
  return true;
}

bool enough(const Curve& curve, const Place& start, Diagnostics& diagnostics) {
  const auto strained = static_cast<std::size_t>(
      std::count_if(curve.x.begin(), curve.x.end(), [](double strain) { return strain > 0.0; }));
  if (strained < least_rows) {
    diagnostics.error(start, "", "",
                      fmt::format("{} row{} stretched within the range, a law of rubber needs at "
                                  "least {}",
                                  strained, strained == 1 ? "" : "s", least_rows),
                      "record more rows, or widen --from and --to");
    return false;
  }
  if (curve.x.back() <= most_strain) return true;
  diagnostics.error(
      place_of(curve, curve.size() - 1), curve.x_name, written_x(curve, curve.size() - 1),
      fmt::format("is a strain of {:g}, it must be at most {:g}", curve.x.back(), most_strain),
      "give --gauge-length if the column is a displacement in mm, --x-unit % if it "
      "is a strain in %");
  return false;
}

std::optional<RubberRows> rows_of_specimen(RubberCurve given, const RubberSpecimen& size,
                                           const FitOptions& options, Diagnostics& diagnostics) {
  RubberRows rows{std::move(given.curve), given.test, {}};
  Curve& c = rows.curve;
  const char* word = size.displacement() ? "displacement" : "strain";
  const double area = c.y_is == Quantity::stress ? 1.0 : size.area, length = size.gauge_length;
  if (!take_stretch(c, diagnostics) || !check_rising(c, word, diagnostics) ||
      !apply_given(c, options.corrections, word, rows.corrected, diagnostics))
    return std::nullopt;
  if (options.corrections.toe && !drop_slack(c, word, diagnostics)) return std::nullopt;
  if (options.corrections.any_fit()) {
    LinearLaw law = rubber_law(given.test, true, 1.0);
    law.loads = [&](const Eigen::VectorXd& x) { return stresses_of(given.test, true, x / length); };
    apply_fitted(c, options.corrections, law, options.from * length, options.to * length,
                 rows.corrected);
    if (!drop_slack(c, word, diagnostics)) return std::nullopt;
  }
  if (!check_zeros(c, word, "load", diagnostics)) return std::nullopt;
  const Place start = place_of(c);
  rows.corrected.slip_at /= length;
  std::vector<std::size_t> kept;
  c.x_written.factor /= length, c.y_written.factor /= area;
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.x[i] /= length, c.y[i] /= area;
    if (c.x[i] >= options.from && c.x[i] <= options.to) kept.push_back(i);
  }
  c = rows_of(c, kept);
  if (!enough(c, start, diagnostics) || !stress_rises(c, diagnostics)) return std::nullopt;
  return rows;
}

/// All rows of all specimens, one after the other, for both laws.
struct PooledRubber {
  Eigen::MatrixXd neo, mooney;
  Eigen::VectorXd measured;
  Eigen::ArrayXd share; ///< so that each specimen has the same weight
};

PooledRubber pooled_rubber(const std::vector<RubberRows>& all) {
  Eigen::Index count = 0, row = 0;
  for (const RubberRows& rows : all)
    count += static_cast<Eigen::Index>(rows.curve.size());
  PooledRubber p{Eigen::MatrixXd(count, 1), Eigen::MatrixXd(count, 2), Eigen::VectorXd(count),
                 Eigen::ArrayXd(count)};
  for (const RubberRows& rows : all) {
    const auto n = static_cast<Eigen::Index>(rows.curve.size());
    const Eigen::VectorXd x = vector_of(rows.curve.x);
    p.neo.middleRows(row, n) = stresses_of(rows.test, true, x);
    p.mooney.middleRows(row, n) = stresses_of(rows.test, false, x);
    p.measured.segment(row, n) = vector_of(rows.curve.y);
    p.share.segment(row, n) = std::sqrt(static_cast<double>(count) /
                                        static_cast<double>(n * static_cast<long>(all.size())));
    row += n;
  }
  return p;
}

double rubber_squares(const LinearFit& fit, const PooledRubber& p) {
  return ((fit.fitted - p.measured).array() * fit.weights).square().sum();
}

/// Limits of both stresses at the largest stretch.
RubberLimits limits_of(const LinearFit& mooney, double strain) {
  const auto at = [&](RubberTest test) {
    return limits_of_law(mooney, stresses_of(test, false, Eigen::VectorXd::Constant(1, strain)))[0];
  };
  return {at(RubberTest::uniaxial), at(RubberTest::equibiaxial)};
}

std::string share_text(double share) {
  return share > 9.99 ? "more than 1000 %" : fmt::format("{:.2g} %", 100.0 * share);
}

/// Which law it is and why. chance: that of Mooney-Rivlin's gain.
void choose_rubber(RubberLaw wanted, const LinearFit& mooney, double chance, RubberFit& result) {
  const double limits = limits_of_coefficients(mooney)[1], c01 = mooney.k[1];
  const std::string constants =
      fmt::format("C10 = {:.3g}, C01 = {:.3g} +- {:.2g} N/mm2", mooney.k[0], c01, limits);
  const double widest = std::max(result.by_both.uniaxial, result.by_both.equibiaxial);
  const bool told = chance < by_chance && widest <= told_within;
  const bool stable = mooney.k[0] >= 0.0 && c01 >= 0.0;
  result.neo_hookean =
      wanted == RubberLaw::neo_hookean || (wanted == RubberLaw::chosen && !(told && stable));
  const char* asked = wanted == RubberLaw::chosen ? "" : "asked for; ";
  if (told && stable)
    result.why = fmt::format("{}the rows tell C10 from C01: {}", asked, constants);
  else if (chance < by_chance && !stable)
    result.why = fmt::format(
        "{}a Mooney-Rivlin law would follow the rows better, by {}, but with a negative constant "
        "it softens when stretched {}",
        asked, constants, c01 < 0.0 ? "both ways" : "one way");
  else
    result.why = fmt::format("{}the rows do not tell C10 from C01: {}", asked, constants);
}

/// Warns that a law is not known where it was not measured.
void warn_of_untold(const std::vector<RubberRows>& all, RubberLaw wanted, double chance,
                    const RubberFit& fit, Diagnostics& diagnostics) {
  const bool one = std::any_of(all.begin(), all.end(),
                               [](const RubberRows& r) { return r.test == RubberTest::uniaxial; });
  const bool both = std::any_of(all.begin(), all.end(), [](const RubberRows& r) {
    return r.test == RubberTest::equibiaxial;
  });
  const double widest = std::max(fit.by_both.uniaxial, fit.by_both.equibiaxial);
  if (fit.neo_hookean && (one != both)) {
    const auto of = one ? equibiaxial_load : uniaxial_load;
    const double at_end = of(fit.mooney, fit.largest_stretch);
    diagnostics.warning(
        place_of(all.front().curve),
        fmt::format("{} tension alone says little of the other: at a stretch of {:.3g} the law "
                    "found has an {} stress of {:.3g} N/mm2, a Mooney-Rivlin law of these rows "
                    "{:.3g} +- {:.2g}; test {} too{}",
                    one ? "uniaxial" : "equibiaxial", fit.largest_stretch,
                    one ? "equibiaxial" : "uniaxial", of(fit.law, fit.largest_stretch), at_end,
                    std::abs(at_end) * (one ? fit.by_both.equibiaxial : fit.by_both.uniaxial),
                    one ? "both ways" : "one way", one ? " (--equibiaxial)" : ""));
  }
  if (!fit.neo_hookean && wanted == RubberLaw::mooney_rivlin &&
      !(chance < by_chance && widest <= told_within))
    diagnostics.warning(place_of(all.front().curve),
                        fmt::format("the rows do not tell C10 from C01: the equibiaxial stress at "
                                    "a stretch of {:.3g} is known within +- {} only; test both "
                                    "ways too (--equibiaxial), or take --law neo_hookean",
                                    fit.largest_stretch, share_text(fit.by_both.equibiaxial)));
  if (fit.neo_hookean) return;
  if (const auto softens = softening_of(fit.law))
    diagnostics.warning(place_of(all.front().curve),
                        fmt::format("a sheet of this law that is stretched {} softens beyond a "
                                    "stretch of {:.3g} and is unstable there; take --law "
                                    "neo_hookean",
                                    softens->equibiaxial ? "both ways" : "one way",
                                    softens->stretch));
}

CurveWords words_of(const RubberRows& rows, const RubberSpecimen& size) {
  CurveWords words;
  words.x_is_length = size.displacement();
  words.length_unit = size.displacement() ? "mm" : "";
  words.x_scale = size.gauge_length;
  words.y_scale = rows.curve.y_is == Quantity::stress ? 1.0 : size.area;
  words.length = size.displacement() ? 0.1 / size.gauge_length : 1e-3;
  words.can_stretch = false;
  return words;
}

/// Checks one specimen with the law of all.
std::optional<SpecimenLaw> law_of_specimen(const RubberRows& rows, const RubberFit& all,
                                           const RubberSpecimen& size, const FitOptions& options,
                                           Diagnostics& diagnostics) {
  const LinearLaw basis = rubber_law(rows.test, all.neo_hookean, rows.curve.x.back());
  LoadRows of{vector_of(rows.curve.x), vector_of(rows.curve.y), {}};
  const LinearFit own = fit_linear(basis.loads(of.x), of.y);
  of.weights = own.weights;
  const CurveWords words = words_of(rows, size);
  if (!check_disturbances(rows.curve, basis, of, options, words, diagnostics)) return std::nullopt;
  SpecimenLaw law{rows.curve.file, {own.k.begin(), own.k.end()}, {}, rows.corrected, {}};
  law.quality = quality_of(rows.curve.x, rows.curve.y, {own.fitted.begin(), own.fitted.end()});
  if (!check_quality(rows.curve, law.quality,
                     fmt::format("a stretch of {:.3g}", 1.0 + law.quality.largest_at),
                     "end the curve with --to at the stretch that the run reaches, or check the "
                     "columns",
                     diagnostics))
    return std::nullopt;
  law.sensitive =
      sensitivities(basis, of, words.length, common_compliance * words.y_scale / size.gauge_length);
  warn_of_unknowns(rows.curve, basis, of, law.sensitive, options, words, diagnostics);
  return law;
}

void put_rows(const std::vector<RubberRows>& all, const LinearFit& fit, RubberFit& result) {
  Eigen::Index row = 0;
  for (std::size_t n = 0; n < all.size(); ++n)
    for (std::size_t i = 0; i < all[n].curve.size(); ++i, ++row) {
      result.stretch.push_back(1.0 + all[n].curve.x[i]);
      result.measured.push_back(all[n].curve.y[i]);
      result.fitted.push_back(fit.fitted[row]);
      result.specimen.push_back(n);
      result.test.push_back(all[n].test);
    }
  result.quality = quality_of(result.stretch, result.measured, result.fitted);
}

/// Limits and scatter: of several specimens of one test from what is between them.
void put_confidence(const std::vector<RubberRows>& all, const LinearFit& fit, RubberFit& result) {
  const double strain = result.largest_stretch - 1.0;
  const LinearLaw basis = rubber_law(all.front().test, result.neo_hookean, strain);
  std::vector<double> places;
  for (const double place : places_up_to(strain))
    places.push_back(1.0 + place);
  const bool alike = std::all_of(all.begin(), all.end(), [&](const RubberRows& rows) {
    return rows.test == all.front().test;
  });
  if (all.size() == 1 || !alike) {
    result.confidence = confidence_of(fit, basis.probes, places);
    return;
  }
  std::vector<Eigen::VectorXd> own;
  for (const SpecimenLaw& law : result.specimens)
    own.push_back(vector_of(law.coefficients));
  result.scatter = scatter_of(own, basis.probes, places);
  result.confidence = confidence_between(own, basis.probes, places);
}

void check_arguments(const RubberSpecimen& size, const FitOptions& options) {
  if (!(size.area > 0.0 && size.gauge_length > 0.0))
    throw std::invalid_argument("area and gauge length must be greater than 0");
  if (!(options.from >= 0.0 && options.to > options.from))
    throw std::invalid_argument("the range must start at 0 or above and end above its start");
}

} // namespace

std::optional<RubberFit> identify_rubber(std::vector<RubberCurve> curves,
                                         const RubberSpecimen& specimen, RubberLaw wanted,
                                         const FitOptions& options, Diagnostics& diagnostics) {
  check_arguments(specimen, options);
  const std::size_t errors = diagnostics.errors.size();
  std::vector<RubberRows> all;
  RubberFit result;
  for (RubberCurve& curve : curves)
    if (auto rows = rows_of_specimen(std::move(curve), specimen, options, diagnostics)) {
      result.largest_stretch = std::max(result.largest_stretch, 1.0 + rows->curve.x.back());
      all.push_back(std::move(*rows));
    }
  if (diagnostics.errors.size() > errors || all.empty()) return std::nullopt;
  const PooledRubber p = pooled_rubber(all);
  const LinearFit neo = fit_linear(p.neo, p.measured, p.share),
                  mooney = fit_linear(p.mooney, p.measured, p.share);
  result.by_both = limits_of(mooney, result.largest_stretch - 1.0);
  result.mooney = {mooney.k[0], mooney.k[1]};
  const double chance =
      chance_of_gain(rubber_squares(neo, p), rubber_squares(mooney, p), mooney.freedom);
  choose_rubber(wanted, mooney, chance, result);
  const LinearFit& fit = result.neo_hookean ? neo : mooney;
  result.law = result.neo_hookean ? MooneyRivlinLaw{0.5 * neo.k[0], 0.0} : result.mooney;
  for (const RubberRows& rows : all)
    if (auto law = law_of_specimen(rows, result, specimen, options, diagnostics))
      result.specimens.push_back(std::move(*law));
  if (diagnostics.errors.size() > errors) return std::nullopt;
  if (!check_usual(place_of(all.front().curve), "shear modulus", result.law.shear_modulus(),
                   usual_rubber_modulus, "N/mm2", options.doubtful, diagnostics))
    return std::nullopt;
  put_rows(all, fit, result);
  put_confidence(all, fit, result);
  warn_of_untold(all, wanted, chance, result, diagnostics);
  return result;
}

} // namespace plyform
