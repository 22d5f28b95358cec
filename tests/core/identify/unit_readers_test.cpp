// SPDX-License-Identifier: GPL-3.0-or-later
// Every name in the table of units, in every place of a curve where a unit may stand, and units
// that are not in it refused by each of them.
#include "core/identify/test_columns.hpp"
#include "support/curve_reading.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace plyform::unit_readers_test {
namespace {

using Q = Quantity;

std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text)
    field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

/// A test with a column of the quantity: its word in a header, whether it is y, the other column.
struct Place {
  Quantity quantity;
  std::string word;
  bool is_y;
  std::string other;
  CurveColumns columns;
};

CurveColumns relaxation() {
  CurveColumns columns;
  columns.x_is = Q::time;
  columns.x_word = columns.x_preferred = "time";
  return columns;
}

std::vector<Place> places() {
  return {{Q::length, "extension", false, "load (N)", shear_columns(true)},
          {Q::force, "load", true, "extension (mm)", shear_columns(true)},
          {Q::force_per_length, "load", true, "extension (mm)", shear_columns(true)},
          {Q::strain, "strain", false, "load (N)", tension_columns(true)},
          {Q::stress, "stress", true, "strain (%)", rubber_columns(false, false)},
          {Q::time, "time", false, "load (N)", relaxation()},
          {Q::angle, "shear angle", true, "distance (mm)", zone_columns()}};
}

/// Files that give a column a unit: in brackets of three kinds, behind a stroke, "in", a blank or
/// an underscore, in a row below.
std::vector<std::string> headers(const Place& place, const std::string& unit, bool at_end = true) {
  std::vector<std::string> names;
  const auto both = [&](const std::string& name) {
    return place.is_y ? quoted(place.other) + "," + quoted(name)
                      : quoted(name) + "," + quoted(place.other);
  };
  for (const std::string& name : {place.word + " (" + unit + ")", place.word + " [" + unit + "]",
                                  place.word + " {" + unit + "}"})
    names.push_back(both(name) + "\n");
  names.push_back(both(place.word) +
                  (place.is_y ? "\n," + quoted(unit) : "\n" + quoted(unit) + ",") + "\n");
  if (at_end)
    for (const std::string& name :
         {place.word + " / " + unit, place.word + "/" + unit, place.word + " in " + unit,
          place.word + " " + unit, place.word + "_" + unit, place.word + "_" + unit + "_raw"})
      names.push_back(both(name) + "\n");
  return names;
}

const char* rows = "0.25,0.25\n3,3\n";

double read_number(const Place& place, const Curve& curve) {
  return place.is_y ? curve.y[1] : curve.x[1];
}

TEST(UnitReaders, KnowEveryNameOfTheTable) {
  for (const Place& place : places())
    for (const std::string& unit : unit_names(place.quantity)) {
      const double factor = find_unit(unit)->factor;
      // what is said in one word; of "pound-force" its words stand for other things at an end
      const bool one_word = unit.find_first_of("-\"") == std::string::npos;
      for (const std::string& header : headers(place, unit, one_word)) {
        const CurveReading reading = curve_from(header + rows, place.columns);
        ASSERT_TRUE(reading.curve) << header << reading.texts;
        EXPECT_DOUBLE_EQ(read_number(place, *reading.curve), 3.0 * factor) << header;
      }
      CurveColumns columns = place.columns;
      (place.is_y ? columns.y : columns.x).unit = unit;
      const CurveReading reading =
          curve_from(quoted("a") + "," + quoted("b") + "\n" + rows, columns);
      ASSERT_TRUE(reading.curve) << unit << reading.texts;
      EXPECT_DOUBLE_EQ(read_number(place, *reading.curve), 3.0 * factor) << unit;
    }
}

TEST(UnitReaders, OfMeasuredAnglesToo) {
  for (const std::string& unit : unit_names(Q::angle)) {
    CurveColumns columns = shear_columns(true);
    columns.angle = {"phi", unit};
    const CurveReading reading = curve_from("extension,load,phi\n0,0,0\n1,1,0.5\n", columns);
    ASSERT_TRUE(reading.curve) << unit << reading.texts;
    EXPECT_DOUBLE_EQ(reading.curve->angle[1], 0.5 * find_unit(unit)->factor) << unit;
  }
}

const char* not_known[] = {"furlong", "fathom",   "rod",    "chain",     "league", "parsec",
                           "cubit",   "pica",     "twip",   "ell",       "span",   "barleycorn",
                           "slug",    "stone",    "grain",  "dram",      "cwt",    "carat",
                           "erg",     "sthene",   "crinal", "fortnight", "tick",   "jiffy",
                           "turn",    "quadrant", "octant", "barye",     "pieze",  "inchwater",
                           "kipz",    "ton",      "tonf",   "MN",        "grad"};

TEST(UnitReaders, RefuseWhatIsNotInIt) {
  ASSERT_GE(std::size(not_known), 30u);
  for (const Place& place : places())
    for (const std::string unit : not_known) {
      ASSERT_FALSE(find_unit(unit)) << unit;
      for (const std::string& header : headers(place, unit)) {
        const CurveReading reading = curve_from(header + rows, place.columns);
        EXPECT_FALSE(reading.curve) << header;
        EXPECT_NE(reading.texts.find(" = " + unit + ": is no unit of "), std::string::npos)
            << header << reading.texts;
        EXPECT_NE(reading.texts.find("give one of "), std::string::npos) << reading.texts;
        CurveColumns columns = place.columns; // but where the user says what it is
        (place.is_y ? columns.y : columns.x).unit = unit_names(place.quantity).front();
        EXPECT_TRUE(curve_from(header + rows, columns).curve) << header;
      }
      CurveColumns columns = place.columns;
      (place.is_y ? columns.y : columns.x).unit = unit;
      EXPECT_FALSE(curve_from("a,b\n0,0\n3,3\n", columns).curve) << unit;
      columns = shear_columns(true);
      columns.angle = {"phi", unit};
      EXPECT_FALSE(curve_from("extension,load,phi\n0,0,0\n1,1,0.5\n", columns).curve) << unit;
    }
}

TEST(UnitReaders, TakeWordsThatAreNoUnits) {
  for (const char* header :
       {"extension (crosshead),load (cell 2)\n", "extension_1,load_2\n", "extension A,load B\n",
        "Crosshead extension,Load cell\n", "extension (mm) (raw),load (kN) (filtered)\n",
        "extension_mm_raw,load_kN_mean\n", "mm extension,kN load\n", "extension,load\nraw,mean\n"})
    EXPECT_TRUE(curve_from(std::string(header) + rows, shear_columns(true)).curve) << header;
  const CurveReading reading =
      curve_from("mm extension,kN load peak\n0,0\n3,3\n", shear_columns(true));
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_DOUBLE_EQ(reading.curve->y[1], 3000.0);
  EXPECT_DOUBLE_EQ(
      curve_from("extension (mm),load (pound force)\n0,0\n3,3\n", shear_columns(true)).curve->y[1],
      3.0 * 4.4482216152605);
}

TEST(UnitReaders, RefuseOtherMeasures) {
  struct Column {
    const char *name, *word;
    CurveColumns columns;
    bool is_y;
  };
  const CurveColumns rubber = rubber_columns(false, false), tension = tension_columns(true);
  const Column columns[] = {
      {"True Stress (MPa)", "a true stress", rubber, true},
      {"Cauchy stress (MPa)", "a true stress", rubber, true},
      {"Kirchhoff stress (MPa)", "a true stress", rubber, true},
      {"second Piola stress (MPa)", "a second Piola-Kirchhoff", rubber, true},
      {"shear stress (MPa)", "a shear stress", rubber, true},
      {"true strain", "a logarithmic strain", rubber, false},
      {"log strain (%)", "a logarithmic strain", tension, false},
      {"Hencky strain", "a logarithmic strain", tension, false},
      {"Green-Lagrange strain", "a Green-Lagrange strain", tension, false},
      {"Almansi strain", "an Almansi strain", tension, false},
      {"shear strain", "a shear strain", tension, false},
      {"transverse strain", "not the strain along", tension, false},
      {"bending length (mm)", "a bending length",
       cantilever_columns(CantileverReading::chord_angle), false},
      {"half angle (deg)", "half of an angle", zone_columns(), true},
      {"angle between yarns (deg)", "an angle between the yarns", zone_columns(), true},
      {"shear force (N)", "a shear force", shear_columns(true), true},
      {"normalised force (N)", "a normalised force", shear_columns(true), true},
      {"width (mm)", "a size of the specimen", shear_columns(true), false},
      {"log10(time)", "a function", relaxation(), false}};
  for (const Column& column : columns) {
    CurveColumns named = column.columns;
    (column.is_y ? named.y : named.x).column = column.name;
    const std::string head =
        column.is_y ? "first," + std::string(column.name) : std::string(column.name) + ",second";
    const CurveReading reading = curve_from(head + "\n" + rows, named);
    EXPECT_FALSE(reading.curve) << column.name;
    EXPECT_NE(reading.texts.find(std::string("is ") + column.word), std::string::npos)
        << column.name << reading.texts;
  }
  for (const char* name : {"Engineering stress (MPa)", "nominal stress (MPa)", "stress"})
    EXPECT_TRUE(curve_from("strain," + std::string(name) + "\n" + rows, rubber).curve) << name;
}

TEST(UnitReaders, PreferTheMeasureThatATestTakes) {
  const CurveReading reading = curve_from(
      "true strain,strain,true stress (MPa),engineering stress (MPa)\n0,0,0,0\n0.1,0.2,5,4\n",
      rubber_columns(false, false));
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_EQ(reading.curve->x[1], 0.2);
  EXPECT_EQ(reading.curve->y[1], 4.0);
  const CurveReading frame =
      curve_from("extension,load,angle between yarns (deg)\n0,0,90\n3,3,80\n",
                 shear_columns(true)); // is not needed
  ASSERT_TRUE(frame.curve) << frame.texts;
  EXPECT_TRUE(frame.curve->angle.empty());
}

TEST(UnitReaders, TakeAStretchInAnyUnitForAStretch) {
  for (const char* header : {"stretch", "stretch (-)", "stretch (mm/mm)", "lambda [-]"}) {
    const CurveReading reading = curve_from(std::string(header) + ",stress (MPa)\n1,0\n1.5,3\n",
                                            rubber_columns(false, false));
    ASSERT_TRUE(reading.curve) << header << reading.texts;
    EXPECT_EQ(quantity_name(reading.curve->x_is), "stretch") << header;
  }
}

TEST(UnitReaders, ShowWhatTheFileHas) {
  CurveColumns columns = shear_columns(true);
  CurveReading reading = curve_from("extension (in),load (kN)\n0,0\n30,-0.001\n", columns);
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_EQ(written_x(*reading.curve, 1), "30");
  EXPECT_EQ(written_y(*reading.curve, 1), "-0.001");
  columns.x.unit = "in";
  reading = curve_from("d,load (kN)\n0,0\n30,-0.001\n", columns);
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_EQ(written_x(*reading.curve, 1), "30 in");
  reading.curve->y[1] -= 2.0;
  EXPECT_EQ(written_y(*reading.curve, 1), "-0.001 (-0.003 without what is taken off)");
}

} // namespace
} // namespace plyform::unit_readers_test
