// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of shear, tension and compression in words, as TOML and as CSV.
#include "base/format.hpp"
#include "tools/identify/identify_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

namespace fs = std::filesystem;

std::string name_of(const std::string& file) {
  return fs::path(file).filename().string();
}

/// "k1 = 0.37, k3 = 0.84": numbers with the names of the coefficients.
std::string coefficients(const std::vector<double>& k, const char* sign, int digits) {
  std::string text;
  for (std::size_t i = 0; i < k.size(); ++i)
    text += fmt::format("{}k{} {} {:.{}g}", i ? ", " : "", 2 * i + 1, sign, k[i], digits);
  return text;
}

std::string limits_from(std::size_t specimens) {
  return specimens > 1 ? fmt::format("from the spread of {} specimens", specimens)
                       : "from the residuals of one specimen";
}

/// Lines on each specimen and the scatter between them.
void put_specimens(const std::vector<SpecimenLaw>& specimens, const Scatter& scatter,
                   const std::string& law, const std::string& unit, const std::string& at,
                   bool with_coefficients, Identified& result) {
  for (const SpecimenLaw& specimen : specimens) {
    const std::string taken = corrections_text(specimen.corrected, unit);
    if (!taken.empty())
      result.figures.push_back(fmt::format("taken off {}: {}", name_of(specimen.file), taken));
  }
  if (specimens.size() < 2) return;
  for (const SpecimenLaw& specimen : specimens) {
    std::string own;
    if (with_coefficients)
      own = law == "torque" ? coefficients(specimen.coefficients, "=", 5) + " N mm, "
                            : fmt::format("{:.5g} N per yarn, ", specimen.coefficients[0]);
    result.notes.push_back(fmt::format("{}: {}residuals {:.2g} % rms", name_of(specimen.file), own,
                                       100.0 * specimen.quality.rms));
  }
  if (with_coefficients) {
    std::vector<double> means, deviations;
    for (const Spread& spread : scatter.coefficient) {
      means.push_back(spread.mean);
      deviations.push_back(spread.deviation);
    }
    result.notes.push_back(
        law == "torque" ? fmt::format("mean {}; standard deviations {}",
                                      coefficients(means, "=", 5), coefficients(deviations, "=", 2))
                        : fmt::format("mean {:.5g}, standard deviation {:.3g} N per yarn", means[0],
                                      deviations[0]));
  }
  result.figures.push_back(fmt::format("{} specimens, standard deviation of the {} between them "
                                       "{:.2g} % at most, at {}",
                                       specimens.size(), law, 100.0 * scatter.law, at));
}

} // namespace

std::string corrections_text(const Corrected& c, const std::string& unit) {
  const auto limits = [](double value) {
    return value > 0.0 ? fmt::format(" (+- {:.2g})", value) : std::string();
  };
  std::vector<std::string> parts;
  if (c.load_zero != 0.0)
    parts.push_back(fmt::format("load zero {:.4g} N{}", c.load_zero, limits(c.load_zero_limits)));
  if (c.toe != 0.0)
    parts.push_back(fmt::format("displacement zero {:.4g}{}{}", c.toe, unit, limits(c.toe_limits)));
  if (c.compliance != 0.0) parts.push_back(fmt::format("compliance {:.4g} mm/N", c.compliance));
  if (c.slip != 0.0)
    parts.push_back(fmt::format("slip {:.4g}{}{} before line {}", c.slip, unit,
                                limits(c.slip_limits), c.slip_line));
  std::string text;
  for (const std::string& part : parts)
    text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string sensitivity_text(const std::vector<SpecimenLaw>& specimens, const std::string& length,
                             bool displacement, bool stretch) {
  Sensitivity most;
  for (const SpecimenLaw& specimen : specimens) {
    most.load_zero = std::max(most.load_zero, specimen.sensitive.load_zero);
    most.toe = std::max(most.toe, specimen.sensitive.toe);
    most.slip = std::max(most.slip, specimen.sensitive.slip);
    most.compliance = std::max(most.compliance, specimen.sensitive.compliance);
  }
  const auto percent = [](double share) {
    return share > 9.99 ? std::string("more than 1000 %") : fmt::format("{:.2g} %", 100.0 * share);
  };
  std::string text = fmt::format("how far the law would move: {} by 1 % of load zero, {} by {} of "
                                 "displacement zero",
                                 percent(most.load_zero), percent(most.toe), length);
  if (stretch) text += fmt::format(", {} by {} of slip", percent(most.slip), length);
  if (displacement)
    text +=
        fmt::format(", {} by {:g} mm/N of compliance", percent(most.compliance), common_compliance);
  return text;
}

std::string confidence_text(const std::string& of_coefficients, const std::string& law,
                            const Confidence& confidence, const std::string& at,
                            std::size_t specimens) {
  return fmt::format("95 % limits {}of the {} +- {:.2g} % at most, at {}; {}", of_coefficients, law,
                     100.0 * confidence.law, at, limits_from(specimens));
}

std::string figure_of_residuals(const FitQuality& quality, const std::string& at) {
  return fmt::format("residuals {:.2g} % of the load rms, {:.2g} % at most, at {}",
                     100.0 * quality.rms, 100.0 * quality.largest, at);
}

void put_quality(const FitQuality& quality, Identified& result) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  result.numbers.push_back({"rows", "", static_cast<double>(quality.rows), unknown});
  result.numbers.push_back({"residuals rms", "%", 100.0 * quality.rms, unknown});
  result.numbers.push_back({"residuals at most", "%", 100.0 * quality.largest, unknown});
}

namespace {

/// The law as TOML and in words.
void put_shear_law(const ShearFit& fit, Identified& result) {
  const bool polynomial = !fit.law.tabulated();
  std::string numbers = "[";
  for (std::size_t i = 0; i < fit.law.k.size(); ++i)
    numbers += fmt::format("{}{:.7g}", i ? ", " : "", fit.law.k[i]);
  for (std::size_t i = 0; i < fit.law.angle.size(); ++i)
    numbers += fmt::format("\n    [{:.6g}, {:.6g}],", fit.law.angle[i] / degree, fit.law.torque[i]);
  result.laws = {
      {"shear", polynomial ? "polynomial" : "table", numbers + (polynomial ? "]" : "\n]"), {}}};
  const std::string powers = coefficients(fit.polynomial, "=", 5);
  if (polynomial)
    result.law_line = powers + " N mm: torque of one unit cell = k1 g + k3 g^3 + ..., g in rad";
  else if (fit.form.kind == ShearFormKind::with_static)
    result.law_line =
        fmt::format("static torque {:.4g} N mm, reached within {:g} degree{}, and {} N "
                    "mm: torque of one unit cell = C0 + k1 g + k3 g^3 + ..., g in rad",
                    fit.static_torque, fit.static_angle / degree,
                    std::abs(fit.static_angle / degree - 1.0) < 1e-9 ? "" : "s", powers);
  else {
    result.law_line = "torque of one unit cell, degrees: N mm:";
    for (std::size_t i = 1; i < fit.law.angle.size(); ++i)
      result.law_line +=
          fmt::format(" {:.3g}: {:.4g},", fit.law.angle[i] / degree, fit.law.torque[i]);
    result.law_line.pop_back();
  }
}

/// "k1 +- 0.04, k3 +- 0.043, C0 +- 0.1, ": limits of the numbers of a law.
std::string number_limits(const ShearFit& fit) {
  const std::vector<double>& limits = fit.confidence.coefficient;
  if (fit.form.kind == ShearFormKind::table) {
    std::string text = "of the points";
    for (const double limit : limits)
      text += std::isfinite(limit) ? fmt::format(" +- {:.2g},", limit) : " not known,";
    return text + " ";
  }
  const std::size_t n = fit.polynomial.size();
  std::string text = coefficients({limits.begin(), limits.begin() + static_cast<long>(n)}, "+-", 2);
  if (limits.size() > n) text += fmt::format(", C0 +- {:.2g}", limits[n]);
  return text + ", ";
}

} // namespace

/// k1, k3 ... and C0, or the torques of a table's points.
void put_shear_numbers(const ShearFit& fit, Identified& result) {
  const std::vector<double>& limits = fit.confidence.coefficient;
  const auto limit = [&](std::size_t i) {
    return i < limits.size() ? limits[i] : std::numeric_limits<double>::quiet_NaN();
  };
  if (fit.form.kind == ShearFormKind::table) {
    for (std::size_t i = 1; i < fit.law.angle.size(); ++i)
      result.numbers.push_back({fmt::format("torque at {:.3g} degrees", fit.law.angle[i] / degree),
                                "N mm", fit.law.torque[i], limit(i - 1)});
  } else {
    const std::size_t n = fit.polynomial.size();
    for (std::size_t i = 0; i < n; ++i)
      result.numbers.push_back(
          {fmt::format("k{}", 2 * i + 1), "N mm", fit.polynomial[i], limit(i)});
    if (fit.form.kind == ShearFormKind::with_static)
      result.numbers.push_back({"static torque", "N mm", fit.static_torque, limit(n)});
  }
  put_quality(fit.quality, result);
  result.numbers.push_back({"misfit of the torque", "%", 100.0 * fit.quality.misfit,
                            std::numeric_limits<double>::quiet_NaN()});
}

Identified shear_text(const ShearFit& fit) {
  Identified result;
  result.title = "shear law";
  result.provides = {"shear"};
  put_shear_law(fit, result);
  put_shear_numbers(fit, result);
  const FitQuality& q = fit.quality;
  const auto degrees = [](double angle) { return fmt::format("{:.3g} degrees", angle / degree); };
  result.figures = {fmt::format("{} rows, shear angle {:.3g} to {:.3g} degrees", q.rows,
                                q.from / degree, q.to / degree),
                    figure_of_residuals(q, degrees(q.largest_at)),
                    fmt::format("misfit of the torque over the range {:.2g} % rms, single rows "
                                "scatter by {:.2g} %",
                                100.0 * q.misfit, 100.0 * q.noise),
                    fmt::format("{}: {}", fit.form.name(), fit.why),
                    confidence_text(number_limits(fit), "torque", fit.confidence,
                                    degrees(fit.confidence.law_at), fit.specimens.size())};
  put_specimens(fit.specimens, fit.scatter, "torque", " mm", degrees(fit.scatter.law_at),
                !fit.law.tabulated(), result);
  if (fit.in_plane.most > 0.0)
    result.figures.push_back(fmt::format(
        "in-plane bending adds {:.2g} to {:.2g} % to the load of shear: {:.2g} % taken off",
        100.0 * fit.in_plane.least, 100.0 * fit.in_plane.most, 100.0 * fit.in_plane.mean()));
  result.notes.push_back(sensitivity_text(fit.specimens, "1 mm", true, true));
  const bool several = fit.specimens.size() > 1;
  result.fit = std::string("displacement_mm,shear_deg,measured_N,fitted_N") +
               (several ? ",specimen\n" : "\n");
  for (std::size_t i = 0; i < fit.angle.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}{}\n", fit.extension[i],
                              fit.angle[i] / degree, fit.measured[i], fit.fitted[i],
                              several ? fmt::format(",{}", fit.specimen[i] + 1) : "");
  return result;
}

Identified tension_text(const TensionFit& fit, const IdentifyArguments& arguments) {
  Identified result;
  const std::string& yarns = arguments.test;
  const bool displacement = arguments.gauge_length != 1.0;
  result.title = yarns + " tension law";
  result.provides = {yarns};
  const bool line = fit.law.linear();
  std::string limits;
  if (line) {
    result.laws = {{yarns, "stiffness", fmt::format("{:.7g}", fit.law.stiffness), {}}};
    result.law_line = fmt::format("stiffness = {:.5g} N per yarn", fit.law.stiffness);
    limits = fmt::format("+- {:.3g} N per yarn, ", fit.confidence.coefficient[0]);
    result.numbers = {
        {"stiffness", "N per yarn", fit.law.stiffness, fit.confidence.coefficient[0]}};
  } else {
    std::string rows = "[";
    for (std::size_t i = 0; i < fit.law.strain.size(); ++i)
      rows += fmt::format("\n    [{:.9g}, {:.7g}],", fit.law.strain[i], fit.law.tension[i]);
    result.laws = {{yarns, "table", rows + "\n]", {}}};
    result.law_line =
        fmt::format("table of {} rows, up to {:.4g} N per yarn at a strain of {:.4g}; no line fits",
                    fit.law.strain.size(), fit.law.tension.back(), fit.law.strain.back());
  }
  const FitQuality& q = fit.quality;
  put_quality(q, result);
  const auto strain = [](double value) { return fmt::format("a strain of {:.3g}", value); };
  result.figures = {fmt::format("{} rows, strain {:.3g} to {:.3g}", q.rows, q.from, q.to),
                    figure_of_residuals(q, strain(q.largest_at)),
                    confidence_text(limits, "tension", fit.confidence,
                                    strain(fit.confidence.law_at), fit.specimens.size())};
  put_specimens(fit.specimens, fit.scatter, "tension", displacement ? " mm" : "",
                strain(fit.scatter.law_at), line, result);
  result.notes.push_back(sensitivity_text(
      fit.specimens, displacement ? "0.1 mm" : "a strain of 0.001", displacement, false));
  const bool several = fit.specimens.size() > 1;
  result.fit = std::string("strain,measured_N,fitted_N") + (several ? ",specimen\n" : "\n");
  for (std::size_t i = 0; i < fit.strain.size(); ++i)
    result.fit +=
        fmt::format("{:.9g},{:.9g},{:.9g}{}\n", fit.strain[i], fit.measured[i], fit.fitted[i],
                    several ? fmt::format(",{}", fit.specimen[i] + 1) : "");
  return result;
}

Identified compression_text(const CompressionFit& fit, const IdentifyArguments& arguments) {
  Identified result;
  result.title = "compression law";
  for (const std::string& yarns : families_of(arguments.direction)) {
    result.laws.push_back(
        {yarns, "compression_stiffness", fmt::format("{:.7g}", fit.stiffness), {}});
    result.laws.push_back(
        {yarns,
         "buckling_force",
         fit.buckling_force ? fmt::format("{:.7g}", *fit.buckling_force) : std::string(),
         {}});
  }
  result.law_line = fmt::format("compression_stiffness = {:.5g} N per yarn", fit.stiffness);
  result.numbers = {{"compression_stiffness", "N per yarn", fit.stiffness, fit.stiffness_limits}};
  if (fit.buckling_force) {
    result.law_line += fmt::format(", buckling_force = {:.4g} N per yarn", *fit.buckling_force);
    result.numbers.push_back({"buckling_force", "N per yarn", *fit.buckling_force,
                              std::numeric_limits<double>::quiet_NaN()});
  }
  const FitQuality& q = fit.quality;
  put_quality(q, result);
  result.figures = {
      fmt::format("{} rows, shortening {:.3g} to {:.3g}", q.rows, q.from, q.to),
      figure_of_residuals(q, fmt::format("a shortening of {:.3g}", q.largest_at)),
      fmt::format("95 % limits +- {:.3g} N per yarn; {}", fit.stiffness_limits, limits_from(1))};
  result.fit = "strain,measured_N,fitted_N\n";
  for (std::size_t i = 0; i < fit.strain.size(); ++i)
    result.fit +=
        fmt::format("{:.9g},{:.9g},{:.9g}\n", fit.strain[i], fit.measured[i], fit.fitted[i]);
  return result;
}

} // namespace plyform
