// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of friction: [friction.NAME], their keys and their reading.
#include "base/format.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/keys/schema_case.hpp"
#include "core/input/keys/temperature_keys.hpp"

#include <cmath>

namespace plyform {

namespace {

using K = KeyKind;
using FrictionKind = FrictionLawSpec::Kind;

constexpr Choice<FrictionKind> friction_kinds[] = {{"coulomb", FrictionKind::coulomb},
                                                   {"hersey", FrictionKind::hersey},
                                                   {"film", FrictionKind::film}};
constexpr Choice<bool> friction_beyond[] = {{"coulomb", false}, {"film", true}};

const Range mu_range{.least = 0.0, .most = 10.0};
const Range usual_mu{.least = 0.0, .most = 1.0};
const Range slid_range{.least = 0.0, .most = 1e4};
const Range resin_viscosity_range{.least = 0.0, .most = 1e9, .open_least = true};
const Range usual_resin_viscosity{.least = 0.1, .most = 1e6};

std::string friction_key(const std::string& name) {
  return "friction.NAME." + name;
}

/// Numbers of Hersey's curve.
Rows hersey_rows() {
  const std::vector<std::string> with{"hersey"};
  return {{.key = friction_key("curve"),
           .kind = K::pairs,
           .unit = "mm, -",
           .instead = {"exponent"},
           .ranges = {{.least = 1e-14, .most = 1e6}, {.least = 1e-6, .most = 1e3}},
           .usual = {{.least = 1e-10, .most = 1e3}, {.least = 0.01, .most = 2.0}},
           .least_items = 2,
           .of = "law",
           .with = with,
           .meaning = "[Hersey number, friction coefficient], straight in a plot of logarithms; "
                      "the Hersey number is viscosity times slip speed over pressure, in mm"},
          {.key = friction_key("exponent"),
           .instead = {"curve"},
           .ranges = {{.least = 0.01, .most = 2.0}},
           .usual = {{.least = 0.2, .most = 1.0}},
           .of = "law",
           .with = with,
           .meaning = "n of the formula mu = boundary exp(-H / transition) + hydrodynamic H^n, H "
                      "the Hersey number in mm: a Stribeck curve, or a power law without boundary",
           .members = {to(&FrictionLawSpec::exponent)}},
          {.key = friction_key("hydrodynamic"),
           .unit = "mm^-n",
           .fallback = "0.0",
           .ranges = {{.least = 0.0, .most = 1e9}},
           .of = "law",
           .with = with,
           .meaning = "friction coefficient of the formula's power law at 1 mm",
           .members = {to(&FrictionLawSpec::hydrodynamic)}},
          {.key = friction_key("boundary"),
           .fallback = "0.0",
           .ranges = {mu_range},
           .usual = {usual_mu},
           .of = "law",
           .with = with,
           .meaning = "friction coefficient of the formula at rest",
           .members = {to(&FrictionLawSpec::boundary)}},
          {.key = friction_key("transition"),
           .unit = "mm",
           .fallback = "1e-3",
           .ranges = {{.least = 1e-12, .most = 1e3}},
           .of = "law",
           .with = with,
           .meaning = "Hersey number over which the formula's boundary friction fades",
           .members = {to(&FrictionLawSpec::transition)}},
          {.key = friction_key("beyond"),
           .kind = K::choice,
           .fallback = "\"coulomb\"",
           .choices = words_of(friction_beyond),
           .of = "law",
           .with = with,
           .meaning = "beyond the curve's last Hersey number, as where nothing presses: the last "
                      "coefficient stays, or rises in proportion, a film that needs no pressure",
           .members = {to(&FrictionLawSpec::film_beyond, friction_beyond)}}};
}

Rows film_rows() {
  const std::vector<std::string> with{"hersey", "film"};
  return {{.key = friction_key("viscosity"),
           .unit = "Pa s",
           .instead = {"viscosity_curve"},
           .ranges = {resin_viscosity_range},
           .usual = {usual_resin_viscosity},
           .of = "law",
           .with = with,
           .meaning = "viscosity of the matrix between the faces",
           .members = {to(&FrictionLawSpec::viscosity)}},
          {.key = friction_key("viscosity_curve"),
           .kind = K::pairs,
           .unit = "1/s, Pa s",
           .instead = {"viscosity"},
           .ranges = {{.least = 1e-9, .most = 1e9}, resin_viscosity_range},
           .least_items = 2,
           .of = "law",
           .with = with,
           .meaning = "[shear rate, viscosity] of a matrix that thins, straight in a plot of "
                      "logarithms; the rate is slip speed over film_thickness"},
          {.key = friction_key("film_thickness"),
           .unit = "mm",
           .otherwise = "not known; law film and viscosity_curve need it",
           .ranges = {{.least = 1e-6, .most = 10.0}},
           .usual = {{.least = 1e-3, .most = 1.0}},
           .of = "law",
           .with = with,
           .meaning = "thickness h of the film between the faces: shear stress is viscosity times "
                      "slip speed over h",
           .members = {to(&FrictionLawSpec::film)}},
          {.key = friction_key("yield"),
           .unit = "N/mm2",
           .fallback = "0.0",
           .ranges = {{.least = 0.0, .most = 1e3}},
           .usual = {{.least = 0.0, .most = 1.0}},
           .of = "law",
           .with = {"film"},
           .meaning = "shear stress that the film bears at rest",
           .members = {to(&FrictionLawSpec::yield)}}};
}

Rows factor_rows() {
  return {{.key = friction_key("over_angle"),
           .kind = K::pairs,
           .unit = "deg, -",
           .otherwise = "1 at all angles",
           .ranges = {{.least = 0.0, .most = 90.0}, {.least = 0.0, .most = 10.0}},
           .least_items = 2,
           .meaning = "[angle between the fibres of both faces, factor on the friction], between "
                      "plies; of each face the first family counts, as it runs at the time"},
          {.key = friction_key("over_slip"),
           .kind = K::pairs,
           .unit = "mm, -",
           .otherwise = "1 throughout",
           .ranges = {slid_range, {.least = 0.0, .most = 100.0}},
           .least_items = 2,
           .meaning = "[way slid since the faces touched, factor on the friction]: a peak at the "
                      "start"},
          {.key = friction_key("over_wear"),
           .kind = K::pairs,
           .unit = "mm, -",
           .otherwise = "1 throughout",
           .ranges = {{.least = 0.0, .most = 1e6}, {.least = 0.0, .most = 10.0}},
           .usual = {{.least = 0.0, .most = 1e6}, {.least = 0.1, .most = 2.0}},
           .least_items = 2,
           .of = "law",
           .with = {"coulomb"},
           .meaning = "[way slid since the start, factor on the friction]: faces that wear in; "
                      "lifting off a tool does not start it anew"},
          {.key = friction_key("tack"),
           .kind = K::pairs,
           .unit = "mm, N/mm2",
           .otherwise = "none",
           .ranges = {slid_range, {.least = 0.0, .most = 1e3}},
           .usual = {{.least = 0.0, .most = 1e3}, {.least = 0.0, .most = 1.0}},
           .least_items = 2,
           .meaning = "[way slid since the faces touched, shear stress beside the friction, "
                      "whatever presses]: tack that is overcome"}};
}

/// How the viscosity follows the temperature, of laws that have one.
Rows flow_rows() {
  Rows rows = temperature_law_rows(friction_key("temperature"), "the law's viscosity depends",
                                   "the viscosity of the film");
  rows[0].of = "law", rows[0].with = {"hersey", "film"};
  return rows;
}

FilmFlow read_flow(const TableView& section, Diagnostics& diagnostics) {
  const TemperatureFactor law = read_temperature_law(section, diagnostics);
  if (!law.depends()) return {};
  const TemperatureRange known = law.range();
  return {[law](double celsius) { return law.at(celsius); }, known.least, known.most};
}

/// Reads the law of one table.
struct LawReader {
  const TableView& section;
  Diagnostics& diagnostics;

  /// A table's points; `rises` by the first column.
  std::vector<CurvePoint> points(const std::string& name) const {
    std::vector<CurvePoint> found;
    const std::vector<Vec2> rows = pairs(section, name);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i > 0 && !(rows[i].x() > found.back().at)) {
        row_error(section, name, i, "must be greater than the first number of the row before",
                  "put the rows in ascending order, each first number once", diagnostics);
        return {};
      }
      found.push_back({rows[i].x(), rows[i].y()});
    }
    return found;
  }

  void fail(const std::string& name, const std::string& rule, const std::string& remedy) const {
    value_error(section, name, rule, remedy, diagnostics);
  }

  /// A stress that fell with the rate would have two speeds at one force.
  void check_thinning(const FrictionLawSpec& spec) const {
    for (std::size_t i = 1; i < spec.viscosity_curve.size(); ++i) {
      const CurvePoint &a = spec.viscosity_curve[i - 1], &b = spec.viscosity_curve[i];
      if (b.value * b.at < a.value * a.at)
        return fail("viscosity_curve",
                    fmt::format("falls faster than the rate rises between {:g} and {:g} 1/s, so "
                                "that the stress falls",
                                a.at, b.at),
                    "give viscosities that fall less than in proportion to the rate");
    }
  }

  FrictionLawSpec read() const {
    FrictionLawSpec spec;
    read_members(section, spec);
    spec.curve = points("curve");
    spec.viscosity_curve = points("viscosity_curve");
    spec.over_angle = points("over_angle");
    spec.over_slip = points("over_slip");
    spec.over_wear = points("over_wear");
    spec.tack = points("tack");
    spec.flow = read_flow(subsection(section, "temperature"), diagnostics);
    check_thinning(spec);
    if (spec.kind == FrictionKind::film && !given(section, "film_thickness"))
      fail("law", "needs film_thickness",
           "give the film_thickness, mm; or law = \"hersey\" with a curve");
    else if (given(section, "viscosity_curve") && !given(section, "film_thickness"))
      fail("viscosity_curve", "needs film_thickness, by which the rate follows from the slip speed",
           "give the film_thickness, mm, or one viscosity");
    if (given(section, "exponent") && !(spec.boundary > 0.0 || spec.hydrodynamic > 0.0))
      fail("exponent", "is of a formula without boundary and hydrodynamic, which is no friction",
           "give boundary, hydrodynamic or both, or a curve");
    return spec;
  }
};

} // namespace

Rows friction_law_rows() {
  Rows rows{{.key = "friction",
             .kind = K::map,
             .fallback = "{}",
             .meaning = "laws of friction, each under a name of your choice, which "
                        "contact.friction_law and [[contact.pair]] give to bodies"},
            {.key = "friction.NAME", .kind = K::table, .meaning = "law of friction"},
            {.key = friction_key("law"),
             .kind = K::choice,
             .choices = words_of(friction_kinds),
             .meaning = "coulomb: a coefficient; hersey: a coefficient over viscosity times slip "
                        "speed over pressure; film: viscosity times slip speed over its thickness",
             .members = {to(&FrictionLawSpec::kind, friction_kinds)}},
            {.key = friction_key("coefficient"),
             .ranges = {mu_range},
             .usual = {usual_mu},
             .of = "law",
             .with = {"coulomb"},
             .meaning = "friction coefficient, usually 0.1 to 0.4; 1 beside over_angle makes that "
                        "the coefficient",
             .members = {to(&FrictionLawSpec::coefficient)}}};
  append(rows, hersey_rows());
  append(rows, film_rows());
  append(rows, flow_rows());
  append(rows, factor_rows());
  return rows;
}

std::vector<FrictionLawPtr> read_friction_laws(const TableView& root, Diagnostics& diagnostics) {
  std::vector<FrictionLawPtr> laws;
  for (const TableView& section : subsections(root, "friction")) {
    const std::size_t before = diagnostics.errors.size();
    FrictionLawSpec spec = LawReader{section, diagnostics}.read();
    if (diagnostics.errors.size() > before || !is_sound(section)) spec = {}; // the case is not used
    spec.name = section.item.substr(section.item.find('.') + 1);
    laws.push_back(std::make_shared<FrictionLaw>(std::move(spec)));
  }
  return laws;
}

} // namespace plyform
