// SPDX-License-Identifier: GPL-3.0-or-later
// Words of files as numbers, and as they are shown in messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace plyform {

/// A word as a number with a decimal point, whatever the locale; infinite where it is too large,
/// and NaN and infinity as they are written. Nothing if it is none, or more follows.
std::optional<double> number_in(std::string_view word);

/// A to Z in small letters; other characters stay.
std::string lower_case(std::string_view text);

/// Text that a terminal shows as it is. Control characters, those that turn the direction of
/// writing or have no width, and bytes that are no UTF-8 become \n, \t, \x1b, \u{202e}. kept: of
/// the control characters those that stay.
std::string printable(std::string_view text, std::string_view kept = {});

/// Text of a file in a message: printable, and "..." for what follows the first `most` characters.
std::string shown(std::string_view text, std::size_t most = 60);

} // namespace plyform
