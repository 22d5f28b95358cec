// SPDX-License-Identifier: GPL-3.0-or-later
// The tests that plyform identify knows, each with its options: the command line, its JSON for
// programs (plyform keys --identify) and the page of the workbench are made of this.
#pragma once

#include "tools/identify/identify_parts.hpp"

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

/// What a law is found from.
struct TestInput {
  const IdentifyArguments& arguments;
  const FabricReading& base;
  const std::optional<PreparedShear>& shear; ///< of tests of shear
  const std::vector<Curve>&curves, &others;
  const FitOptions& options;
};

/// Finds the law, or reports errors and returns nothing.
using FindLaw = std::optional<Identified> (*)(const TestInput& input, Diagnostics& diagnostics);

struct IdentifyTest {
  std::string name;                                  ///< frame
  std::string title, help;                           ///< "Picture frame"; what it makes of what
  std::string gives, curve;                          ///< laws; what a file has
  CurveColumns (*columns)(const IdentifyArguments&); ///< of a curve; nullptr: a reader of its own
  std::string (*words)(const IdentifyArguments&);    ///< "picture frame of 200 mm, ..."
  FindLaw find;
  std::vector<TestOption> options;
  bool changes_fabric = true; ///< else it writes a part of a case
};

const std::vector<IdentifyTest>& identify_tests();
/// All of it but what it is done by, as JSON for programs.
std::string identify_tests_json();
/// Of that name, which must be one.
const IdentifyTest& identify_test(const std::string& name);

std::optional<Identified> find_shear(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_tension(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_biaxial(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_rubber(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_compression(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_cantilever(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_three_point(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_relaxation(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_zone(const TestInput& input, Diagnostics& diagnostics);
std::optional<Identified> find_compaction(const TestInput& input, Diagnostics& diagnostics);

} // namespace plyform
