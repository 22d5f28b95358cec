// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of a curve by name, number, header and unit; and every doubt refused.
#include "support/curve_reading.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace plyform::curve_columns_test {
namespace {

using Values = std::vector<double>;

CurveColumns shear() {
  CurveColumns columns;
  columns.with_angle = true;
  return columns;
}

TEST(CurveColumns, AreFoundByTheirUnitsWhereverTheyStand) {
  for (const char* text :
       {"displacement_mm,shear_deg,force_N\n0,0,0\n2,30,4\n",
        "Time (s);Load (kN);Gamma (deg);Extension (cm)\n0;0;0;0\n1;0.004;30;0.2\n",
        "t,F,phi,d\ns,N,deg,mm\n0,0,0,0\n1,4,30,2\n",
        "specimen A\nmachine 4\nLoad (N)\tExtension (mm)\tShear angle (deg)\n"
        "0\t0\t0\n4\t2\t30\n"}) {
    const CurveReading reading = curve_from(text, shear());
    ASSERT_TRUE(reading.curve) << text << reading.texts;
    EXPECT_EQ(reading.curve->x, (Values{0.0, 2.0})) << text;
    EXPECT_EQ(reading.curve->y, (Values{0.0, 4.0})) << text;
    ASSERT_EQ(reading.curve->angle.size(), 2u) << text;
    EXPECT_NEAR(reading.curve->angle[1], std::numbers::pi / 6.0, 1e-15) << text;
  }
}

TEST(CurveColumns, WithoutUnitsAreTwoOrNamed) {
  EXPECT_TRUE(curve_from("0,0\n1,2\n", shear()).curve);
  EXPECT_TRUE(curve_from("d,F\n0,0\n1,2\n", shear()).curve);
  EXPECT_TRUE(curve_from("time_s,d,F\n0,0,0\n1,1,2\n", shear()).curve); // the time is neither
  CurveColumns named = shear();
  named.x.column = "2";
  named.y.column = "1";
  named.y.unit = "kN";
  const CurveReading reading = curve_from("0,0,0\n1,2,3\n", named);
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_EQ(reading.curve->y, (Values{0.0, 1000.0}));
}

TEST(CurveColumns, TakeAStrainInPercentForOne) {
  CurveColumns columns;
  columns.x_is = Quantity::strain;
  columns.x_word = "strain";
  const CurveReading reading =
      curve_from("Extension (mm),Strain (%),Load (N)\n0,0,0\n2,1,46\n", columns);
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_EQ(reading.curve->x, (Values{0.0, 0.01}));
}

TEST(CurveColumns, MayLackTheCrossheadWhereTheAngleIsMeasured) {
  CurveColumns columns = shear();
  columns.angle.column = "gamma_rad";
  const CurveReading reading = curve_from("gamma_rad,force_N\n0,0\n0.5,3\n", columns);
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_EQ(reading.curve->angle, (Values{0.0, 0.5}));
  EXPECT_EQ(reading.curve->x_name, "");
}

TEST(CurveColumns, AreAnglesWithoutBeingNamedWhereThereIsNoExtension) {
  const char* laboratories = "shear_angle_deg,A,B,C\n0,,7,1\n5,1,8,2\n30,3,9,\n";
  CurveColumns columns = shear();
  columns.y = {"A", "N/mm"};
  columns.y_also = Quantity::force_per_length;
  const CurveReading reading = curve_from(laboratories, columns);
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_EQ(reading.curve->x_name, "");
  EXPECT_EQ(reading.curve->y, (Values{1.0, 3.0}));
  EXPECT_EQ(reading.curve->y_is, Quantity::force_per_length);
  EXPECT_NEAR(reading.curve->angle[1], std::numbers::pi / 6.0, 1e-15);
  EXPECT_EQ(rows_of(*reading.curve, {1}).y_is, Quantity::force_per_length);
  columns.y = {};
  EXPECT_NE(curve_from(laboratories, columns).texts.find("that it is the load, a force"),
            std::string::npos);
  // As many unknown columns as are needed are extension and load, as without an angle.
  EXPECT_EQ(curve_from("d,gamma_deg,F\n0,0,0\n2,30,4\n", columns).curve->x, (Values{0.0, 2.0}));
}

TEST(CurveColumns, OfForcePerLengthAreForTestsThatTakeThem) {
  CurveColumns columns = shear();
  const char* header = "gamma_deg,shear force (N/mm)\n0,0\n30,4\n";
  EXPECT_NE(curve_from(header, columns).texts.find("no column says"), std::string::npos);
  columns.no_per_length = "it is not the test's";
  for (const char* column : {"", "2"}) {
    columns.y.column = column;
    EXPECT_NE(
        curve_from(header, columns)
            .texts.find("shear force (N/mm) = N/mm: is a force per length, the load must be a "
                        "force: it is not the test's; take the load as measured, in N"),
        std::string::npos)
        << column << curve_from(header, columns).texts;
  }
  columns.y_also = Quantity::force_per_length;
  columns.no_per_length = {};
  EXPECT_TRUE(curve_from(header, columns).curve);
  columns.y.unit = "mm";
  EXPECT_NE(curve_from(header, columns).texts.find("give one of N, kN"), std::string::npos);
}

TEST(CurveColumns, OfAnotherKindOrInDoubtAreRefused) {
  struct Wrong {
    const char *text, *x, *y, *unit, *message;
  };
  const Wrong wrong[] = {
      {"d_mm,a_deg,F_N\n0,0,0\n", "", "a_deg", "",
       "a_deg = deg: is an angle, the load must be a force; take --y-column F_N"},
      {"d_mm,a_deg,F_N\n0,0,0\n", "", "2", "", "the load must be a force"},
      {"d_mm,a_deg\n0,0\n", "", "", "",
       "no column says by header or unit that it is the load, a force: the columns are d_mm "
       "(length, mm), a_deg (angle, deg); name it with --y-column"},
      {"d_mm,F1_N,F2_kN\n0,0,0\n", "", "", "",
       "2 columns may be the load: F1_N (force, N), F2_kN (force, kN); name one with --y-column"},
      {"a,b,c\n0,0,0\n", "", "", "", "the columns are a (of unknown kind), b (of unknown kind), c"},
      {"d_mm,stress_MPa\n0,0\n", "", "", "", "stress_MPa (stress, MPa)"},
      {"d_mm,F_N\n0,0\n", "", "F_N", "mm",
       "--y-unit:1:1: error: y-unit = mm: is no unit of a force"},
      {"d_mm,F_N\n0,0\n", "F_N", "", "", "F_N = N: is a force, the extension must be a length"}};
  for (const Wrong& w : wrong) {
    CurveColumns columns = shear();
    columns.x.column = w.x;
    columns.y.column = w.y;
    columns.y.unit = w.unit;
    const CurveReading reading = curve_from(w.text, columns);
    EXPECT_FALSE(reading.curve) << w.text;
    EXPECT_NE(reading.texts.find(w.message), std::string::npos)
        << w.text << "expected: " << w.message << "\nfound: " << reading.texts;
  }
}

TEST(CurveColumns, PreferTheWordsOfTheTest) {
  const CurveReading reading =
      curve_from("Width (mm),Extension (mm),Load (N)\n25,0,0\n25,1,2\n", shear());
  ASSERT_TRUE(reading.curve) << reading.texts;
  EXPECT_EQ(reading.curve->x, (Values{0.0, 1.0}));
}

} // namespace
} // namespace plyform::curve_columns_test
