// SPDX-License-Identifier: GPL-3.0-or-later
// The options of plyform identify and plyform theory on the command line, and those of identify as
// JSON for programs.
#include "tools/cli/identify/identify_tests.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

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

/// As programs have it.
const char* word_of(Kind kind) {
  constexpr const char* words[] = {"number", "numbers", "fit",  "only fit",
                                   "text",   "choice",  "flag", "files"};
  return words[static_cast<int>(kind)];
}

const char* word_of(TestOption::Place place) {
  constexpr const char* words[] = {"size", "more", "command"};
  return words[static_cast<int>(place)];
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

std::string identify_tests_json() {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (const IdentifyTest& test : identify_tests()) {
    Json options = Json::array();
    for (const TestOption& one : test.options) {
      options.push_back({{"name", one.name},
                         {"kind", word_of(one.kind)},
                         {"unit", one.unit},
                         {"words", one.words},
                         {"place", word_of(one.place)},
                         {"required", one.required}});
      if (one.kind == Kind::choice) options.back()["choices"] = one.choices;
    }
    all.push_back({{"name", test.name},
                   {"title", test.title},
                   {"gives", test.gives},
                   {"curve", test.curve},
                   {"changes_fabric", test.changes_fabric},
                   {"options", options}});
  }
  return all.dump();
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
