// SPDX-License-Identifier: GPL-3.0-or-later
// The tests that plyform identify knows, each with its options: the command line, its JSON for
// programs (plyform keys --identify) and the page of the workbench are made of this.
#pragma once

#include "tools/cli/commands.hpp"

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace plyform {

/// Where a value of an option goes.
using OptionTarget =
    std::variant<double*, std::optional<double>*, std::optional<int>*, std::string*,
                 std::vector<double>*, std::vector<std::string>*, bool*>;

struct TestOption {
  enum class Kind { number, numbers, fit, only_fit, text, choice, flag, files };
  enum class Place { size, more, command }; ///< on a page: above, below "more", or not at all
  std::string name;                         ///< without --
  Kind kind = Kind::number;
  std::string unit, words;
  std::function<OptionTarget(IdentifyArguments&)> target;
  Place place = Place::more;
  bool required = false;
  std::vector<std::string> choices = {};
  double least = 0.0, most = 0.0; ///< of numbers, where they are not checked later; both 0: any
};

struct IdentifyTest {
  std::string name;         ///< frame
  std::string title, help;  ///< "Picture frame"; what it makes of what
  std::string gives, curve; ///< laws; what a file has
  std::vector<TestOption> options;
  bool changes_fabric = true; ///< else it writes a part of a case
};

const std::vector<IdentifyTest>& identify_tests();

} // namespace plyform
