// SPDX-License-Identifier: GPL-3.0-or-later
// Shear at several speeds, and relaxation, in words, as TOML and as CSV.
#include "tools/identify/identify_rates.hpp"

#include "base/format.hpp"
#include "core/identify/fit_rates.hpp"
#include "core/identify/fit_relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

std::string file_name(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

std::string toml_list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{:.6g}", text.empty() ? "[" : ", ", value);
  return text + "]";
}

/// "k1 = 2, k3 = 1.5": numbers named by the powers of g that they stand at.
std::string named(const std::string& letter, int first, const std::vector<double>& values,
                  const char* sign, int digits) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}{}{} {} {:.{}g}", i ? ", " : "", letter, first + 2 * static_cast<int>(i),
                        sign, values[i], digits);
  return text;
}

std::string form_name(FlowForm form) {
  switch (form) {
  case FlowForm::none:
    break;
  case FlowForm::arrhenius:
    return "Arrhenius";
  case FlowForm::wlf:
    return "WLF";
  case FlowForm::table:
    return "each temperature by itself";
  }
  return "";
}

/// Key, name, unit of the file and what one of it is in the program, of each number of a form.
struct FlowNumber {
  std::string key, name, unit;
  double size;
};
std::vector<FlowNumber> numbers_of(FlowForm form) {
  if (form == FlowForm::arrhenius)
    return {{"activation_energy", "activation energy", "kJ/mol", 1e3}};
  if (form == FlowForm::wlf) return {{"c1", "C1", "-", 1.0}, {"c2", "C2", "K", 1.0}};
  return {};
}

/// f(T) as the fabric's table of temperature.
void put_flow_laws(const RatesFit& fit, Identified& result) {
  if (fit.form == FlowForm::none) return;
  result.laws.push_back({"temperature", "reference", fmt::format("{:g}", *fit.reference), {}});
  result.laws.back().without = {"temperature.viscosity"};
  const std::string table = "temperature.viscosity";
  const std::vector<FlowNumber> names = numbers_of(fit.form);
  for (std::size_t i = 0; i < names.size(); ++i)
    result.laws.push_back(
        {table, names[i].key, fmt::format("{:.5g}", fit.flow[i] / names[i].size), {}});
  if (fit.form != FlowForm::table) return;
  std::string rows;
  for (const FlowPoint& point : fit.factors)
    rows += fmt::format("\n    [{:g}, {:.6g}],", point.celsius, point.factor);
  result.laws.push_back({table, "table", "[" + rows + "\n]", {}});
}

void put_flow_numbers(const RatesFit& fit, Identified& result) {
  const std::vector<FlowNumber> names = numbers_of(fit.form);
  for (std::size_t i = 0; i < names.size(); ++i)
    result.numbers.push_back({names[i].name, names[i].unit, fit.flow[i] / names[i].size,
                              fit.flow_limits[i] / names[i].size});
  if (fit.form != FlowForm::table) return;
  std::size_t i = 0;
  for (const FlowPoint& point : fit.factors)
    if (point.celsius != *fit.reference) {
      result.numbers.push_back(
          {fmt::format("viscosity at {:g} degC over that at {:g}", point.celsius, *fit.reference),
           "-", fit.flow[i], fit.flow_limits[i]});
      ++i;
    }
}

/// What is told of f(T): its numbers, and how well each form follows the curves.
void tell_flow(const RatesFit& fit, Identified& result) {
  if (fit.form == FlowForm::none) {
    if (fit.reference) result.figures.push_back(fmt::format("at {:g} degC", *fit.reference));
    return;
  }
  const std::vector<FlowNumber> names = numbers_of(fit.form);
  std::string numbers;
  for (std::size_t i = 0; i < names.size(); ++i)
    numbers += fmt::format("{}{} {:.4g} +- {:.2g}{}", i ? ", " : "", names[i].name,
                           fit.flow[i] / names[i].size, fit.flow_limits[i] / names[i].size,
                           names[i].unit == "-" ? "" : " " + names[i].unit);
  if (names.empty())
    for (const FlowPoint& point : fit.factors)
      numbers +=
          fmt::format("{}{:.4g} at {:g}", numbers.empty() ? "" : ", ", point.factor, point.celsius);
  result.figures.push_back(fmt::format(
      "viscosity over {:g} to {:g} degC: {}, {}; {}", fit.temperatures[0], fit.temperatures[1],
      names.empty() ? "table" : form_name(fit.form), numbers, fit.flow_why));
  std::string tried;
  for (const FlowTry& one : fit.tried)
    tried += fmt::format("{}{} {:.3g} %", tried.empty() ? "" : ", ", form_name(one.form),
                         100.0 * one.rms);
  result.figures.push_back(fmt::format("residuals rms by the form of viscosity over temperature, "
                                       "of the rows' weights: {}",
                                       tried));
}

/// A form that follows the curves much worse than each temperature by itself does.
void doubt_flow(const RatesFit& fit, Identified& result) {
  constexpr double worse = 1.5;
  double each = 0.0, taken = 0.0;
  for (const FlowTry& one : fit.tried) {
    if (one.form == FlowForm::table) each = one.rms;
    if (one.form == fit.form) taken = one.rms;
  }
  if (!(taken > worse * each) || taken < 0.005) return;
  result.notes.push_back(fmt::format(
      "{} follows the curves {:.2g} times worse than a viscosity of its own at each temperature: "
      "take --temperature-law table, or fewer temperatures, as where a matrix solidifies no law "
      "of flow holds",
      form_name(fit.form), taken / each));
}

void put_rated_laws(const RatesFit& fit, Identified& result) {
  result.laws = {{"shear", "polynomial", toml_list(fit.elastic), {}},
                 {"shear", "viscosity", toml_list(fit.viscous), {}},
                 {"shear", "measured_rates", toml_list({fit.rates[0], fit.rates[1]}), {}}};
  put_flow_laws(fit, result);
}

void put_rated_numbers(const RatesFit& fit, Identified& result) {
  for (std::size_t i = 0; i < fit.elastic.size(); ++i)
    result.numbers.push_back(
        {fmt::format("k{}", 2 * i + 1), "N mm", fit.elastic[i], fit.elastic_limits[i]});
  for (std::size_t i = 0; i < fit.viscous.size(); ++i)
    result.numbers.push_back(
        {fmt::format("c{}", 2 * i), "N mm s", fit.viscous[i], fit.viscous_limits[i]});
  put_flow_numbers(fit, result);
  put_quality(fit.quality, result);
}

void put_rated_specimens(const RatesFit& fit, Identified& result) {
  for (std::size_t p = 0; p < fit.specimens.size(); ++p) {
    const RatedQuality& one = fit.specimens[p];
    if (const std::string taken = corrections_text(fit.corrected[p], " mm"); !taken.empty())
      result.figures.push_back(fmt::format("taken off {}: {}", file_name(one.file), taken));
    const bool flows = std::isfinite(one.viscous_ratio);
    result.notes.push_back(fmt::format(
        "{}: {:g} mm/s, {:.3g} 1/s in the mean{}; residuals {:.2g} % rms, {}", file_name(one.file),
        one.speed, one.mean_rate,
        one.temperature ? fmt::format(", {:g} degC", *one.temperature) : std::string(),
        100.0 * one.quality.rms,
        flows ? fmt::format("viscous load {:.3g} times that of the law", one.viscous_ratio)
              : std::string("no viscous load by the law")));
  }
}

Identified rated_text(const RatesFit& fit) {
  Identified result;
  result.title = "shear law with a viscous torque";
  result.provides = {"shear"};
  put_rated_laws(fit, result);
  put_rated_numbers(fit, result);
  result.law_line =
      fmt::format("{} N mm, {} N mm s: torque of one unit cell = k1 g + k3 g^3 ... + "
                  "(c0 + c2 g^2 ...) dg/dt, g in rad",
                  named("k", 1, fit.elastic, "=", 5), named("c", 0, fit.viscous, "=", 5));
  const FitQuality& q = fit.quality;
  result.figures = {fmt::format("{} rows, {:.3g} to {:.3g} degrees, rates {:.3g} to {:.3g} 1/s",
                                q.rows, q.from / degree, q.to / degree, fit.rates[0], fit.rates[1]),
                    figure_of_residuals(q, fmt::format("{:.3g} degrees", q.largest_at / degree)),
                    fmt::format("viscous part {:.0f} % of the load of the fastest test; {}",
                                100.0 * fit.viscous_share, fit.why),
                    fmt::format("95 % limits {}, {}; from the residuals",
                                named("k", 1, fit.elastic_limits, "+-", 2),
                                named("c", 0, fit.viscous_limits, "+-", 2))};
  tell_flow(fit, result);
  doubt_flow(fit, result);
  put_rated_specimens(fit, result);
  result.fit = "displacement_mm,shear_deg,measured_N,fitted_N,specimen,rate_per_s\n";
  for (std::size_t i = 0; i < fit.angle.size(); ++i)
    result.fit += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{},{:.6g}\n", fit.extension[i],
                              fit.angle[i] / degree, fit.measured[i], fit.fitted[i],
                              fit.specimen[i] + 1, fit.rate[i]);
  return result;
}

Identified relaxation_text(const RelaxationFit& fit, double angle) {
  Identified result;
  result.title = "relaxation of shear";
  std::string rows;
  for (const RelaxationBranch& b : fit.branches) {
    rows += fmt::format("\n    [{:.6g}, {:.6g}],", b.modulus, b.time);
    result.law_line += fmt::format("{}{:.4g} N mm in {:.4g} s", result.law_line.empty() ? "" : ", ",
                                   b.modulus, b.time);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    result.numbers.push_back(
        {fmt::format("modulus of {:.3g} s", b.time), "N mm", b.modulus, unknown});
  }
  result.laws = {{"shear", "relaxation", "[" + rows + "\n]", {}}};
  result.law_line = fmt::format("Maxwell branches of one unit cell: {}", result.law_line);
  put_quality(fit.quality, result);
  result.figures = {
      fmt::format("{} rows, {:.3g} to {:.3g} s after the stop at {:g} degrees", fit.quality.rows,
                  fit.quality.from, fit.quality.to, angle / degree),
      figure_of_residuals(fit.quality, fmt::format("{:.3g} s", fit.quality.largest_at)),
      fmt::format("{:.3g} % of the load relaxes; torque at rest {:.4g} N mm, {:.4g} by the "
                  "fabric's elastic law",
                  100.0 * fit.relaxed_share, fit.rest_torque, fit.elastic_torque)};
  if (std::abs(fit.rest_torque - fit.elastic_torque) > 0.1 * fit.rest_torque)
    result.notes.push_back("torque at rest and elastic law differ by more than 10 %: identify the "
                           "elastic law from slow tests, or wait longer after the stop");
  result.fit = "time_s,measured_N,fitted_N,specimen\n";
  for (std::size_t i = 0; i < fit.time.size(); ++i)
    result.fit +=
        fmt::format("{:.9g},{:.9g},{:.9g},1\n", fit.time[i], fit.measured[i], fit.fitted[i]);
  return result;
}

FlowForm form_of(const std::string& word) {
  if (word == "arrhenius") return FlowForm::arrhenius;
  if (word == "wlf") return FlowForm::wlf;
  return word == "table" ? FlowForm::table : FlowForm::none;
}

/// Reports a list of numbers that is not one a curve, or has some that are not positive.
void check_one_each(const std::string& option, const std::vector<double>& values,
                    std::size_t curves, bool positive, Diagnostics& diagnostics) {
  if (!values.empty() && values.size() != curves)
    return option_error(option, fmt::format("{} numbers", values.size()),
                        fmt::format("must be one for each of the {} curves", curves),
                        "give them in the order of the curves", diagnostics);
  for (const double value : values)
    if (!std::isfinite(value) || (positive && !(value > 0.0)))
      return option_error(option, fmt::format("{:g}", value), "must be greater than 0",
                          "give positive numbers", diagnostics);
}

} // namespace

bool is_rated(const IdentifyArguments& a) {
  return is_shear_test(a.test) && !a.speeds.empty();
}

void check_rated(const IdentifyArguments& a, Diagnostics& diagnostics) {
  const std::size_t n = a.curves.size();
  check_one_each("--speeds", a.speeds, n, true, diagnostics);
  check_one_each("--pressures", a.pressures, n, true, diagnostics);
  check_one_each("--temperatures", a.temperatures, n, false, diagnostics);
  if (!a.speeds.empty() && is_shear_test(a.test) && (!a.others.empty() || are_laboratories(a)))
    option_error("--speeds", "", "cannot stand beside --negative or laboratories",
                 "identify the viscous torque of one side, of one laboratory", diagnostics);
  if (!a.temperatures.empty() && a.speeds.empty())
    option_error("--temperatures", "", "needs --speeds beside it",
                 "give the speed of the crosshead in each curve, mm/s", diagnostics);
  if (!a.temperature_law.empty() && a.temperatures.empty())
    option_error("--temperature-law", "", "needs --temperatures beside it",
                 "give the temperature of each curve, degC", diagnostics);
  if (a.test == "relaxation" && !(a.stop_angle > 0.0 && a.stop_angle < 90.0))
    option_error("--angle", fmt::format("{:g}", a.stop_angle), "must be between 0 and 90",
                 "give the shear angle at the stop, degrees", diagnostics);
}

std::optional<Identified> identify_rated_curves(const IdentifyArguments& a,
                                                const FabricReading& base, const ShearTest& test,
                                                const std::vector<Curve>& curves,
                                                const FitOptions& options,
                                                Diagnostics& diagnostics) {
  std::vector<RatedCurve> rated;
  for (std::size_t i = 0; i < curves.size() && i < a.speeds.size(); ++i) {
    rated.push_back({curves[i], a.speeds[i], {}});
    if (!a.temperatures.empty()) rated.back().temperature = a.temperatures[i];
  }
  const auto fit = identify_rates(
      rated, test, *base.value, options,
      {a.viscosity_coefficients.value_or(0), form_of(a.temperature_law)}, diagnostics);
  return fit ? std::optional(rated_text(*fit)) : std::nullopt;
}

std::optional<Identified> identify_relaxation_curve(const IdentifyArguments& a,
                                                    const FabricReading& base, const Curve& curve,
                                                    Diagnostics& diagnostics) {
  const bool frame = !std::isnan(a.specimen.side);
  const auto test = test_of(frame ? "frame" : "bias", a.specimen, diagnostics);
  if (!test) return std::nullopt;
  std::vector<double> times = a.times;
  std::sort(times.begin(), times.end());
  const auto fit = identify_relaxation(curve, {*test, a.stop_angle * degree, a.ramp, times},
                                       *base.value, diagnostics);
  return fit ? std::optional(relaxation_text(*fit, a.stop_angle * degree)) : std::nullopt;
}

CurveColumns relaxation_columns() {
  CurveColumns columns;
  columns.x_is = Quantity::time;
  columns.x_word = columns.x_preferred = "time";
  return columns;
}

} // namespace plyform
