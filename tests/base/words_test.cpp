// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/words.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace plyform::words_test {
namespace {

TEST(Words, NumbersAreThoseOfTheWord) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(number_in("12.5"), 12.5);
  EXPECT_EQ(number_in("+12.5e-1"), 1.25);
  EXPECT_EQ(number_in("-0.5"), -0.5);
  for (const char* none : {"", "+", "+-1", "12,5", "1.5mm", " 1", "1 ", "0x10", "1e"})
    EXPECT_FALSE(number_in(none)) << none;
  // Beyond what a double holds: by the place of the first digit, not by the sign of the exponent.
  EXPECT_EQ(number_in("1.5e-400"), 0.0);
  EXPECT_EQ(number_in("1.5e400"), inf);
  EXPECT_EQ(number_in("-1.5e400"), -inf);
  EXPECT_TRUE(std::signbit(*number_in("-1e-999999999999999999999")));
  EXPECT_EQ(number_in("1e999999999999999999999"), inf);
  EXPECT_EQ(number_in(std::string(400, '7')), inf);
  EXPECT_EQ(number_in("0." + std::string(400, '0') + "7"), 0.0);
  EXPECT_EQ(number_in("0." + std::string(400, '0') + "7e800"), inf);
  EXPECT_EQ(number_in(std::string(400, '7') + ".5e-800"), 0.0);
  EXPECT_EQ(number_in("0." + std::string(400, '0') + "7e400"), 0.7);
  EXPECT_EQ(number_in("inf"), inf);
  EXPECT_TRUE(std::isnan(*number_in("nan")));
}

TEST(Words, WhatATerminalObeysIsShownAsText) {
  EXPECT_EQ(printable("90\u00b0, \u00e4\u00df\u6f22 \U0001F600"),
            "90\u00b0, \u00e4\u00df\u6f22 \U0001F600");
  EXPECT_EQ(printable("\x1b[2J\a"), "\\x1b[2J\\x07");
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(printable("a\nb\tc\rd", "\n\t"), "a\nb\tc\\rd");
  EXPECT_EQ(printable(std::string_view("\0\x7f", 2)), "\\x00\\x7f");
  EXPECT_EQ(printable("\u009b\u202e\u200b\u2028\ufeff"),
            "\\u{9b}\\u{202e}\\u{200b}\\u{2028}\\u{feff}");
  // no UTF-8: a byte within a character alone, cut short, too long, a surrogate, beyond the last
  EXPECT_EQ(printable("\x9b\xc3"), "\\x9b\\xc3");
  EXPECT_EQ(printable("\xe4hnlich"), "\\xe4hnlich");
  EXPECT_EQ(printable("\xc0\x80\xed\xa0\x80"), "\\xc0\\x80\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
  for (const std::string text : {"\x1b", "\xff", "\u202e", "a\\b"})
    EXPECT_EQ(printable(printable(text)), printable(text)) << "once is enough";
}

TEST(Words, LongTextsAreCutBetweenCharacters) {
  EXPECT_EQ(shown("short"), "short");
  EXPECT_EQ(shown(std::string(61, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(shown("\u00e4\u00e4\u00e4", 2), "\u00e4\u00e4...");
  EXPECT_EQ(shown("\x1b\x1b\x1b", 2), "\\x1b\\x1b...");
}

} // namespace
} // namespace plyform::words_test
