// SPDX-License-Identifier: GPL-3.0-or-later
// What laws of friction whose viscosity follows the temperature need of a case.
#include "base/format.hpp"
#include "core/input/keys/temperature_keys.hpp"
#include "core/model/reachable_temperature.hpp"

#include <algorithm>
#include <limits>

namespace plyform {
namespace {

/// The table of a body, by its number, and its name.
struct Body {
  TableView section;
  std::string name;
};
Body body_of(const TableView& root, const Case& built, int number) {
  const auto i = static_cast<std::size_t>(number);
  const bool ply = i < built.plies.size();
  const std::size_t at = ply ? i : i - built.plies.size();
  const std::vector<TableView> sections = subsections(root, ply ? "ply" : "tool");
  return {at < sections.size() ? sections[at] : root,
          ply ? "ply " + built.plies[at].name : "tool " + built.tools[at].name};
}

/// Reports a body without a temperature, on which a law acts; returns whether it has one. Plies
/// beside others that have one were told already.
bool has_its_own(const TableView& root, const Case& built, int number, const std::string& law,
                 Diagnostics& diagnostics) {
  if (reachable_temperatures(built, number)) return true;
  const bool any = has_temperature(built);
  const bool ply = number < static_cast<int>(built.plies.size());
  const Body body = body_of(root, built, number);
  if (any && ply) return false;
  const std::string rule = fmt::format("is missing, and friction.{} depends on it", law);
  if (any && body.section.entry)
    diagnostics.error(body.section.entry->at, item_of(body.section, "temperature"), "", rule,
                      "give the tool a temperature, degC");
  else
    diagnostics.error(root.entry->at, "process.temperature", "", rule,
                      "give [process] a temperature, degC");
  return false;
}

/// Reports a film that is always at a temperature that its law is not known for; returns whether it
/// is known.
bool check_constant(const TableView& section, const FrictionLawSpec& law, double celsius,
                    const std::string& between, Diagnostics& diagnostics) {
  const TemperatureRange known{law.flow.least, law.flow.most};
  if (known.holds(celsius)) return true;
  value_error(section, "temperature",
              fmt::format("is known for {}, and between {} it is {:.4g} degC, their mean",
                          known.text(), between, celsius),
              "give a law that reaches it, or other temperatures", diagnostics);
  return false;
}

/// Warns of a law that films may leave, once.
void check_reach(const TableView& section, const FrictionLawSpec& law,
                 const TemperatureRange& films, Diagnostics& diagnostics) {
  const TemperatureRange known{law.flow.least, law.flow.most};
  const TomlNode* table = given(section, "temperature");
  if (!table || (known.holds(films.least) && known.holds(films.most))) return;
  diagnostics.warning(table->at,
                      fmt::format("friction {}: films may come to {:.4g} to {:.4g} degC, means of "
                                  "both bodies, and their viscosity is known for {}: beyond, it "
                                  "stays as at the end",
                                  law.name, films.least, films.most, known.text()));
}

/// What one law needs.
void check_film(const TableView& root, const TableView& section, const Case& built, int number,
                Diagnostics& diagnostics) {
  const FrictionLawSpec& law = built.friction_laws[static_cast<std::size_t>(number)]->spec();
  TemperatureRange films{std::numeric_limits<double>::max(), absolute_zero};
  for (const auto& pair : pairs_of_law(built, number)) {
    for (const int body : {pair.first, pair.second})
      if (!has_its_own(root, built, body, law.name, diagnostics)) return;
    const TemperatureRange film = *film_temperatures(built, pair);
    if (film.least == film.most) {
      const std::string one = body_of(root, built, pair.first).name,
                        other = body_of(root, built, pair.second).name;
      const std::string between =
          pair.first == pair.second ? one + " and itself" : one + " and " + other;
      if (!check_constant(section, law, film.least, between, diagnostics)) return;
      continue;
    }
    films.least = std::min(films.least, film.least), films.most = std::max(films.most, film.most);
  }
  if (films.least < films.most) check_reach(section, law, films, diagnostics);
}

} // namespace

void check_films(const TableView& root, const Case& built, Diagnostics& diagnostics) {
  const std::vector<TableView> sections = subsections(root, "friction");
  for (std::size_t i = 0; i < built.friction_laws.size() && i < sections.size(); ++i)
    if (built.friction_laws[i]->spec().flow.factor)
      check_film(root, sections[i], built, static_cast<int>(i), diagnostics);
}

} // namespace plyform
