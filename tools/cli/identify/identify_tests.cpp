// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/identify/identify_tests.hpp"

#include <algorithm>

namespace plyform {
namespace {

using Kind = TestOption::Kind;
using Place = TestOption::Place;
using Options = std::vector<TestOption>;
using Target = std::function<OptionTarget(IdentifyArguments&)>;

/// A member of the arguments.
template <class Value>
Target at(Value IdentifyArguments::*member) {
  return [member](IdentifyArguments& a) -> OptionTarget { return &(a.*member); };
}

Target at(double SpecimenArguments::*member) {
  return [member](IdentifyArguments& a) -> OptionTarget { return &(a.specimen.*member); };
}

Target at(ColumnArguments IdentifyArguments::*column, std::string ColumnArguments::*member) {
  return [=](IdentifyArguments& a) -> OptionTarget { return &(a.*column.*member); };
}

TestOption number(std::string name, std::string unit, std::string words, Target target) {
  return {std::move(name), Kind::number, std::move(unit), std::move(words), std::move(target)};
}

TestOption size(std::string name, std::string unit, std::string words, Target target,
                bool required = false) {
  TestOption one = number(std::move(name), std::move(unit), std::move(words), std::move(target));
  one.place = Place::size, one.required = required;
  return one;
}

/// Several, with commas between.
TestOption numbers(std::string name, std::string unit, std::string words, Target target) {
  return {std::move(name), Kind::numbers, std::move(unit), std::move(words), std::move(target)};
}

TestOption text(std::string name, std::string words, Target target) {
  return {std::move(name), Kind::text, "", std::move(words), std::move(target)};
}

TestOption choice(std::string name, std::string words, std::vector<std::string> choices,
                  Target target) {
  TestOption one{std::move(name), Kind::choice, "", std::move(words), std::move(target)};
  one.choices = std::move(choices);
  return one;
}

TestOption flag(std::string name, std::string words, Target target) {
  return {std::move(name), Kind::flag, "", std::move(words), std::move(target)};
}

/// Curves of specimens of another kind.
TestOption files(std::string name, std::string words) {
  return {std::move(name), Kind::files, "", std::move(words), at(&IdentifyArguments::others)};
}

TestOption needed(TestOption one) {
  one.required = true;
  return one;
}

/// Above the fold of a page.
TestOption above(TestOption one) {
  one.place = Place::size;
  return one;
}

/// Of the command line only.
TestOption by_command(TestOption one) {
  one.place = Place::command;
  return one;
}

TestOption within(TestOption one, double least, double most) {
  one.least = least, one.most = most;
  return one;
}

Options together(std::initializer_list<Options> parts) {
  Options all;
  for (const Options& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Columns of `x` and `y`.
Options columns(const std::string& x, const std::string& y) {
  using A = IdentifyArguments;
  using C = ColumnArguments;
  const std::string column = "name or number of the column of ", unit = "unit of the ";
  return {
      text("x-column", column + x + " [as the header says]", at(&A::x, &C::name)),
      by_command(text("y-column", column + y + " [as the header says]", at(&A::y, &C::name))),
      text("x-unit", unit + x + ", if the header has none or a wrong one", at(&A::x, &C::unit)),
      text("y-unit", unit + y + ", if the header has none or a wrong one", at(&A::y, &C::unit))};
}

/// What it starts from and writes.
Options outputs() {
  using A = IdentifyArguments;
  return {by_command(needed(text("fabric", "fabric file with all but the law", at(&A::fabric)))),
          by_command(needed(text("output", "fabric file to write", at(&A::output)))),
          by_command(text("fit", "CSV file of measured and fitted rows [OUTPUT's stem_fit.csv]",
                          at(&A::fit))),
          by_command(text("report",
                          "JSON file of the law, its limits, warnings and mistakes, for programs; "
                          "also written where the curve is refused",
                          at(&A::report))),
          flag("yes-doubtful",
               "go on though the curve shows a disturbance or the law is no fabric's",
               at(&A::doubtful))};
}

/// Range of rows, and what machines add to a curve; `taut`: the unit of the toe.
Options corrections(const std::string& range, const std::string& unit, const std::string& taut) {
  using A = IdentifyArguments;
  const auto fit = [](std::string name, Kind kind, std::string of, std::string words, Target to) {
    return TestOption{std::move(name), kind, std::move(of), std::move(words), std::move(to)};
  };
  return {
      number("from", unit, range + " from which rows count [0]", at(&A::from)),
      number("to", unit, range + " up to which rows count", at(&A::to)),
      number("compliance", "mm/N", "by which machine, load cell and clamps give way; 0: none",
             at(&A::compliance)),
      fit("zero", Kind::fit, "N", "load that the cell shows without a load, or fit", at(&A::zero)),
      fit("toe", Kind::fit, taut,
          "extension at which the specimen is taut, or fit: toe compensation", at(&A::toe)),
      fit("slip", Kind::only_fit, "", "fit: takes a sudden slip in the clamps off", at(&A::slip))};
}

TestOption direction() {
  return above(needed(choice("direction", "yarns that it is a test of", {"warp", "weft", "both"},
                             at(&IdentifyArguments::direction))));
}

TestOption gauge_length() {
  return size("gauge-length", "mm", "if the curve has displacements in the place of strains [1]",
              at(&IdentifyArguments::gauge_length));
}

IdentifyTest shear_test(bool bias) {
  using A = IdentifyArguments;
  using S = SpecimenArguments;
  const Options sizes =
      bias ? Options{size("length", "mm", "free, between the clamps", at(&S::length), true),
                     size("width", "mm", "of the specimen", at(&S::width), true)}
           : Options{size("side", "mm", "from hinge to hinge; not needed for N/mm over an angle",
                          at(&S::side))};
  const Options form = {
      choice("law", "form of the law: static is a torque, then a polynomial [by cross-validation]",
             {"polynomial", "static", "table"}, at(&A::law)),
      number("coefficients", "", "of a polynomial: k1, k3, k5 ... [chosen, mostly 3]",
             at(&A::coefficients)),
      number("points", "", "of a table, but for [0, 0] [chosen]", at(&A::points)),
      text("stitch",
           "of the fabric, whose law is the difference between the two kinds of specimens",
           at(&A::stitch)),
      text("angle-column",
           "of a measured shear angle, in the place of the crosshead's; none: the crosshead's "
           "[measured where the file has one]",
           at(&A::angle, &ColumnArguments::name)),
      by_command(text("angle-file",
                      "CSV file of displacement and measured shear angle, or FILE:COLUMN of the "
                      "angle, of the same test",
                      at(&A::angle_file))),
      by_command(text("angle-unit", "its unit: deg or rad", at(&A::angle, &ColumnArguments::unit))),
      by_command(flag("laboratories",
                      "each curve is of a laboratory, not of a specimen: mean, scatter and three "
                      "fabric files; or NAME=FILE for each curve, several of a name for one",
                      at(&A::laboratories))),
      by_command(flag("skip-refused", "of laboratories: go on without a curve that is refused",
                      at(&A::skip_refused))),
      numbers("speeds", "mm/s",
              "of the crosshead in each curve: law with a viscous torque, from all curves at once",
              at(&A::speeds)),
      numbers("temperatures", "°C",
              "of each of them: with several, viscosity over temperature; that of the first curve "
              "is the reference",
              at(&A::temperatures)),
      choice("temperature-law",
             "form of viscosity over temperature; wlf takes three temperatures [arrhenius, or wlf "
             "where it fits better]",
             {"arrhenius", "wlf", "table"}, at(&A::temperature_law)),
      within(number("viscosity-coefficients", "",
                    "of the viscosity, with speeds: c0, c2, c4 [chosen]",
                    at(&A::viscosity_coefficients)),
             1, 3)};
  const std::string extension = bias ? "extension" : "extension of the diagonal";
  return {bias ? "bias" : "frame",
          bias ? "Bias extension" : "Picture frame",
          bias ? "shear law from bias-extension tests, equation (40) read backwards"
               : "shear law from picture-frame tests, equation (41) read backwards",
          "shear law",
          extension + " and load, a file a specimen" +
              (bias ? "" : "; or a normalised force in N/mm over the angle"),
          together({sizes,
                    form,
                    corrections("shear angle", "°", "mm"),
                    columns(extension, "load"),
                    {files("negative", "CSV files of specimens cut, or frames turned, the other "
                                       "way: the angle from the first family to the second opens")},
                    outputs()})};
}

IdentifyTest yarn_test(const std::string& name) {
  using A = IdentifyArguments;
  const bool pressed = name == "compression";
  Options sizes{size("yarns", "", "that share the force [1]", at(&A::yarns)), gauge_length()};
  if (pressed) sizes.push_back(direction());
  Options others;
  if (name == "warp")
    others = {
        files("weft", "CSV files of specimens of weft yarns, to compare with"),
        number("weft-yarns", "", "that share the force in those [as yarns]", at(&A::weft_yarns))};
  return {name,
          pressed ? "Compression of yarns" : "Tension of " + name + " yarns",
          pressed ? "compression of yarns, from a supported strip or yarn that is shortened"
                  : "tension law of the " + name + " yarns from yarn or strip tests",
          pressed ? "compression_stiffness, buckling_force" : "tension of one yarn",
          pressed ? "shortening and force of a strip held flat, both positive; one specimen"
                  : "strain or displacement, and load",
          together({sizes, corrections("strain", "", "mm or strain"),
                    columns(pressed ? "shortening" : "strain", "force"), others, outputs()})};
}

IdentifyTest biaxial_test() {
  using A = IdentifyArguments;
  return {"biaxial",
          "Biaxial tension",
          "tension of straight yarns and crimp of both, from biaxial tension curves",
          "tension of straight yarns and crimp",
          "warp strain, weft strain, warp load, weft load, a file for each strain ratio; a "
          "direction that was free may miss",
          together({{size("warp-yarns", "", "that share the load [1]", at(&A::warp_yarns)),
                     size("weft-yarns", "", "that share the load [1]", at(&A::weft_yarns)),
                     TestOption{"toe",
                                Kind::only_fit,
                                "",
                                "fit: takes wrong zeros of strain off",
                                at(&A::toe),
                                Place::more,
                                false,
                                {"fit"}}},
                    outputs()})};
}

IdentifyTest rubber_test(const std::string& name) {
  using A = IdentifyArguments;
  Options others;
  if (name == "uniaxial")
    others = {files("equibiaxial", "CSV files of specimens of the same rubber stretched both ways: "
                                   "one law of both")};
  return {name,
          (name == "uniaxial" ? "Uniaxial" : "Equibiaxial") + std::string(" tension of rubber"),
          "law of a sheet of rubber from " + name + " tension: neo-Hookean or Mooney-Rivlin",
          "law of a sheet of rubber",
          "strain, stretch or displacement, and load or nominal stress",
          together(
              {{size("width", "mm", "of the section, for loads in N; its thickness is the fabric's",
                     at(&SpecimenArguments::width)),
                gauge_length(),
                choice("law", "form of the law [by the rows]", {"neo_hookean", "mooney_rivlin"},
                       at(&A::law))},
               corrections("strain", "", "mm or strain"),
               columns("strain or stretch", "load or nominal stress"),
               others,
               outputs()})};
}

IdentifyTest cantilever() {
  return {"cantilever",
          "Cantilever",
          "bending stiffness from a strip that hangs over an edge (Peirce, ASTM D1388)",
          "bending_stiffness",
          "overhang, and angle of the chord or deflection of the tip; a row a reading",
          together({{above(choice("reading", "what is read beside the overhang [angle]",
                                  {"angle", "deflection"}, at(&IdentifyArguments::reading))),
                     direction()},
                    columns("overhang", "angle of the chord or deflection of the tip"),
                    {files("weft", "CSV files of specimens of weft yarns, to compare with; the "
                                   "direction is warp then")},
                    outputs()})};
}

IdentifyTest three_point() {
  using S = SpecimenArguments;
  return {"three-point",
          "Three-point bending",
          "bending stiffness from three-point bending",
          "bending_stiffness or bending_table",
          "deflection and force",
          together({{size("span", "mm", "distance of the supports", at(&S::span), true),
                     size("width", "mm", "of the strip", at(&S::width), true), direction()},
                    corrections("deflection over the span", "", "mm"),
                    columns("deflection", "force"),
                    outputs()})};
}

IdentifyTest relaxation() {
  using A = IdentifyArguments;
  using S = SpecimenArguments;
  TestOption times =
      within(numbers("times", "s", "relaxation times [looked for]", at(&A::times)), 1e-300, 1e300);
  return {"relaxation",
          "Relaxation of shear",
          "Maxwell branches of shear from the load after a frame or bias test has stopped",
          "Maxwell branches of shear",
          "time since the stop, and load; one test",
          together({{size("side", "mm", "of a frame: from hinge to hinge", at(&S::side)),
                     size("length", "mm", "of a bias test: free length", at(&S::length)),
                     size("width", "mm", "of a bias test", at(&S::width)),
                     size("angle", "°", "shear angle at the stop", at(&A::stop_angle), true),
                     within(size("ramp", "s", "time that it took to get there [0: at once]",
                                 at(&A::ramp)),
                            0.0, 1e6),
                     times},
                    columns("time since the stop", "load"),
                    outputs()})};
}

IdentifyTest in_plane_bending() {
  return {"in-plane-bending",
          "In-plane bending",
          "in-plane bending stiffness from the width of transition zones",
          "in_plane_bending_stiffness",
          "distance along a yarn and shear angle; a file a profile",
          together({{direction()}, columns("distance along a yarn", "shear angle"), outputs()})};
}

IdentifyTest pull_out() {
  using A = IdentifyArguments;
  const TestOption output = by_command(
      needed(text("output", "TOML file to write: [friction.NAME] of a case", at(&A::output))));
  Options written = outputs();
  written.erase(std::remove_if(written.begin(), written.end(),
                               [](const TestOption& one) {
                                 return one.name == "fabric" || one.name == "output" ||
                                        one.name == "yes-doubtful";
                               }),
                written.end());
  return {
      "pull-out",
      "Pull-out",
      "friction over viscosity times speed over pressure, from pull-out tests",
      "law of friction between plies, or plies and tools, for a case",
      "displacement and load of a ply drawn from between two faces, a file a test",
      together(
          {{size("area", "mm2", "of one face that is pulled; both slide", at(&A::area), true),
            above(needed(numbers("speeds", "mm/s", "of each test", at(&A::speeds)))),
            above(needed(numbers("pressures", "N/mm2", "of each test", at(&A::pressures)))),
            above(needed(numbers("viscosity", "Pa s",
                                 "of the matrix: one number, or one for each test",
                                 at(&A::viscosities)))),
            number("from", "mm", "displacement from which the pull is steady [0]", at(&A::from)),
            number("to", "mm", "displacement up to which it is", at(&A::to)),
            number("points", "", "of the curve [chosen]", at(&A::points)),
            text("name", "of the law in a case: [friction.NAME] [pull_out]", at(&A::name))},
           columns("displacement", "load"),
           {output},
           written}),
      false};
}

} // namespace

const std::vector<IdentifyTest>& identify_tests() {
  static const std::vector<IdentifyTest> all{shear_test(false),
                                             shear_test(true),
                                             yarn_test("warp"),
                                             yarn_test("weft"),
                                             biaxial_test(),
                                             rubber_test("uniaxial"),
                                             rubber_test("equibiaxial"),
                                             yarn_test("compression"),
                                             cantilever(),
                                             three_point(),
                                             relaxation(),
                                             in_plane_bending(),
                                             pull_out()};
  return all;
}

} // namespace plyform
