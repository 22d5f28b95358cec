// SPDX-License-Identifier: GPL-3.0-or-later
// Identifies shear of a matrix that flows (core/model/viscous_shear.hpp) from tests of one shape at
// several speeds, and temperatures if wanted, all rows at once.
//
//   C = k1 g + k3 g^3 ... + f(T) (c0 + c2 g^2 ...) dg/dt                                       (R)
//   dg/dt = v dg/dd of the crosshead's speed v, by (b) of shear_tests.hpp; half of it in the zones
//   that shear by g/2
//   f(T) of flow_law.hpp, T_0 the first temperature
//
// The load is linear in all k and c: least squares by the weights of linear_law.hpp, the floor of
// each specimen by its own largest load, as slow tests have small ones. The numbers of f are those
// that make them least. With f by a number of its own at each temperature the viscosity of each is
// found by itself, and shows how well a form follows it. Elastic and viscous part are told apart by
// speeds that differ by a factor of two at least.
#pragma once

#include "core/identify/fit_shear.hpp"
#include "core/identify/flow_law.hpp"

#include <array>
#include <optional>
#include <vector>

namespace plyform {

/// A curve, how fast its crosshead went, and how hot it was.
struct RatedCurve {
  Curve curve;
  double speed = 0.0;                ///< mm/s, above 0
  std::optional<double> temperature; ///< degC; of all curves or of none
};

/// How well the law follows one curve, by which a torque that does not rise in proportion to the
/// rate shows.
struct RatedQuality {
  std::string file;
  double speed = 0.0, mean_rate = 0.0; ///< mm/s, 1/s
  std::optional<double> temperature;
  FitQuality quality;
  double viscous_ratio = 0.0; ///< measured less elastic load over fitted viscous load, mean
};

struct FlowPoint {
  double celsius, factor;
};

/// A form of f(T), and the rms of the residuals with it.
struct FlowTry {
  FlowForm form;
  double rms;
};

struct RatedOptions {
  int viscous = 0;                ///< coefficients of (R), 1 to 3; 0: by the rows
  FlowForm form = FlowForm::none; ///< none: Arrhenius, or WLF where it fits better
};

struct RatesFit {
  std::vector<double> elastic;                        ///< k1, k3 ..., N mm
  std::vector<double> viscous;                        ///< c0, c2 ..., N mm s, at T_0
  std::vector<double> elastic_limits, viscous_limits; ///< 95 %, half widths
  std::optional<double> reference;                    ///< T_0, degC
  FlowForm form = FlowForm::none;                     ///< of f(T); of several temperatures
  std::vector<double> flow, flow_limits;              ///< FlowLaw::numbers
  std::vector<FlowPoint> factors;                     ///< of f(T), at the tests' temperatures
  std::vector<FlowTry> tried;
  std::string flow_why;                 ///< the form, a clause
  std::array<double, 2> rates{};        ///< 1/s, least and largest of the rows
  std::array<double, 2> temperatures{}; ///< degC, likewise
  double viscous_share = 0.0;           ///< of the load, mean over the rows of the fastest test
  FitQuality quality;
  std::vector<RatedQuality> specimens;
  std::vector<Corrected> corrected;
  std::vector<double> extension, angle, rate, measured, fitted; ///< mm, rad, 1/s, N of each row
  std::vector<std::size_t> specimen;                            ///< from 0
  std::string why; ///< the numbers of coefficients, a clause
};

/// options.coefficients: of the elastic polynomial, else 3 and fewer if the torque of 3 falls;
/// of viscous ones by the rows one more, and of f(T) the second of WLF, only where chance would
/// gain as much once in a thousand. Reports errors and returns nothing where a curve is refused as
/// identify_shear does, speeds differ by less than a factor of two, the viscosity comes out
/// negative, or the law cannot be fitted to within 20 %.
std::optional<RatesFit> identify_rates(const std::vector<RatedCurve>& curves, const ShearTest& test,
                                       const Fabric& fabric, const FitOptions& options,
                                       const RatedOptions& rated, Diagnostics& diagnostics);

} // namespace plyform
