// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that a run has one of in each of its states: of itself, of bodies, of plies. One
// table, by which history.csv and /history in results.h5 are written.
#pragma once

#include "core/results/frame.hpp"

#include <string>
#include <vector>

namespace plyform {

/// A number of a state beside its value.
struct StateNumber : Description {
  Location location = Location::run;
  std::string body = {}; ///< the ply, tool or boundary that it is of; empty of the run
  bool energy = false;   ///< one of energy_terms
  bool in_table = true;  ///< of history.csv, which of plies has loads only
};

/// One number over the states of a run.
struct Series {
  StateNumber what;
  std::vector<double> values; ///< one a state

  /// Its heading in history.csv: the body's name before its own.
  std::string heading() const {
    return what.body.empty() ? what.name : what.body + "_" + what.name;
  }
};

/// For checkpoints: base/archive.hpp.
template <class F>
void each_member(Series& series, F&& f) {
  StateNumber& what = series.what;
  f("name", what.name), f("word", what.word), f("label", what.label), f("unit", what.unit);
  f("digits", what.digits), f("precision", what.precision), f("scale", what.scale);
  f("note", what.note), f("location", what.location), f("body", what.body);
  f("energy", what.energy), f("in_table", what.in_table), f("values", series.values);
}

/// Adds a state to each series, which are begun by the first.
void append_state(std::vector<Series>& history, const Frame& frame);

} // namespace plyform
