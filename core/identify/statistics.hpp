// SPDX-License-Identifier: GPL-3.0-or-later
// Student's distribution and minima of functions of one variable.
#pragma once

#include <functional>
#include <vector>

namespace plyform {

/// Half width of the 95 % limits of a mean, over its standard error; `freedom` at least 1.
double student_95(double freedom);

/// Probability that |t| is at least this by chance.
double student_beyond(double t, double freedom);

/// Probability that Fisher's F is at least this by chance.
double fisher_beyond(double f, double above, double below);

/// Chance that one number more makes the sum of squared residuals so much less by nothing but
/// noise, by student_beyond. `freedom`: with that number.
double chance_of_gain(double squares, double less, double freedom);

/// The one rule of all tests: a further number, another form of a law, a part of the rows as the
/// elastic one or something that a machine has added is taken where chance, without it, would make
/// the rows gain as much once in this many curves.
inline constexpr double by_chance = 1e-3;

/// A curve is refused for it only where chance would do so once in this many: a good one is not to
/// be refused.
inline constexpr double surely_not_chance = 1e-6;

/// Place of a minimum of f in [least, most], to 1e-6 of their distance.
double minimum_of(const std::function<double(double)>& f, double least, double most);

/// The nearest values that nowhere fall (pool adjacent violators), as many.
std::vector<double> nearest_rising(const std::vector<double>& values);

struct Spread {
  double mean = 0.0;
  double deviation = 0.0; ///< standard deviation of one
  double limits = 0.0;    ///< half width of the 95 % limits of the mean
};

/// Of two values or more.
Spread spread_of(const std::vector<double>& values);

} // namespace plyform
