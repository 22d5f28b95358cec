// SPDX-License-Identifier: GPL-3.0-or-later
// What plyform identify has found, or why it has refused, as JSON for programs.
#include "base/version.hpp"
#include "base/write_whole.hpp"
#include "tools/identify/identify_parts.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace plyform {
namespace {

using Json = nlohmann::ordered_json;

/// Names of files may have bytes that are no text: they are replaced.
std::string dumped(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json number_json(const LawNumber& number) {
  return {{"name", number.name},
          {"unit", number.unit},
          {"value", number.value},
          {"limits", std::isfinite(number.limits) ? Json(number.limits) : Json()}};
}

Json error_json(const CaseError& error) {
  return {{"file", error.file},    {"line", error.line},   {"column", error.column},
          {"item", error.item},    {"value", error.value}, {"rule", error.rule},
          {"remedy", error.remedy}};
}

} // namespace

void write_report(const IdentifyArguments& arguments, const std::string& fit_file,
                  const FabricReading& base, const std::optional<Identified>& result,
                  const Diagnostics& diagnostics) {
  Json json{{"plyform", version()},
            {"test", arguments.test},
            {"words", test_words(arguments)},
            {"status", result ? "done" : "refused"}};
  Json errors = Json::array();
  for (const CaseError& error : diagnostics.errors)
    errors.push_back(error_json(error));
  json["errors"] = errors;
  json["warnings"] = diagnostics.warnings;
  if (result) {
    json["title"] = result->title;
    json["law"] = result->law_line;
    json["numbers"] = Json::array();
    for (const LawNumber& number : result->numbers)
      json["numbers"].push_back(number_json(number));
    json["figures"] = result->figures;
    json["notes"] = result->notes;
    json["missing"] = Json::array();
    for (const std::string& law : base.missing)
      if (std::find(result->provides.begin(), result->provides.end(), law) ==
          result->provides.end())
        json["missing"].push_back(law);
    json["output"] = arguments.output;
    json["fit"] = fit_file;
  }
  write_whole(arguments.report, dumped(json));
}

} // namespace plyform
