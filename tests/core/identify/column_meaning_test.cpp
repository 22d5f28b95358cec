// SPDX-License-Identifier: GPL-3.0-or-later
// What headers of test machines and spreadsheets say of their columns.
#include "core/identify/column_meaning.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace plyform::column_meaning_test {
namespace {

using Q = Quantity;

TEST(ColumnMeaning, AreReadFromHeadersAsTheyAreWritten) {
  struct Header {
    const char *name, *below;
    Quantity quantity;
    double factor;
  };
  const Header headers[] = {{"displacement_mm", "", Q::length, 1.0},
                            {"upper_grip_force_N", "", Q::force, 1.0},
                            {"shear_deg", "", Q::angle, degree},
                            {"Load (kN)", "", Q::force, 1000.0},
                            {"Extension [cm]", "", Q::length, 10.0},
                            {"F / N", "", Q::force, 1.0},
                            {"F/kN", "", Q::force, 1000.0},
                            {"Weg in mm", "", Q::length, 1.0},
                            {"Load", "(N)", Q::force, 1.0},
                            {"x", "m", Q::length, 1000.0},
                            {"x", "[kN]", Q::force, 1000.0},
                            {"Tensile strain (mm/mm)", "", Q::strain, 1.0},
                            {"strain_%", "", Q::strain, 0.01},
                            {"Elongation (%)", "", Q::strain, 0.01},
                            {"gamma (\xC2\xB0)", "", Q::angle, degree},
                            {"Shear angle rad", "", Q::angle, 1.0},
                            {"KN", "KN", Q::force, 1000.0},
                            {"Force (crosshead)", "", Q::force, 1.0},
                            {"Crosshead travel", "", Q::length, 1.0},
                            {"Shear angle", "", Q::angle, degree},
                            {"Time (s)", "", Q::time, 1.0},
                            {"Stress (MPa)", "", Q::stress, 1.0},
                            {"Force per width (N/mm)", "", Q::force_per_length, 1.0},
                            {"f_N_per_mm", "", Q::force_per_length, 1.0},
                            {"F / kN/m", "", Q::force_per_length, 1.0},
                            {"F", "N/m", Q::force_per_length, 1e-3},
                            {"shear_mJ", "", Q::other, 1.0},
                            {"energy_N_mm", "", Q::other, 1.0},
                            {"d", "", Q::unknown, 1.0},
                            {"N", "", Q::unknown, 1.0},
                            {"balance_error", "", Q::unknown, 1.0},
                            {"", "", Q::unknown, 1.0}};
  for (const Header& h : headers) {
    const ColumnMeaning meaning = meaning_of(h.name, h.below);
    EXPECT_EQ(quantity_name(meaning.quantity), quantity_name(h.quantity)) << h.name << h.below;
    EXPECT_DOUBLE_EQ(meaning.factor, h.factor) << h.name << h.below;
  }
}

TEST(ColumnMeaning, WordsAreWholeWords) {
  EXPECT_TRUE(has_word("Tip deflection (mm)", "sag deflection"));
  EXPECT_FALSE(has_word("sagging", "sag deflection"));
}

} // namespace
} // namespace plyform::column_meaning_test
