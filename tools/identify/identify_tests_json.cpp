// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/identify/identify_tests.hpp"

#include <nlohmann/json.hpp>

namespace plyform {
namespace {

using Kind = TestOption::Kind;

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

} // namespace

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

} // namespace plyform
