// SPDX-License-Identifier: GPL-3.0-or-later
// The options of plyform identify and plyform theory on the command line.
#include "tools/cli/commands.hpp"
#include "tools/identify/identify_tests.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace plyform {
namespace {

using Kind = TestOption::Kind;

void add_option(CLI::App& test, const TestOption& one, IdentifyArguments& to) {
  const std::string name = (one.name == "output" ? "-o,--" : "--") + one.name;
  std::string words = one.words; // the unit stands before the default, which ends it
  if (!one.unit.empty()) words.insert(std::min(words.find(" ["), words.size()), ", " + one.unit);
  CLI::Option* option = std::visit(
      [&]<class Value>(Value* value) {
        if constexpr (std::is_same_v<Value, bool>)
          return test.add_flag(name, *value, words);
        else
          return test.add_option(name, *value, words);
      },
      one.target(to));
  if (one.kind == Kind::numbers) option->delimiter(',');
  if (!one.choices.empty()) option->check(CLI::IsMember(one.choices));
  if (one.most > 0.0 && std::holds_alternative<std::optional<int>*>(one.target(to)))
    option->check(CLI::Range(static_cast<int>(one.least), static_cast<int>(one.most)));
  else if (one.most > 0.0)
    option->check(CLI::Range(one.least, one.most));
  option->required(one.required);
}

void add_specimen(CLI::App& test, const std::string& name, SpecimenArguments& to) {
  if (name == "bias") {
    test.add_option("--length", to.length, "free length between the clamps, mm")->required();
    test.add_option("--width", to.width, "width, mm")->required();
  } else {
    test.add_option("--side", to.side,
                    "side from hinge to hinge, mm; not needed for N/mm over an angle");
  }
}

} // namespace

void add_identify_tests(CLI::App& command, IdentifyArguments& to) {
  command.require_subcommand(1);
  for (const IdentifyTest& one : identify_tests()) {
    CLI::App* test = command.add_subcommand(one.name, one.help);
    test->add_option("curves", to.curves, "CSV files, FILE or FILE:COLUMN: " + one.curve)
        ->required();
    for (const TestOption& option : one.options)
      add_option(*test, option, to);
    test->callback([&to, name = one.name] { to.test = name; });
  }
}

void add_theory_tests(CLI::App& command, TheoryArguments& to) {
  command.require_subcommand(1);
  for (const std::string name : {"bias", "frame"}) {
    CLI::App* test = command.add_subcommand(
        name, name == "bias" ? "bias-extension test, equation (40)" : "picture frame, (41)");
    test->add_option("--fabric", to.fabric, "fabric file")->required();
    add_specimen(*test, name, to.specimen);
    if (name == "frame") test->get_option("--side")->required();
    test->add_option("--to", to.to, "last shear angle, degrees")->required();
    test->add_option("--points", to.points, "rows after the first, at 0 [100]");
    test->add_flag("--negative", to.negative,
                   "of negative shear angles: the specimen lies the other way round");
    test->add_option("-o,--output", to.output, "CSV file to write")->required();
    test->callback([&to, name] { to.test = name; });
  }
}

} // namespace plyform
