// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/choose_shear.hpp"

#include "base/format.hpp"
#include "core/identify/shear_checks.hpp"
#include "core/identify/shear_table.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

using Eigen::Index;
using Form = ShearFormKind;

constexpr double of_digits = 1e-4; ///< residuals below are those of the digits of a file

struct Problem {
  const std::vector<ShearSpecimen>& specimens;
  const LoadRows& all;
  double end;
  const ShearTest& test;
  const Fabric& fabric;
  const FitOptions& options;
  const CurveWords& words;
};

struct Candidate {
  ShearForm form;
  ShearSolution solution; ///< of all rows
  std::vector<double> knots;
  std::vector<double> folds = {}; ///< mean squares of each
  double mean = 0.0;
  bool valid = false; ///< gives_laws
};

LoadRows rows_of(const LoadRows& rows, const std::vector<Index>& some) {
  LoadRows part{rows.x(some), rows.y(some), {}};
  if (rows.weights.size() > 0) part.weights = rows.weights(some);
  return part;
}

std::vector<double> knots_in(const ShearLaw& law) {
  return law.tabulated() ? std::vector<double>(law.angle.begin() + 1, law.angle.end())
                         : std::vector<double>{};
}

bool is_law(const ShearSolution& s) {
  return s.static_torque >= 0.0 && invalid_at(s.shear(), 0.0, s.scale) > s.scale;
}

constexpr Index most_rows = 150; ///< of a specimen, of which a law is chosen

/// It with means of neighbouring rows in the place of more than that, between its first and last.
ShearSpecimen with_means(const ShearSpecimen& specimen) {
  const Index rows = specimen.rows.x.size(), inner = rows - 2;
  if (rows <= most_rows) return specimen;
  constexpr Index count = most_rows - 2;
  ShearSpecimen less = specimen;
  less.rows = {Eigen::VectorXd(most_rows), Eigen::VectorXd(most_rows), {}};
  less.angle.assign(most_rows, 0.0);
  const auto put = [&](Index to, Index begin, Index size) {
    less.rows.x[to] = specimen.rows.x.segment(begin, size).mean();
    less.rows.y[to] = specimen.rows.y.segment(begin, size).mean();
    for (Index i = begin; i < begin + size; ++i)
      less.angle[static_cast<std::size_t>(to)] +=
          specimen.angle[static_cast<std::size_t>(i)] / static_cast<double>(size);
  };
  put(0, 0, 1);
  for (Index bin = 0; bin < count; ++bin) {
    const Index begin = 1 + bin * inner / count;
    put(1 + bin, begin, 1 + (bin + 1) * inner / count - begin);
  }
  put(most_rows - 1, rows - 1, 1);
  return less;
}

/// Points of a table that rows bear.
int most_points(Index rows) {
  constexpr Index most = 8;
  return static_cast<int>(std::min(most, rows / 2 + 1));
}

/// The forms that may be, the preferred first.
std::vector<ShearForm> forms_of(const FitOptions& options, Index rows) {
  std::vector<ShearForm> forms;
  const auto wanted = [&](Form kind) { return !options.law || *options.law == kind; };
  const auto put = [&](Form kind, int size, int numbers) {
    if (wanted(kind) && 2 * numbers <= rows) forms.push_back({kind, size});
  };
  if (options.coefficients > 0)
    return {{options.law.value_or(Form::polynomial), options.coefficients}};
  if (options.points > 0) return {{Form::table, options.points}};
  for (const int size : {3, 2, 4, 1, 5})
    put(Form::polynomial, size, size);
  for (const int size : {1, 2, 3})
    put(Form::with_static, size, size + 1);
  if (wanted(Form::table))
    for (int size = 2; size <= most_points(rows); ++size)
      forms.push_back({Form::table, size});
  return forms;
}

/// Each form fitted to rows; tables of all sizes by one search of their knots.
std::vector<Candidate> fitted(const std::vector<ShearForm>& forms, const LoadRows& rows, double end,
                              const Problem& problem) {
  std::vector<Candidate> candidates;
  std::vector<std::vector<double>> knots;
  int most = 0;
  for (const ShearForm& form : forms)
    if (form.kind == Form::table) most = std::max(most, form.size);
  if (most > 0) knots = grow_knots(torque_rows(rows, problem.test, problem.fabric, 1.0), end, most);
  for (const ShearForm& form : forms) {
    std::vector<double> own;
    if (form.kind == Form::table)
      own = knots[std::min(knots.size(), static_cast<std::size_t>(form.size)) - 1];
    candidates.push_back(
        {form, solve_shear(form, rows, end, problem.test, problem.fabric, own), own});
  }
  return candidates;
}

/// Numbers of the rows that are left out together.
std::vector<std::vector<Index>> folds_of(const Problem& problem) {
  std::vector<std::vector<Index>> folds;
  Index begin = 0;
  if (problem.specimens.size() > 1) {
    for (const ShearSpecimen& specimen : problem.specimens) {
      folds.emplace_back();
      for (std::size_t i = 0; i < specimen.angle.size(); ++i)
        folds.back().push_back(begin++);
    }
    return folds;
  }
  constexpr Index most = 20;
  const Index inner = problem.all.x.size() - 2, count = std::min(most, inner);
  for (Index fold = 0; fold < count; ++fold) {
    folds.emplace_back();
    for (Index i = fold * inner / count; i < (fold + 1) * inner / count; ++i)
      folds.back().push_back(1 + i);
  }
  return folds;
}

/// Errors of predicted rows.
void cross_validate(std::vector<Candidate>& candidates, const Problem& problem) {
  const LoadRows& all = problem.all;
  const Eigen::ArrayXd weights = load_weights(all.y, all.y);
  std::vector<ShearForm> forms;
  for (const Candidate& candidate : candidates)
    forms.push_back(candidate.form);
  const auto folds = folds_of(problem);
  const bool several = problem.specimens.size() > 1; // they differ by factors, not in their form
  double done = 0.0;
  for (const std::vector<Index>& fold : folds) {
    if (problem.options.progress)
      problem.options.progress(done++ / static_cast<double>(folds.size()));
    std::vector<Index> rest;
    for (Index i = 0; i < all.x.size(); ++i)
      if (!std::binary_search(fold.begin(), fold.end(), i)) rest.push_back(i);
    const LoadRows known = rows_of(all, rest);
    const double end = shear_angle(problem.test, known.x.maxCoeff());
    const std::vector<Candidate> without = fitted(forms, known, end, problem);
    std::vector<Index> within; // rows beyond the others say nothing about the law's form
    for (const Index i : fold)
      if (all.x[i] <= known.x.maxCoeff()) within.push_back(i);
    if (within.empty()) continue;
    const LoadRows left = rows_of(all, within);
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const ShearSolution& s = without[c].solution;
      const Eigen::ArrayXd predicted = weights(within) * (s.law.loads(left.x) * s.fit.k).array(),
                           measured = weights(within) * left.y.array();
      const double factor = several ? (measured * predicted).sum() / predicted.square().sum() : 1.0;
      candidates[c].folds.push_back((measured - factor * predicted).square().mean());
    }
  }
  if (problem.options.progress) problem.options.progress(1.0);
  for (Candidate& candidate : candidates)
    for (const double fold : candidate.folds)
      candidate.mean += fold / static_cast<double>(candidate.folds.size());
}

/// Of the mean difference between two laws' errors of the same rows.
double standard_error(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i)
    differences.push_back(a[i] - b[i]);
  const double n = static_cast<double>(differences.size());
  return n < 2.0 ? 0.0 : spread_of(differences).deviation / std::sqrt(n);
}

/// Whether nothing tells a disturbance from a static torque.
bool is_hidden(const Disturbance& d, const ShearSpecimen& specimen) {
  return d.kind == DisturbanceKind::load_zero && specimen.angle.front() > near_zero;
}

/// What a polynomial of 3 with the best disturbance leaves of each specimen.
struct Disturbed {
  bool any = false;
  std::vector<double> squares, numbers;
  std::vector<Eigen::ArrayXd> weights;
};

Disturbed with_disturbances(const Problem& problem) {
  Disturbed result;
  const ShearForm three{Form::polynomial, 3};
  for (const ShearSpecimen& specimen : problem.specimens) {
    LoadRows rows = specimen.rows;
    const ShearSolution s =
        solve_shear(three, rows, specimen.angle.back(), problem.test, problem.fabric);
    rows.weights = s.fit.weights;
    result.squares.push_back(s.squares);
    result.numbers.push_back(3.0);
    result.weights.push_back(rows.weights);
    for (const Disturbance& d :
         fit_disturbances(s.law, rows, kinds_looked_for(problem.options, problem.words))) {
      ShearLaw law;
      law.k = unscaled(d.k, s.scale);
      if (is_hidden(d, specimen) || invalid_at(law, near_zero, s.scale) <= s.scale) continue;
      result.any = result.any || is_found(d);
      result.squares.back() = d.squares;
      result.numbers.back() = 4.0;
      break;
    }
  }
  return result;
}

/// The law of a form of one specimen by itself.
ShearSolution own_law(const Candidate& candidate, const ShearSpecimen& specimen,
                      const Problem& problem) {
  if (problem.specimens.size() == 1) return candidate.solution;
  const double end = specimen.angle.back();
  return solve_shear(candidate.form, specimen.rows, end, problem.test, problem.fabric,
                     knots_to(candidate.knots, end));
}

/// Whether all specimens together and each have a law of the form.
bool gives_laws(const Candidate& candidate, const Problem& problem) {
  return is_law(candidate.solution) &&
         std::all_of(
             problem.specimens.begin(), problem.specimens.end(),
             [&](const ShearSpecimen& s) { return is_law(own_law(candidate, s, problem)); });
}

/// Chance that a form explains the rows of each specimen better than that by nothing but noise.
/// None where the other misses by a percent and three times as much: rows smoother than either law
/// have residuals that go together, and hardly any freedom.
double chance_of(const Candidate& candidate, const Disturbed& other, const Problem& problem) {
  double less = 0.0, more = 0.0, freedom = 0.0, further = 0.0, rows = 0.0;
  for (std::size_t n = 0; n < problem.specimens.size(); ++n) {
    const ShearSpecimen& specimen = problem.specimens[n];
    rows += static_cast<double>(specimen.rows.x.size());
    const ShearSolution s = own_law(candidate, specimen, problem);
    const double looked_for =
        candidate.knots.empty() ? 1.0 : static_cast<double>(s.shear().angle.size()) - 2.0;
    const double numbers = static_cast<double>(s.fit.k.size()) +
                           (candidate.form.kind == Form::polynomial ? 0.0 : looked_for);
    const Eigen::VectorXd residuals =
        (other.weights[n] * (specimen.rows.y - s.fit.fitted).array()).matrix();
    less += residuals.squaredNorm();
    more += other.squares[n];
    freedom += freedom_of(residuals, static_cast<Index>(numbers));
    further += std::max(1.0, numbers - other.numbers[n]);
  }
  if (!(less < more)) return 1.0;
  if (std::sqrt(more / rows) > 0.01 && more > 9.0 * less) return 0.0;
  return fisher_beyond((more - less) / further / (less / freedom), further, freedom);
}

/// Of all specimens, the misfit or noise of torque_misfit by their own laws.
double misfit_of(const Candidate& candidate, const Problem& problem,
                 double TorqueMisfit::*of = &TorqueMisfit::misfit) {
  double squares = 0.0;
  for (const ShearSpecimen& specimen : problem.specimens) {
    const ShearSolution s = own_law(candidate, specimen, problem);
    const double misfit = torque_misfit(s, specimen.rows, problem.test).*of;
    squares += misfit * misfit / static_cast<double>(problem.specimens.size());
  }
  return std::sqrt(squares);
}

/// The first of the laws that count which does as well as the best one.
const Candidate& simplest(const std::vector<const Candidate*>& counting, const Candidate& best,
                          const Problem& problem) {
  const double noise = misfit_of(best, problem, &TorqueMisfit::noise),
               most = std::max({noisy, 2.0 * noise, 2.0 * misfit_of(best, problem)});
  for (const Candidate* c : counting)
    if (c->mean - best.mean <= standard_error(c->folds, best.folds) &&
        misfit_of(*c, problem) <= most)
      return *c;
  return best; // where errors are no numbers
}

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100.0 * share);
}

std::string reason(const Candidate& chosen, const std::vector<Candidate>& candidates) {
  std::string text = fmt::format("cross-validated {}", percent(std::sqrt(chosen.mean)));
  for (const Candidate& other : candidates)
    if (other.form == ShearForm{} && !(chosen.form == other.form))
      text += fmt::format(", {} {}{}", other.form.name(), percent(std::sqrt(other.mean)),
                          other.valid ? "" : ", which falls or is negative");
  return text;
}

/// The choice among forms; `fewest`: rows of a specimen.
LawChoice choose_among(const Problem& problem, const std::vector<ShearForm>& forms, Index fewest) {
  if (forms.empty()) return {};
  if (forms.size() == 1) {
    const std::vector<Candidate> only = fitted(forms, problem.all, problem.end, problem);
    return {only[0].solution.form, knots_in(only[0].solution.shear()), "as asked for"};
  }
  const ShearForm usual{};
  const bool free = !problem.options.law;
  Disturbed disturbed;
  if (free) {
    const ShearSolution three =
        solve_shear(usual, problem.all, problem.end, problem.test, problem.fabric);
    const double rms = std::sqrt(three.squares / static_cast<double>(problem.all.x.size()));
    if (rms < of_digits && is_law(three))
      return {usual, {}, "follows the rows to their last digits"};
    disturbed = with_disturbances(problem);
  }
  std::vector<Candidate> candidates = fitted(forms, problem.all, problem.end, problem);
  for (Candidate& candidate : candidates)
    candidate.valid = gives_laws(candidate, problem);
  std::vector<double> chance(candidates.size(), 0.0);
  constexpr Index few = 30; // rows: too few for a test, and cross-validation is quick
  const bool usual_is_law = free && candidates.front().valid;
  bool tested = disturbed.any || (usual_is_law && fewest >= few);
  bool other = !free || !tested;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!free || candidates[c].form == usual) continue;
    chance[c] = chance_of(candidates[c], disturbed, problem);
    other = other || (chance[c] < by_chance && candidates[c].valid);
  }
  if (!other && (usual_is_law || disturbed.any))
    return {usual, {}, "no other law follows the rows better by more than chance"};
  tested = tested && other;
  cross_validate(candidates, problem);
  std::vector<const Candidate*> counting;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (candidates[c].valid &&
        (!free || !tested || candidates[c].form == usual || chance[c] < by_chance))
      counting.push_back(&candidates[c]);
  if (counting.empty())
    return {forms.front(), candidates.front().knots, "no law's torque rises everywhere"};
  const Candidate& best =
      **std::min_element(counting.begin(), counting.end(),
                         [](const Candidate* a, const Candidate* b) { return a->mean < b->mean; });
  const Candidate& chosen = simplest(counting, best, problem);
  return {chosen.solution.form, knots_in(chosen.solution.shear()), reason(chosen, candidates)};
}

} // namespace

LawChoice choose_shear(const std::vector<ShearSpecimen>& given, double end, const ShearTest& test,
                       const Fabric& fabric, const FitOptions& options, const CurveWords& words) {
  std::vector<ShearSpecimen> specimens;
  Index fewest = most_rows;
  for (const ShearSpecimen& specimen : given) {
    specimens.push_back(with_means(specimen));
    fewest = std::min(fewest, specimens.back().rows.x.size());
  }
  const LoadRows all = rows_together(specimens);
  const Problem problem{specimens, all, end, test, fabric, options, words};
  return choose_among(problem, forms_of(options, fewest), fewest);
}

} // namespace plyform
