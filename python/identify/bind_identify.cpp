// SPDX-License-Identifier: GPL-3.0-or-later
// Laws from measured curves as plyform identify finds them, and the curves that a fabric should
// give; python/plyform/_identify.py has the words.
#include "base/format.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "python/bindings.hpp"
#include "tools/identify/identify.hpp"
#include "tools/identify/identify_tests.hpp"
#include "tools/identify/theory.hpp"

#include <cmath>
#include <map>

namespace plyform {
namespace {

[[noreturn]] void refuse(const TestOption& option, const std::string& value,
                         const std::string& rule) {
  throw py::value_error(fmt::format("{} = {}: {}", option.name, value, rule));
}

double number_of(const TestOption& option, const std::string& text) {
  const std::optional<double> value = number_in(text);
  if (!value) refuse(option, text, "must be a number");
  if (option.most > 0.0 && !(*value >= option.least && *value <= option.most))
    refuse(option, text, fmt::format("must be {:g} to {:g}", option.least, option.most));
  return *value;
}

using Words = std::vector<std::string>;

void put(const TestOption& option, const Words& words, double* to) {
  *to = number_of(option, words.at(0));
}

void put(const TestOption& option, const Words& words, std::optional<double>* to) {
  *to = number_of(option, words.at(0));
}

void put(const TestOption& option, const Words& words, std::optional<int>* to) {
  const double value = number_of(option, words.at(0));
  if (value != std::floor(value) || std::abs(value) > 1e6)
    refuse(option, words[0], "must be a whole number");
  *to = static_cast<int>(value);
}

void put(const TestOption& option, const Words& words, std::string* to) {
  const std::vector<std::string>& choices = option.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), words.at(0)) == choices.end())
    refuse(option, words[0], "must be one of " + joined(choices));
  *to = words.at(0);
}

void put(const TestOption& option, const Words& words, std::vector<double>* to) {
  for (const std::string& word : words)
    to->push_back(number_of(option, word));
}

void put(const TestOption&, const Words& words, std::vector<std::string>* to) {
  *to = words;
}

void put(const TestOption&, const Words& words, bool* to) {
  *to = words.at(0) == "true";
}

using Options = std::map<std::string, Words>;

/// Raises ValueError for a test or an option that there is not, and for one that is missing.
IdentifyArguments arguments_of(const std::string& name, const Words& curves,
                               const Options& options) {
  const std::vector<IdentifyTest>& all = identify_tests();
  const auto test = std::find_if(all.begin(), all.end(),
                                 [&](const IdentifyTest& one) { return one.name == name; });
  if (test == all.end()) throw py::value_error(fmt::format("there is no test {}", name));
  for (const auto& [word, value] : options)
    if (std::none_of(test->options.begin(), test->options.end(),
                     [&word = word](const TestOption& one) { return one.name == word; }))
      throw py::value_error(fmt::format("{} has no option {}", name, word));
  IdentifyArguments arguments;
  arguments.test = name, arguments.curves = curves;
  for (const TestOption& option : test->options) {
    const auto given = options.find(option.name);
    if (given != options.end() && !given->second.empty())
      std::visit([&](auto* to) { put(option, given->second, to); }, option.target(arguments));
    else if (option.required)
      throw py::value_error(fmt::format("{} is missing: {}", option.name, option.words));
  }
  return arguments;
}

/// What is said, and warnings. Raises CaseError.
std::pair<std::string, Words> identified(const std::string& test, const Words& curves,
                                         const Options& options) {
  const Identification outcome = identify(arguments_of(test, curves, options), {});
  if (!outcome.diagnostics.errors.empty()) raise_mistakes(outcome.diagnostics.errors);
  return {outcome.said, outcome.diagnostics.warnings};
}

py::array array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::dict theory_shear(const std::string& name, double length, double width, double side,
                      const std::string& file, double to_deg, int points, bool negative) {
  TheoryArguments arguments{name, file, "", {length, width, side}, to_deg, points, negative};
  Diagnostics diagnostics;
  const auto curve = theory_curve(arguments, diagnostics);
  if (!curve) raise_mistakes(diagnostics.errors);
  py::dict all;
  all["displacement_mm"] = array_of(curve->displacement);
  all["shear_deg"] = array_of(curve->shear_deg);
  all["force_N"] = array_of(curve->force);
  return all;
}

} // namespace

void bind_identify(py::module_& m) {
  m.def("identify", &identified, py::arg("test"), py::arg("curves"), py::arg("options"),
        "What plyform identify says, and its warnings.");
  m.def("identify_tests", &identify_tests_json, "The tests with their options, JSON.");
  m.def("theory_shear", &theory_shear, py::arg("test"), py::arg("length"), py::arg("width"),
        py::arg("side"), py::arg("fabric"), py::arg("to_deg"), py::arg("points"),
        py::arg("negative"), "The curve that a fabric should give.");
}

} // namespace plyform
