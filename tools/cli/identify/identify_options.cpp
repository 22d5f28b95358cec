// SPDX-License-Identifier: GPL-3.0-or-later
// The options of plyform identify and plyform theory.
#include "tools/cli/commands.hpp"

#include <CLI/CLI.hpp>

namespace plyform {
namespace {

void add_specimen(CLI::App& test, const std::string& name, SpecimenArguments& to) {
  if (name == "bias") {
    test.add_option("--length", to.length, "free length between the clamps, mm")->required();
    test.add_option("--width", to.width, "width, mm")->required();
  } else {
    test.add_option("--side", to.side,
                    "side from hinge to hinge, mm; not needed for N/mm over an angle");
  }
}

void add_outputs(CLI::App& test, IdentifyArguments& to) {
  test.add_option("--fabric", to.fabric, "fabric file with all but the law")->required();
  test.add_option("-o,--output", to.output, "fabric file to write")->required();
  test.add_option("--fit", to.fit, "CSV file of measured and fitted rows [OUTPUT's stem_fit.csv]");
  test.add_option("--report", to.report,
                  "JSON file of the law, its limits, warnings and mistakes, for programs; also "
                  "written where the curve is refused");
  test.add_flag("--yes-doubtful", to.doubtful,
                "go on though the curve shows a disturbance or the law is no fabric's");
}

void add_files(CLI::App& test, const std::string& x, const std::string& y, IdentifyArguments& to) {
  test.add_option("curves", to.curves,
                  "CSV file of " + x + " and " + y + ", or FILE:COLUMN of the " + y +
                      ", one for each specimen")
      ->required();
  test.add_option("--x-column", to.x.name, "name or number of the column of " + x);
  test.add_option("--y-column", to.y.name, "name or number of the column of " + y);
  test.add_option("--x-unit", to.x.unit, "its unit, if the header has none or a wrong one");
  test.add_option("--y-unit", to.y.unit, "its unit, if the header has none or a wrong one");
  add_outputs(test, to);
}

/// Range of rows, and what machines add to a curve.
void add_corrections(CLI::App& test, const std::string& range, IdentifyArguments& to) {
  test.add_option("--from", to.from, range + " from which rows count [0]");
  test.add_option("--to", to.to, range + " up to which rows count");
  test.add_option("--compliance", to.compliance,
                  "mm/N by which machine, load cell and clamps give way; 0: none");
  test.add_option("--zero", to.zero, "N that the load cell shows without load, or fit");
  test.add_option("--toe", to.toe,
                  "mm (or strain) at which the specimen is taut, or fit: toe compensation");
  test.add_option("--slip", to.slip, "fit: takes a sudden slip in the clamps off");
}

void add_direction(CLI::App& test, IdentifyArguments& to, bool both) {
  std::vector<std::string> words{"warp", "weft"};
  if (both) words.push_back("both");
  test.add_option("--direction", to.direction, "yarns that it is a test of")
      ->required()
      ->check(CLI::IsMember(words));
}

void add_shear_tests(CLI::App& command, IdentifyArguments& to) {
  for (const std::string name : {"bias", "frame"}) {
    const bool bias = name == "bias";
    CLI::App* test = command.add_subcommand(
        name, bias ? "shear law from bias-extension tests, equation (40) read backwards"
                   : "shear law from picture-frame tests, equation (41) read backwards");
    add_files(*test, bias ? "extension" : "extension of the diagonal", "load", to);
    add_corrections(*test, "shear angle (degrees)", to);
    test->add_option("--angle-column", to.angle.name,
                     "column of a measured shear angle, in the place of the crosshead's; "
                     "none: the crosshead's [measured where the file has one]");
    test->add_option("--angle-file", to.angle_file,
                     "CSV file of displacement and measured shear angle, or FILE:COLUMN of the "
                     "angle, of the same test");
    test->add_option("--angle-unit", to.angle.unit, "its unit: deg or rad");
    add_specimen(*test, name, to.specimen);
    test->add_flag("--laboratories", to.laboratories,
                   "each curve is of a laboratory, not of a specimen: mean, scatter and three "
                   "fabric files; or NAME=FILE for each curve, several of a name for one");
    test->add_flag("--skip-refused", to.skip_refused,
                   "of laboratories: go on without a curve that is refused");
    test->add_option("--law", to.law,
                     "polynomial, static (torque, then a polynomial) or table [chosen by "
                     "cross-validation]")
        ->check(CLI::IsMember({"polynomial", "static", "table"}));
    test->add_option("--coefficients", to.coefficients,
                     "of a polynomial: k1, k3, k5 ... [chosen, mostly 3]");
    test->add_option("--points", to.points, "of a table, but for [0, 0] [chosen]");
    test->add_option("--speeds", to.speeds,
                     "speed of the crosshead in each curve, mm/s: law with a viscous torque, from "
                     "all curves at once")
        ->delimiter(',');
    test->add_option(
            "--temperatures", to.temperatures,
            "temperature of each of them, degC: with several, viscosity over temperature; that "
            "of the first curve is the reference")
        ->delimiter(',');
    test->add_option("--temperature-law", to.temperature_law,
                     "form of viscosity over temperature; wlf takes three temperatures [arrhenius, "
                     "or wlf where it fits better]")
        ->check(CLI::IsMember({"arrhenius", "wlf", "table"}));
    test->add_option("--viscosity-coefficients", to.viscosity_coefficients,
                     "of the viscosity: c0, c2, c4 [chosen]")
        ->check(CLI::Range(1, 3));
    test->add_option("--negative", to.others,
                     "CSV files of specimens cut, or frames turned, the other way: the angle from "
                     "the first family to the second opens");
    test->add_option("--stitch", to.stitch,
                     "stitch of the fabric whose law is the difference between the two");
    test->callback([&to, name] { to.test = name; });
  }
}

void add_yarn_tests(CLI::App& command, IdentifyArguments& to) {
  for (const std::string name : {"warp", "weft", "compression"}) {
    const bool pressed = name == "compression";
    CLI::App* test = command.add_subcommand(
        name, pressed ? "compression of yarns, from a supported strip or yarn that is shortened"
                      : "tension law of the " + name + " yarns from yarn or strip tests");
    add_files(*test, pressed ? "shortening" : "strain", "force", to);
    add_corrections(*test, "strain", to);
    test->add_option("--yarns", to.yarns, "number of yarns that share the force [1]");
    test->add_option("--gauge-length", to.gauge_length,
                     "mm that turn a displacement into strain [1: it is a strain]");
    if (pressed) add_direction(*test, to, true);
    if (name == "warp") {
      test->add_option("--weft", to.others, "CSV files of weft specimens, to compare with");
      test->add_option("--weft-yarns", to.weft_yarns, "number of yarns in those [as --yarns]");
    }
    test->callback([&to, name] { to.test = name; });
  }
}

void add_biaxial_test(CLI::App& command, IdentifyArguments& to) {
  CLI::App* test = command.add_subcommand(
      "biaxial", "tension of straight yarns and crimp of both, from biaxial tension curves");
  test->add_option(
          "curves", to.curves,
          "CSV file of warp strain, weft strain, warp load, weft load, one for each strain "
          "ratio; a direction that was free may miss")
      ->required();
  test->add_option("--warp-yarns", to.warp_yarns, "number of warp yarns that share the load [1]");
  test->add_option("--weft-yarns", to.weft_yarns, "number of weft yarns that share the load [1]");
  test->add_option("--toe", to.toe, "fit: takes wrong zeros of strain off")
      ->check(CLI::IsMember({"fit"}));
  add_outputs(*test, to);
  test->callback([&to] { to.test = "biaxial"; });
}

void add_rubber_tests(CLI::App& command, IdentifyArguments& to) {
  for (const std::string name : {"uniaxial", "equibiaxial"}) {
    CLI::App* test = command.add_subcommand(name, "law of a sheet of rubber from " + name +
                                                      " tension: neo-Hookean or Mooney-Rivlin");
    add_files(*test, "strain or stretch", "load or nominal stress", to);
    add_corrections(*test, "strain", to);
    test->add_option("--width", to.specimen.width,
                     "width of the section, mm, for loads in N; its thickness is the fabric's");
    test->add_option("--gauge-length", to.gauge_length,
                     "mm that turn a displacement into strain [1: it is a strain or stretch]");
    if (name == "uniaxial")
      test->add_option("--equibiaxial", to.others,
                       "CSV files of equibiaxial tension of the same rubber: one law of both");
    test->add_option("--law", to.law, "neo_hookean or mooney_rivlin [chosen by the rows]")
        ->check(CLI::IsMember({"neo_hookean", "mooney_rivlin"}));
    test->callback([&to, name] { to.test = name; });
  }
}

void add_bending_tests(CLI::App& command, IdentifyArguments& to) {
  CLI::App* cantilever = command.add_subcommand(
      "cantilever", "bending stiffness from a strip that hangs over an edge (Peirce, ASTM D1388)");
  add_files(*cantilever, "overhang", "angle of the chord or deflection of the tip", to);
  cantilever->add_option("--reading", to.reading, "what is read beside the overhang [angle]")
      ->check(CLI::IsMember({"angle", "deflection"}));
  add_direction(*cantilever, to, true);
  cantilever->add_option("--weft", to.others,
                         "CSV files of weft specimens, to compare with; --direction warp then");
  cantilever->callback([&to] { to.test = "cantilever"; });

  CLI::App* three =
      command.add_subcommand("three-point", "bending stiffness from three-point bending");
  add_files(*three, "deflection", "force", to);
  add_corrections(*three, "deflection over the span", to);
  three->add_option("--span", to.specimen.span, "distance of the supports, mm")->required();
  three->add_option("--width", to.specimen.width, "width of the strip, mm")->required();
  add_direction(*three, to, true);
  three->callback([&to] { to.test = "three-point"; });

  CLI::App* zone = command.add_subcommand(
      "in-plane-bending", "in-plane bending stiffness from the width of transition zones");
  add_files(*zone, "distance along a yarn", "shear angle", to);
  add_direction(*zone, to, true);
  zone->callback([&to] { to.test = "in-plane-bending"; });
}

void add_relaxation_test(CLI::App& command, IdentifyArguments& to) {
  CLI::App* test = command.add_subcommand(
      "relaxation",
      "Maxwell branches of shear from the load after a frame or bias test has stopped");
  add_files(*test, "time since the stop", "load", to);
  test->add_option("--side", to.specimen.side, "of a frame: from hinge to hinge, mm");
  test->add_option("--length", to.specimen.length, "of a bias test: free length, mm");
  test->add_option("--width", to.specimen.width, "of a bias test, mm");
  test->add_option("--angle", to.stop_angle, "shear angle at the stop, degrees")->required();
  test->add_option("--ramp", to.ramp, "time that it took to get there, s [0: at once]")
      ->check(CLI::Range(0.0, 1e6));
  test->add_option("--times", to.times, "relaxation times, s [looked for]")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  test->callback([&to] { to.test = "relaxation"; });
}

void add_pull_out_test(CLI::App& command, IdentifyArguments& to) {
  CLI::App* test = command.add_subcommand(
      "pull-out", "friction over viscosity times speed over pressure, from pull-out tests");
  test->add_option("curves", to.curves, "CSV file of displacement and load, one for each test")
      ->required();
  test->add_option("--x-column", to.x.name, "name or number of the column of displacement");
  test->add_option("--y-column", to.y.name, "name or number of the column of load");
  test->add_option("--x-unit", to.x.unit, "its unit, if the header has none or a wrong one");
  test->add_option("--y-unit", to.y.unit, "its unit, if the header has none or a wrong one");
  test->add_option("--speeds", to.speeds, "speed of each test, mm/s")->delimiter(',')->required();
  test->add_option("--pressures", to.pressures, "pressure of each test, N/mm2")
      ->delimiter(',')
      ->required();
  test->add_option("--viscosity", to.viscosities,
                   "viscosity of the matrix, Pa s: one number, or one for each test")
      ->delimiter(',')
      ->required();
  test->add_option("--area", to.area, "area of one face that is pulled, mm2; both faces slide")
      ->required();
  test->add_option("--from", to.from, "displacement from which the pull is steady, mm [0]");
  test->add_option("--to", to.to, "displacement up to which it is, mm");
  test->add_option("--points", to.points, "of the curve [chosen]");
  test->add_option("--name", to.name, "of the law in a case: [friction.NAME] [pull_out]");
  test->add_option("-o,--output", to.output, "TOML file to write: [friction.NAME] of a case")
      ->required();
  test->add_option("--fit", to.fit, "CSV file of measured and fitted rows [OUTPUT's stem_fit.csv]");
  test->add_option("--report", to.report, "JSON file of the law, warnings and mistakes");
  test->callback([&to] { to.test = "pull-out"; });
}

} // namespace

void add_identify_tests(CLI::App& command, IdentifyArguments& to) {
  command.require_subcommand(1);
  add_shear_tests(command, to);
  add_yarn_tests(command, to);
  add_biaxial_test(command, to);
  add_rubber_tests(command, to);
  add_bending_tests(command, to);
  add_relaxation_test(command, to);
  add_pull_out_test(command, to);
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
