// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two kinds of specimens differ beyond their scatter: cut one way and the other, along warp
// and weft.
//
// Student's test of two groups, of logarithms: it is the scatter in percent that both share,
// however much more one of them bears. d = mean ln of the second - of the first, n_1 + n_2 - 2
// degrees of freedom. Of one specimen each nothing is known of scatter between specimens: what two
// of one kind usually differ by, and their own 95 % limits, take its place.
#pragma once

#include <vector>

namespace plyform {

/// Half widths of 95 % limits over the value; 0: not known.
struct OwnLimits {
  double first = 0.0, second = 0.0;
};

struct GroupDifference {
  double ratio = 1.0;             ///< second over first
  double least = 1.0, most = 1.0; ///< its 95 % limits
  double chance = 1.0;            ///< of a ratio as far from 1 if there were no difference
  bool between_specimens = false; ///< from scatter between them; else as usual
  /// Beyond scatter, as chance makes it once in a hundred, and by more than `noticed`.
  bool differs() const;
  static constexpr double rare = 0.01, noticed = 0.02;
  /// Within which, over the value, 95 of 100 pairs of specimens of one kind differ.
  static constexpr double usual_scatter = 0.1;
};

/// Of values above 0, each group at least one.
GroupDifference difference_of(const std::vector<double>& first, const std::vector<double>& second,
                              const OwnLimits& limits = {});

/// The same of laws at several places: values[specimen][place].
struct LawDifference {
  std::vector<double> places;      ///< those at which both are above 0
  std::vector<GroupDifference> at; ///< of each
  std::size_t clearest = 0; ///< of the largest difference beyond scatter; else of the least chance
  bool differs() const;     ///< at any place
};
LawDifference difference_of(const std::vector<double>& places,
                            const std::vector<std::vector<double>>& first,
                            const std::vector<std::vector<double>>& second,
                            const OwnLimits& limits = {});

} // namespace plyform
