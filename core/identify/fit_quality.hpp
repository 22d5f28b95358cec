// SPDX-License-Identifier: GPL-3.0-or-later
// What all identifications share: options, how well a law follows its rows, how sure it is, how far
// specimens scatter, and whether it is the law of a fabric at all.
#pragma once

#include "core/identify/disturbances.hpp"
#include "core/identify/statistics.hpp"
#include "core/model/usual_ranges.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plyform {

/// Residuals, rms over load (of shear the misfit of the torque): above the first a warning, above
/// the second an error.
inline constexpr double noisy = 0.02, useless = 0.2;

/// Forms that a law of shear may have: shear_forms.hpp.
enum class ShearFormKind { polynomial, with_static, table };

struct FitOptions {
  int coefficients = 0; ///< of the shear law's polynomial, 1 to 6; 0: chosen by the rows
  double from = 0.0;    ///< shear angle (rad) or strain of the first row that counts ...
  double to = std::numeric_limits<double>::infinity(); ///< ... and of the last
  Corrections corrections = {};
  bool measured_angle = false; ///< the curve's angles count, not its extensions
  /// A disturbance that moves the law by more than `useless`, and a law outside the usual range,
  /// are warned of, not refused.
  bool doubtful = false;
  std::optional<ShearFormKind> law = {}; ///< of shear; nothing: chosen by the rows
  bool flows = false; ///< the matrix resists by rates, or stitches pull: loads do not begin at 0
  int points = 0;     ///< of a table of shear, 1 to 20; 0: chosen
  /// The fraction of a choice of the law that is done, which takes seconds; 1 at its end.
  std::function<void(double fraction)> progress = {};
};

/// How well a law follows the rows it was fitted to. Residuals are over max(fitted load,
/// load_floor x the largest).
struct FitQuality {
  std::size_t rows = 0;
  double from = 0.0, to = 0.0; ///< shear angle (rad) or strain covered
  double rms = 0.0, largest = 0.0;
  double largest_at = 0.0; ///< rad or strain
  double misfit = 0.0;     ///< of shear: of the torque, torque_misfit of shear_checks.hpp
  double noise = 0.0;      ///< of shear: what single rows scatter by, on the scale of misfit
};

/// Half widths of 95 % limits. Of one specimen from its residuals: they hold what scatters from row
/// to row, not what a machine adds nor what differs from specimen to specimen. Of several from the
/// spread between them, with Student's t: they hold both, but not what all have in common.
struct Confidence {
  std::vector<double> coefficient;
  double law = 0.0, law_at = 0.0; ///< largest, over the law; where: rad or strain
};

/// One of the specimens that a law was found from.
struct SpecimenLaw {
  std::string file;
  std::vector<double> coefficients; ///< its own
  FitQuality quality;
  Corrected corrected;
  Sensitivity sensitive;
};

/// Between specimens.
struct Scatter {
  std::vector<Spread> coefficient;
  double law = 0.0, law_at = 0.0; ///< largest standard deviation of the law over its mean; where
};

Place place_of(const Curve& curve, std::size_t row = 0);

/// Residuals of the rows at shear angles or strains `at`.
FitQuality quality_of(const std::vector<double>& at, const std::vector<double>& measured,
                      const std::vector<double>& fitted);

/// Reports an error and returns false if residuals exceed `useless`, a warning if they exceed
/// `noisy`; `where` describes the position of the largest one.
bool check_quality(const Curve& curve, const FitQuality& quality, const std::string& where,
                   const std::string& remedy, Diagnostics& diagnostics);

/// Limits from the residuals of one specimen, at the places of the probes.
Confidence confidence_of(const LinearFit& fit, const Eigen::MatrixXd& probes,
                         const std::vector<double>& places);

/// Between specimens (two or more) with coefficients k, and the limits that follow.
Scatter scatter_of(const std::vector<Eigen::VectorXd>& k, const Eigen::MatrixXd& probes,
                   const std::vector<double>& places);
Confidence confidence_between(const std::vector<Eigen::VectorXd>& k, const Eigen::MatrixXd& probes,
                              const std::vector<double>& places);

/// How messages speak of a curve.
struct CurveWords {
  std::string length_unit;  ///< of x: "mm", or "" for a strain
  double length = 1.0;      ///< of x: the step that sensitivities speak of
  double x_scale = 1.0;     ///< from x to what was measured, in that unit ...
  double y_scale = 1.0;     ///< ... and from y to N
  bool x_is_length = true;  ///< measured at the crosshead: the machine's compliance is in it
  bool can_stretch = true;  ///< slip that goes on may be in x
  bool zeros_show = true;   ///< law and rows can show a wrong zero of the load ...
  bool toe_shows = true;    ///< ... of the displacement
  bool stiff_start = false; ///< a displacement zero that is late looks like one of the load
  std::string angle_remedy; ///< for slip, after what the options can do; may be empty
};

/// What may be in a curve and has not been given.
std::vector<DisturbanceKind> kinds_looked_for(const FitOptions& options, const CurveWords& words);

/// Looks for what the machine has added to rows, of a curve, and reports it: a warning, or an error
/// if the law is worthless with it (false is returned then).
bool check_disturbances(const Curve& curve, const LinearLaw& law, const LoadRows& rows,
                        const FitOptions& options, const CurveWords& words,
                        Diagnostics& diagnostics);

/// Warns of what was not given, would count and cannot be told from the rows: the compliance, and
/// the displacement zero where the rows show it too roughly.
void warn_of_unknowns(const Curve& curve, const LinearLaw& law, const LoadRows& rows,
                      const Sensitivity& sensitive, const FitOptions& options,
                      const CurveWords& words, Diagnostics& diagnostics);
/// mm/N: of a small test machine with its load cell and clamps; what messages take if none is
/// given.
inline constexpr double common_compliance = 0.01;

/// Reports a value outside the range in which those of fabrics lie: an error (false is returned),
/// or a warning with options.doubtful.
bool check_usual(const Place& at, const std::string& what, double value, const UsualRange& usual,
                 const std::string& unit, bool doubtful, Diagnostics& diagnostics);

} // namespace plyform
