// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/test_columns.hpp"

#include "core/identify/normalised_force.hpp"

namespace plyform {

CurveColumns shear_columns(bool frame) {
  CurveColumns columns;
  columns.with_angle = true;
  columns.y_wanted = "load of the frame";
  if (frame)
    columns.y_also = Quantity::force_per_length;
  else
    columns.no_per_length = no_normalised_bias();
  return columns;
}

CurveColumns tension_columns(bool strain) {
  CurveColumns columns;
  columns.x_is = strain ? Quantity::strain : Quantity::length;
  columns.x_word = strain ? "strain" : "displacement";
  return columns;
}

CurveColumns rubber_columns(bool displacement, bool force) {
  CurveColumns columns = tension_columns(!displacement);
  if (!displacement) columns.x_also = Quantity::stretch;
  columns.y_word = "load";
  columns.y_is = force ? Quantity::force : Quantity::stress;
  columns.y_also = force ? Quantity::stress : Quantity::force;
  return columns;
}

CurveColumns three_point_columns() {
  CurveColumns columns;
  columns.x_word = "deflection";
  return columns;
}

CurveColumns cantilever_columns(CantileverReading reading) {
  const bool angle = reading == CantileverReading::chord_angle;
  CurveColumns columns;
  columns.x_word = "overhang";
  columns.x_preferred = columns.x_wanted = "overhang";
  columns.y_word = angle ? "angle of the chord" : "deflection of the tip";
  columns.y_is = angle ? Quantity::angle : Quantity::length;
  columns.y_preferred = "deflection sag drop";
  return columns;
}

CurveColumns zone_columns() {
  CurveColumns columns;
  columns.x_word = "distance along the yarn";
  columns.x_preferred = "distance position";
  columns.y_word = "shear angle";
  columns.y_preferred = "shear gamma";
  columns.y_wanted = "shear angle";
  columns.y_is = Quantity::angle;
  return columns;
}

CurveColumns compaction_columns() {
  CurveColumns columns;
  columns.x_word = columns.x_wanted = "thickness or fibre volume";
  columns.x_preferred = "thickness volume fraction gap";
  columns.x_also = Quantity::strain;
  columns.x_hint = "give --x-unit mm if it is a thickness";
  columns.y_word = "pressure";
  columns.y_is = Quantity::stress;
  return columns;
}

} // namespace plyform
