// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/tension_rows.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double much_strain = 0.1, impossible_strain = 0.5;

/// Converts x and y to strain and tension (N) of one yarn, and keeps only the rows in the range.
void scale_curve(Curve& curve, const Strip& strip, const FitOptions& options) {
  std::vector<std::size_t> kept;
  curve.x_written.factor /= strip.gauge_length;
  curve.y_written.factor /= strip.yarns;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    curve.x[i] /= strip.gauge_length;
    curve.y[i] /= strip.yarns;
    if (curve.x[i] >= options.from && curve.x[i] <= options.to) kept.push_back(i);
  }
  curve = rows_of(curve, kept);
}

bool enough(const Curve& curve, const Place& start, const std::string& word,
            Diagnostics& diagnostics) {
  const auto strained =
      std::count_if(curve.x.begin(), curve.x.end(), [](double strain) { return strain > 0.0; });
  if (strained < 2) {
    diagnostics.error(start, "", "",
                      fmt::format("{} row{} with a {} above 0 within the range, a law of tension "
                                  "needs at least 2",
                                  strained, strained == 1 ? "" : "s", word),
                      "record more rows, or widen --from and --to");
    return false;
  }
  const double most = curve.x.back();
  if (most >= impossible_strain) {
    diagnostics.error(
        place_of(curve, curve.size() - 1), curve.x_name, written_x(curve, curve.size() - 1),
        fmt::format("is a {} of {:g}, it must be less than {:g}", word, most, impossible_strain),
        "give --gauge-length if the column is a displacement in mm, --x-unit % if it "
        "is a strain in %");
    return false;
  }
  if (most > much_strain && word == "strain")
    diagnostics.warning(place_of(curve, curve.size() - 1),
                        fmt::format("a strain of {:.3g} is much for a yarn: if the column is in %, "
                                    "give --x-unit %",
                                    most));
  return true;
}

/// Replaces the tensions by the nearest non-decreasing ones, at least 0; returns the largest
/// change.
double make_rising(std::vector<double>& tension) {
  const std::vector<double> rising = nearest_rising(tension);
  double change = 0.0;
  for (std::size_t i = 0; i < tension.size(); ++i) {
    const double risen = std::max(rising[i], 0.0);
    change = std::max(change, std::abs(risen - tension[i]));
    tension[i] = risen;
  }
  return change;
}

/// The piecewise linear law: its row at a strain, with the last slope beyond the last knot.
void put_hats(const std::vector<double>& knots, double strain, Eigen::Ref<Eigen::RowVectorXd> row) {
  row.setZero();
  const auto above = std::lower_bound(knots.begin(), knots.end() - 1, strain) - knots.begin();
  const auto k = static_cast<std::size_t>(above);
  const double left = k > 0 ? knots[k - 1] : 0.0;
  const double share = (strain - left) / (knots[k] - left);
  row[above] = share;
  if (k > 0) row[above - 1] = 1.0 - share;
}

Eigen::MatrixXd hats_at(const std::vector<double>& knots, const Eigen::VectorXd& strain) {
  Eigen::MatrixXd a(strain.size(), static_cast<Eigen::Index>(knots.size()));
  Eigen::RowVectorXd row(a.cols());
  for (Eigen::Index r = 0; r < a.rows(); ++r) {
    put_hats(knots, strain[r], row);
    a.row(r) = row;
  }
  return a;
}

} // namespace

LinearLaw line_law() {
  LinearLaw law;
  law.loads = [](const Eigen::VectorXd& x) { return Eigen::MatrixXd(x.cwiseMax(0.0)); };
  law.probes = Eigen::MatrixXd::Ones(1, 1);
  return law;
}

bool is_shifted_line(const Curve& curve, const Eigen::ArrayXd& weights,
                     const Corrections& corrections) {
  if (curve.size() < 5) return false;
  const LoadRows rows{vector_of(curve.x), vector_of(curve.y), weights};
  double squares = 1e300;
  if (!corrections.load_zero) squares = best_load_zero(line_law(), rows).fit.squares;
  if (!corrections.toe) squares = std::min(squares, best_toe(line_law(), rows).fit.squares);
  return std::sqrt(squares / static_cast<double>(curve.size())) <= noisy;
}

LinearLaw knots_law(const std::vector<double>& knots) {
  LinearLaw law;
  law.loads = [knots](const Eigen::VectorXd& x) { return hats_at(knots, x); };
  std::vector<double> places;
  for (const double knot : knots)
    if (knot >= 0.1 * knots.back()) places.push_back(knot);
  law.probes = hats_at(knots, vector_of(places));
  return law;
}

std::vector<double> knots_of(const Curve& curve) {
  const double last = curve.x.back(), apart = 0.005 * last;
  std::vector<double> strains;
  for (const double strain : curve.x)
    if (strain > (strains.empty() ? 0.0 : strains.back() + apart)) strains.push_back(strain);
  strains.back() = last;
  if (strains.size() < table_rows) return strains;
  std::vector<double> knots;
  for (std::size_t i = 1; i < table_rows; ++i)
    knots.push_back(strains[i * strains.size() / (table_rows - 1) - 1]);
  return knots;
}

std::optional<TensionLaw> table_of(const Curve& curve, std::vector<double> knots,
                                   std::vector<double> tension, Diagnostics& diagnostics) {
  const double most = *std::max_element(tension.begin(), tension.end());
  const auto peak = std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin();
  if (const double change = make_rising(tension); change > noise_share * most) {
    diagnostics.error(
        place_of(curve, static_cast<std::size_t>(peak)), curve.y_name,
        written_y(curve, static_cast<std::size_t>(peak)),
        fmt::format("the tension falls with rising strain, by more than {:g} % of its "
                    "largest value: a yarn that softens is not modelled",
                    100.0 * noise_share),
        "end the curve before it breaks or slips, with --to, or smooth it");
    return std::nullopt;
  }
  while (knots.size() > 1 && tension[tension.size() - 2] == tension.back()) {
    knots.pop_back(); // the last slope is used beyond the table: noise must not make it 0
    tension.pop_back();
  }
  TensionLaw law{.strain = {0.0}, .tension = {0.0}};
  law.strain.insert(law.strain.end(), knots.begin(), knots.end());
  law.tension.insert(law.tension.end(), tension.begin(), tension.end());
  return law;
}

std::optional<TensionSpecimen> tension_specimen(Curve curve, const Strip& strip,
                                                const FitOptions& options, const std::string& word,
                                                Diagnostics& diagnostics) {
  TensionSpecimen specimen{std::move(curve), {}};
  Curve& c = specimen.curve;
  if (!check_rising(c, word, diagnostics) ||
      !apply_given(c, options.corrections, word, specimen.corrected, diagnostics))
    return std::nullopt;
  if (options.corrections.toe && !drop_slack(c, word, diagnostics)) return std::nullopt;
  if (options.corrections.any_fit()) {
    apply_fitted(c, options.corrections, line_law(), options.from * strip.gauge_length,
                 options.to * strip.gauge_length, specimen.corrected);
    if (!drop_slack(c, word, diagnostics)) return std::nullopt;
  }
  if (!check_zeros(c, word, "load", diagnostics)) return std::nullopt;
  const Place start = place_of(c);
  specimen.corrected.slip_at /= strip.gauge_length;
  scale_curve(c, strip, options);
  if (!enough(c, start, word, diagnostics)) return std::nullopt;
  return specimen;
}

} // namespace plyform
