// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "core/identify/test_columns.hpp"
#include "tools/identify/identify_rates.hpp"
#include "tools/identify/option_rows.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace option_rows {
namespace {

using A = IdentifyArguments;

template <std::size_t n>
struct Words {
  char text[n]{};
  constexpr Words(const char (&of)[n]) { std::copy_n(of, n, text); } // NOLINT: "..." is one
};

/// A test without numbers in its name.
template <Words of>
std::string words(const IdentifyArguments&) {
  return of.text;
}

CurveColumns shear_columns_of(const A& a) {
  CurveColumns columns = shear_columns(a.test == "frame");
  columns.x_hint = "give --angle-column if it is a shear angle";
  return columns;
}

std::string shear_words(const A& a) {
  if (a.test == "bias")
    return fmt::format("bias-extension test, {:g} x {:g} mm, equation (40) read backwards",
                       a.specimen.length, a.specimen.width);
  return "picture frame" +
         (std::isnan(a.specimen.side) ? "" : fmt::format(" of {:g} mm", a.specimen.side)) +
         ", equation (41) read backwards";
}

CurveColumns yarn_columns_of(const A& a) {
  const bool strain = a.gauge_length == 1.0;
  CurveColumns columns = tension_columns(strain);
  columns.x_hint = strain ? "give --gauge-length if it is a displacement"
                          : "leave --gauge-length out if it is a strain";
  return columns;
}

std::string yarn_words(const A& a) {
  std::string words =
      fmt::format("{} test of {:g} yarn{}", a.test == "compression" ? "compression" : "tension",
                  a.yarns, a.yarns == 1.0 ? "" : "s");
  if (a.gauge_length != 1.0) words += fmt::format(", gauge length {:g} mm", a.gauge_length);
  return words;
}

CurveColumns rubber_columns_of(const A& a) {
  CurveColumns columns = rubber_columns(a.gauge_length != 1.0, !std::isnan(a.specimen.width));
  columns.x_hint = a.gauge_length == 1.0 ? "give --gauge-length if it is a displacement"
                                         : "leave --gauge-length out if it is a strain";
  return columns;
}

std::string rubber_words(const A& a) {
  std::string words = a.test + " tension of rubber";
  if (!a.others.empty()) words += ", and equibiaxial";
  if (!std::isnan(a.specimen.width)) words += fmt::format(", width {:g} mm", a.specimen.width);
  if (a.gauge_length != 1.0) words += fmt::format(", gauge length {:g} mm", a.gauge_length);
  return words;
}

std::string three_point_words(const A& a) {
  return fmt::format("three-point bending, span {:g} mm, width {:g} mm", a.specimen.span,
                     a.specimen.width);
}

std::string relaxation_words(const A& a) {
  return fmt::format("relaxation after a stop at {:g} degrees, ramp of {:g} s", a.stop_angle,
                     a.ramp);
}

/// Of shear: the law, measured angles, laboratories, rates.
Options shear_form() {
  return {
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
}

IdentifyTest shear_test(bool bias) {
  using S = SpecimenArguments;
  const Options sizes =
      bias ? Options{size("length", "mm", "free, between the clamps", at(&S::length), true),
                     size("width", "mm", "of the specimen", at(&S::width), true)}
           : Options{size("side", "mm", "from hinge to hinge; not needed for N/mm over an angle",
                          at(&S::side))};
  const std::string extension = bias ? "extension" : "extension of the diagonal";
  return {bias ? "bias" : "frame",
          bias ? "Bias extension" : "Picture frame",
          bias ? "shear law from bias-extension tests, equation (40) read backwards"
               : "shear law from picture-frame tests, equation (41) read backwards",
          "shear law",
          extension + " and load, a file a specimen" +
              (bias ? "" : "; or a normalised force in N/mm over the angle"),
          shear_columns_of,
          shear_words,
          find_shear,
          together({sizes,
                    shear_form(),
                    corrections("shear angle", "°", "mm"),
                    columns(extension, "load"),
                    {files("negative", "CSV files of specimens cut, or frames turned, the other "
                                       "way: the angle from the first family to the second opens")},
                    outputs()})};
}

IdentifyTest yarn_test(const std::string& name) {
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
          yarn_columns_of,
          yarn_words,
          pressed ? find_compression : find_tension,
          together({sizes, corrections("strain", "", "mm or strain"),
                    columns(pressed ? "shortening" : "strain", "force"), others, outputs()})};
}

IdentifyTest biaxial_test() {
  return {"biaxial",
          "Biaxial tension",
          "tension of straight yarns and crimp of both, from biaxial tension curves",
          "tension of straight yarns and crimp",
          "warp strain, weft strain, warp load, weft load, a file for each strain ratio; a "
          "direction that was free may miss",
          nullptr,
          words<"biaxial tension, cell of two crimped yarns">,
          find_biaxial,
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
  Options others;
  if (name == "uniaxial")
    others = {files("equibiaxial", "CSV files of specimens of the same rubber stretched both ways: "
                                   "one law of both")};
  return {name,
          (name == "uniaxial" ? "Uniaxial" : "Equibiaxial") + std::string(" tension of rubber"),
          "law of a sheet of rubber from " + name + " tension: neo-Hookean or Mooney-Rivlin",
          "law of a sheet of rubber",
          "strain, stretch or displacement, and load or nominal stress",
          rubber_columns_of,
          rubber_words,
          find_rubber,
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
          [](const A& a) { return cantilever_columns(reading_of(a)); },
          words<"cantilever test, heavy elastica">,
          find_cantilever,
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
          [](const A&) { return three_point_columns(); },
          three_point_words,
          find_three_point,
          together({{size("span", "mm", "distance of the supports", at(&S::span), true),
                     size("width", "mm", "of the strip", at(&S::width), true), direction()},
                    corrections("deflection over the span", "", "mm"),
                    columns("deflection", "force"),
                    outputs()})};
}

IdentifyTest relaxation() {
  using S = SpecimenArguments;
  TestOption times =
      within(numbers("times", "s", "relaxation times [looked for]", at(&A::times)), 1e-300, 1e300);
  return {"relaxation",
          "Relaxation of shear",
          "Maxwell branches of shear from the load after a frame or bias test has stopped",
          "Maxwell branches of shear",
          "time since the stop, and load; one test",
          [](const A&) { return relaxation_columns(); },
          relaxation_words,
          find_relaxation,
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
          [](const A&) { return zone_columns(); },
          words<"transition zone in the plane">,
          find_zone,
          together({{direction()}, columns("distance along a yarn", "shear angle"), outputs()})};
}

IdentifyTest pull_out() {
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
      [](const A&) { return tension_columns(false); },
      [](const A& a) { return fmt::format("pull-out tests of {:g} mm2", a.area); },
      nullptr,
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

IdentifyTest compaction() {
  return {"compaction",
          "Compaction",
          "pressure over thickness or fibre volume, from plies pressed between flat plates",
          "compaction, and thickness without pressure",
          "thickness or fibre volume fraction, and pressure, a file a specimen",
          [](const A&) { return compaction_columns(); },
          [](const A& a) {
            return fmt::format("compaction of {:g} {}", a.layers,
                               a.layers == 1.0 ? "ply" : "plies");
          },
          find_compaction,
          together({{size("layers", "", "plies between the plates [1]", at(&A::layers)),
                     choice("law",
                            "form of the law; gutowski is written as a table [toll_manson where it "
                            "follows the rows, else a table]",
                            {"toll_manson", "gutowski", "table"}, at(&A::law))},
                    columns("thickness or fibre volume", "pressure"),
                    {files("unloading", "CSV files of the plates going apart again")},
                    outputs()})};
}

} // namespace
} // namespace option_rows

const std::vector<IdentifyTest>& identify_tests() {
  using namespace option_rows;
  static const std::vector<IdentifyTest> all{shear_test(false),
                                             shear_test(true),
                                             yarn_test("warp"),
                                             yarn_test("weft"),
                                             biaxial_test(),
                                             rubber_test("uniaxial"),
                                             rubber_test("equibiaxial"),
                                             yarn_test("compression"),
                                             compaction(),
                                             cantilever(),
                                             three_point(),
                                             relaxation(),
                                             in_plane_bending(),
                                             pull_out()};
  return all;
}

const IdentifyTest& identify_test(const std::string& name) {
  const std::vector<IdentifyTest>& all = identify_tests();
  return *std::find_if(all.begin(), all.end(),
                       [&](const IdentifyTest& one) { return one.name == name; });
}

} // namespace plyform
