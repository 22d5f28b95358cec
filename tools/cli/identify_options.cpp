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
    test.add_option("--side", to.side, "side from hinge to hinge, mm")->required();
  }
}

void add_curve(CLI::App& test, const std::string& x, const std::string& y, const std::string& range,
               IdentifyArguments& to) {
  test.add_option("curve", to.curve, "CSV file of " + x + " and " + y)->required();
  test.add_option("--x-column", to.x_column, "name or number of the column of " + x + " [1]");
  test.add_option("--y-column", to.y_column, "name or number of the column of " + y + " [2]");
  test.add_option("--from", to.from, range + " from which rows count [0]");
  test.add_option("--to", to.to, range + " up to which rows count");
  test.add_option("--fabric", to.fabric, "fabric file with all but the law")->required();
  test.add_option("-o,--output", to.output, "fabric file to write")->required();
  test.add_option("--fit", to.fit, "CSV file of measured and fitted curve [OUTPUT's stem_fit.csv]");
}

} // namespace

void add_identify_tests(CLI::App& command, IdentifyArguments& to) {
  command.require_subcommand(1);
  for (const std::string name : {"bias", "frame"}) {
    const bool bias = name == "bias";
    CLI::App* test = command.add_subcommand(
        name, bias ? "shear law from a bias-extension test, equation (40) read backwards"
                   : "shear law from a picture-frame test, equation (41) read backwards");
    add_curve(*test, bias ? "extension (mm)" : "extension of the diagonal (mm)", "load (N)",
              "shear angle (degrees)", to);
    add_specimen(*test, name, to.specimen);
    test->add_option("--coefficients", to.coefficients, "of the torque: k1, k3, k5 ... [3]");
    test->callback([&to, name] { to.test = name; });
  }
  for (const std::string name : {"warp", "weft"}) {
    CLI::App* test = command.add_subcommand(name, "tension law of the " + name +
                                                      " yarns from a yarn or strip test");
    add_curve(*test, "strain", "force (N)", "strain", to);
    test->add_option("--yarns", to.yarns, "number of yarns that share the force [1]");
    test->add_option("--gauge-length", to.gauge_length,
                     "mm that turn a displacement in mm into strain [1: it is a strain]");
    test->callback([&to, name] { to.test = name; });
  }
}

void add_theory_tests(CLI::App& command, TheoryArguments& to) {
  command.require_subcommand(1);
  for (const std::string name : {"bias", "frame"}) {
    CLI::App* test = command.add_subcommand(
        name, name == "bias" ? "bias-extension test, equation (40)" : "picture frame, (41)");
    test->add_option("--fabric", to.fabric, "fabric file")->required();
    add_specimen(*test, name, to.specimen);
    test->add_option("--to", to.to, "last shear angle, degrees")->required();
    test->add_option("--points", to.points, "rows after the first, at 0 [100]");
    test->add_option("-o,--output", to.output, "CSV file to write")->required();
    test->callback([&to, name] { to.test = name; });
  }
}

} // namespace plyform
