// SPDX-License-Identifier: GPL-3.0-or-later
// What an identification is asked for, on the command line or in Python.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// A shear test: bias or frame; NaN where not given.
struct SpecimenArguments {
  double length = std::numeric_limits<double>::quiet_NaN(); ///< mm, bias
  double width = std::numeric_limits<double>::quiet_NaN();  ///< mm, bias, three-point
  double side = std::numeric_limits<double>::quiet_NaN();   ///< mm, frame
  double span = std::numeric_limits<double>::quiet_NaN();   ///< mm, three-point
};

/// A column of a curve: name or number, and the unit in the place of the header's.
struct ColumnArguments {
  std::string name, unit;
};

struct IdentifyArguments {
  std::string test; ///< bias, frame, warp, weft, biaxial, compression, cantilever, three-point ...
  std::vector<std::string> curves; ///< one for each specimen
  std::vector<std::string> others; ///< of specimens of the other sign, or along the weft
  std::string stitch;              ///< that the two signs of shear differ by
  ColumnArguments x, y, angle;
  std::string angle_file; ///< FILE or FILE:COLUMN: angles over displacements
  std::string fabric, output, fit;
  std::string report; ///< JSON file, or empty
  SpecimenArguments specimen;
  std::optional<int> coefficients, points; ///< of a polynomial, of a table of shear
  /// The form, as the test's choices have it; empty: chosen.
  std::string law;
  double from = 0.0, to = std::numeric_limits<double>::infinity(); ///< degrees, strain, or share
  double yarns = 1.0, gauge_length = 1.0;                          ///< -, mm
  double layers = 1.0;                                             ///< of a compaction test
  std::string compliance, zero, toe,
      slip;                      ///< numbers (mm/N, N, mm or strain), or fit; empty: not given
  std::string direction;         ///< warp, weft or both
  std::string reading = "angle"; ///< of a cantilever: angle or deflection
  bool doubtful = false;
  bool laboratories = false; ///< each curve is of one, not of a specimen; or NAME=FILE says so
  bool skip_refused = false; ///< laboratories: goes on without curves that are refused
  double warp_yarns = 1.0;   ///< of a biaxial test
  std::optional<double> weft_yarns; ///< of it, or of the others; not given: as the warp
  // Of what depends on rates, one number a curve:
  std::vector<double> speeds, pressures; ///< mm/s, N/mm^2
  std::vector<double> temperatures;      ///< degC
  std::string temperature_law;           ///< arrhenius, wlf, table; empty: by the rows
  std::vector<double> viscosities;       ///< Pa s; one a curve, or one
  std::optional<int> viscosity_coefficients;
  double area = 0.0;                   ///< mm^2, of a pull-out test
  std::string name = "pull_out";       ///< of the law of friction in a case
  double stop_angle = 0.0, ramp = 0.0; ///< degrees, s; of relaxation
  std::vector<double> times;           ///< s, of its branches; empty: looked for
};

struct TheoryArguments {
  std::string test; ///< bias or frame
  std::string fabric, output;
  SpecimenArguments specimen;
  double to = 0.0; ///< degrees
  int points = 100;
  bool negative = false; ///< shear angles below 0
};

} // namespace plyform
