// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of a fabric from measured curves, and the curves that it should give: numbers in and out,
// which python/plyform/_fit.py puts into words.
#include "base/format.hpp"
#include "core/identify/fit_shear.hpp"
#include "core/identify/fit_tension.hpp"
#include "core/identify/measured_angle.hpp"
#include "core/identify/normalised_force.hpp"
#include "core/identify/test_columns.hpp"
#include "python/identify/fit_parts.hpp"

#include <cmath>

namespace plyform {
namespace {

/// Of the tests as python/plyform names them.
CurveColumns columns_of(const std::string& test) {
  if (test == "bias" || test == "frame") {
    CurveColumns columns = shear_columns(test == "frame");
    columns.x_hint = "give angle_column if it is a shear angle";
    return columns;
  }
  if (test == "three-point") return three_point_columns();
  if (test == "cantilever angle") return cantilever_columns(CantileverReading::chord_angle);
  if (test == "cantilever deflection") return cantilever_columns(CantileverReading::sag);
  if (test == "zone") return zone_columns();
  const bool strain = test == "strain";
  CurveColumns columns = tension_columns(strain);
  columns.x_hint = strain ? "give gauge_length if it is a displacement"
                          : "leave gauge_length out if it is a strain";
  return columns;
}

Curve curve_from_file(const std::filesystem::path& file, const std::string& x_column,
                      const std::string& y_column, const std::string& angle_column,
                      const std::string& test) {
  Diagnostics diagnostics;
  CurveColumns columns = columns_of(test);
  columns.x.column = x_column;
  columns.y.column = y_column;
  columns.angle.column = angle_column;
  std::optional<Curve> curve = read_curve(file, columns, diagnostics);
  if (!curve) raise_mistakes(diagnostics.errors);
  return std::move(*curve);
}

Curve curve_of(const std::vector<double>& x, const std::vector<double>& y,
               const std::vector<double>& angle_deg) {
  if (x.size() != y.size() || (!angle_deg.empty() && angle_deg.size() != x.size()))
    throw py::value_error(fmt::format("curve: {} places, but {} values", x.size(), y.size()));
  Curve curve{"curve", "x", "y", x, y, {}};
  if (!angle_deg.empty()) curve.angle_name = "angle";
  curve.angle_written = {{}, "degrees", degree};
  for (const double angle : angle_deg)
    curve.angle.push_back(angle * degree);
  for (std::size_t i = 0; i < x.size(); ++i)
    curve.line.push_back(static_cast<int>(i) + 1);
  return curve;
}

template <class Specimen>
ShearTest test_of(const char* kind, const Specimen& specimen) {
  if (const auto fault = fault_of(specimen))
    raise_mistakes(
        {{kind, 1, 1, fault->size, fmt::format("{:g}", fault->value), fault->rule, fault->remedy}});
  return shear_test(specimen);
}

/// A number, "fit" where that may stand, or None.
void put_correction(const py::object& given, const char* name, std::optional<double>& value,
                    bool& fit) {
  if (given.is_none()) return;
  if (py::isinstance<py::str>(given)) {
    if (given.cast<std::string>() != "fit")
      throw py::value_error(fmt::format("{} must be a number or 'fit'", name));
    fit = true;
    return;
  }
  value = given.cast<double>();
  if (!std::isfinite(*value)) throw py::value_error(fmt::format("{} must be finite", name));
}

} // namespace

py::array array_of(std::vector<double> values, double unit) {
  for (double& value : values)
    value /= unit;
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::dict quality_of(const FitQuality& quality, double unit) {
  py::dict all;
  all["rows"] = quality.rows;
  all["rms"] = quality.rms;
  all["largest"] = quality.largest;
  all["largest_at"] = quality.largest_at / unit;
  return all;
}

void put_corrections(const py::dict& given, FitOptions& options) {
  Corrections& c = options.corrections;
  bool fit = false;
  put_correction(given["zero"], "zero", c.load_zero, c.fit_load_zero);
  put_correction(given["toe"], "toe", c.toe, c.fit_toe);
  put_correction(given["compliance"], "compliance", c.compliance, fit);
  if (fit || (c.compliance && *c.compliance < 0.0))
    throw py::value_error("compliance must be a number of at least 0");
  c.fit_slip = given["slip"].cast<bool>();
  options.doubtful = given["doubtful"].cast<bool>();
}

Fabric fabric_for_fit(const std::filesystem::path& file, FabricNeeds needs) {
  FabricReading reading = read_fabric_file(file, true);
  const auto wrong = [&](const std::string& item, const std::string& rule,
                         const std::string& remedy) {
    reading.errors.push_back({file.string(), 1, 1, item, "", rule, remedy});
  };
  for (const std::string& missing : reading.missing)
    if (needs.shear_law && missing == "shear")
      wrong("shear", "is missing", "give the law of shear, or identify it from a measured curve");
  if (reading.value && !is_weave(*reading.value))
    wrong("law", "must be woven, without stitches: the tests are of warp and weft",
          "write the laws of other fabrics in by hand");
  else if (needs.right_angle && reading.value &&
           !(std::abs(material_axes(*reading.value).between() - 0.5 * std::numbers::pi) < 1e-6))
    wrong("fibre_angle", "must be 90 degrees: the theory of the shear tests is for such fabrics",
          "take the law from a test of your own evaluation and write it in by hand");
  if (!reading.errors.empty()) raise_mistakes(reading.errors);
  return std::move(*reading.value);
}

namespace {

/// Limits of confidence and specimens.
template <class Fit>
void put_sureness(const Fit& fit, py::dict& all) {
  all["limits"] = fit.confidence.coefficient;
  all["law_limits"] = fit.confidence.law;
  py::list own;
  for (const SpecimenLaw& specimen : fit.specimens)
    own.append(specimen.coefficients);
  all["of_specimens"] = own;
  all["scatter"] = fit.scatter.law;
}

std::optional<ShearFormKind> form_of(const std::string& law) {
  if (law.empty()) return std::nullopt;
  if (law == "polynomial") return ShearFormKind::polynomial;
  if (law == "static") return ShearFormKind::with_static;
  if (law == "table") return ShearFormKind::table;
  throw py::value_error("law must be 'polynomial', 'static', 'table' or None");
}

/// Decides whether measured angles count, unless told, and makes loads of normalised forces.
void prepare_curves(std::vector<Curve>& curves, const ShearTest& test,
                    std::optional<bool> measured_angle, bool normalised, FitOptions& options) {
  const Corrections& c = options.corrections;
  const bool extension = c.compliance.value_or(0.0) > 0.0 || c.fit_slip;
  options.measured_angle = measured_angle.value_or(!extension && angles_count(curves, test));
  for (Curve& curve : curves) {
    if (!options.measured_angle && curve.x_name.empty())
      throw py::value_error("angle_column: the curve has no extension that could count");
    if (normalised) curve.y_is = Quantity::force_per_length;
    take_normalised(curve, side_of(test), options.measured_angle);
  }
}

py::dict shear_law(std::vector<Curve> curves, const ShearTest& test,
                   const std::filesystem::path& fabric, const py::dict& form, double from_deg,
                   double to_deg, std::optional<bool> measured_angle, bool normalised,
                   const py::dict& corrections) {
  Diagnostics diagnostics;
  FitOptions options{form["coefficients"].cast<int>(), from_deg * degree, to_deg * degree};
  options.points = form["points"].cast<int>();
  options.law = form_of(form["law"].cast<std::string>());
  put_corrections(corrections, options);
  prepare_curves(curves, test, measured_angle, normalised, options);
  const auto fit = identify_shear(curves, test, fabric_for_fit(fabric, {.right_angle = true}),
                                  options, diagnostics);
  if (!fit) raise_mistakes(diagnostics.errors);
  py::dict all = quality_of(fit->quality, degree);
  put_sureness(*fit, all);
  all["misfit"] = fit->quality.misfit;
  all["noise"] = fit->quality.noise;
  all["law"] = fit->form.name();
  all["why"] = fit->why;
  all["coefficients"] = fit->polynomial;
  all["static_torque"] = fit->static_torque;
  all["table_deg"] = array_of(fit->law.angle, degree);
  all["table_torque"] = array_of(fit->law.torque);
  all["extension_mm"] = array_of(fit->extension);
  all["shear_deg"] = array_of(fit->angle, degree);
  all["measured_N"] = array_of(fit->measured);
  all["fitted_N"] = array_of(fit->fitted);
  all["warnings"] = diagnostics.warnings;
  return all;
}

py::dict tension_law(const std::vector<Curve>& curves, double yarns, double gauge_length,
                     double from, double to, const py::dict& corrections) {
  if (!(yarns > 0.0 && std::isfinite(yarns) && gauge_length > 0.0 && std::isfinite(gauge_length)))
    throw py::value_error("yarns and gauge length must be greater than 0");
  Diagnostics diagnostics;
  FitOptions options{1, from, to};
  put_corrections(corrections, options);
  const auto fit = identify_tension(curves, {yarns, gauge_length}, options, diagnostics);
  if (!fit) raise_mistakes(diagnostics.errors);
  py::dict all = quality_of(fit->quality, 1.0);
  put_sureness(*fit, all);
  all["stiffness"] = fit->law.linear() ? py::object(py::float_(fit->law.stiffness)) : py::none();
  all["table_strain"] = array_of(fit->law.strain);
  all["table_tension_N"] = array_of(fit->law.tension);
  all["strain"] = array_of(fit->strain);
  all["measured_N"] = array_of(fit->measured);
  all["fitted_N"] = array_of(fit->fitted);
  all["warnings"] = diagnostics.warnings;
  return all;
}

py::dict shear_curve(const ShearTest& test, const std::filesystem::path& file, double to_deg,
                     int points, bool negative) {
  if (!(to_deg > 0.0 && to_deg < 90.0))
    throw py::value_error("to_deg must be above 0 and below 90");
  if (points < 1 || points > 1000000) throw py::value_error("points must be 1 to 1000000");
  const Fabric fabric = fabric_for_fit(file, {.shear_law = true, .right_angle = true});
  const double end = extension_at(test, to_deg * degree);
  const double bending = in_plane_bending_share(test, fabric).mean();
  std::vector<double> extension, angle, load;
  for (int i = 0; i <= points; ++i) {
    const double d = end * i / points;
    extension.push_back(d);
    angle.push_back(negative ? -shear_angle(test, d) : shear_angle(test, d));
    load.push_back((1.0 + bending) * test_load(test, fabric, d, negative));
  }
  py::dict all;
  all["displacement_mm"] = array_of(extension);
  all["shear_deg"] = array_of(angle, degree);
  all["force_N"] = array_of(load);
  return all;
}

std::string
fabric_with_laws(const std::filesystem::path& file,
                 const std::vector<std::tuple<std::string, std::string, std::string>>& laws,
                 const std::vector<std::string>& comment) {
  const FabricReading reading = read_fabric_file(file, true);
  if (!reading.errors.empty()) raise_mistakes(reading.errors);
  std::string text = reading.text;
  for (const auto& [table, key, value] : laws) {
    const bool beside = key == "buckling_force"; // the comment stands above its stiffness
    text = with_law(text, {table, key, value, beside ? std::vector<std::string>{} : comment});
  }
  return text;
}

} // namespace

void bind_fit(py::module_& m) {
  py::class_<Curve>(m, "Curve", "A measured curve.")
      .def(py::init(&curve_of), py::arg("x"), py::arg("y"), py::arg("angle_deg"),
           "Of sequences as long as each other; the last may be empty.")
      .def_property_readonly(
          "x", [](const Curve& c) { return array_of(c.x); }, "float64, one a row.")
      .def_property_readonly(
          "y", [](const Curve& c) { return array_of(c.y); }, "float64, one a row.");
  py::class_<ShearTest>(m, "ShearTest", "Sizes of a shear test.");
  m.def("read_curve", &curve_from_file, py::arg("file"), py::arg("x_column"), py::arg("y_column"),
        py::arg("angle_column"), py::arg("test"),
        "Columns of a CSV file, by name or number from 1; empty: by what the header says.");
  m.def(
      "bias_test",
      [](double length, double width) {
        return test_of("bias", BiasSpecimen{length, width});
      },
      py::arg("length"), py::arg("width"), "Bias-extension test; free length and width, mm.");
  m.def(
      "frame_test", [](double side) { return test_of("frame", FrameSpecimen{side}); },
      py::arg("side"), "Picture frame; side from hinge to hinge, mm.");
  m.def("identify_shear", &shear_law, py::arg("curves"), py::arg("test"), py::arg("fabric"),
        py::arg("form"), py::arg("from_deg"), py::arg("to_deg"), py::arg("measured_angle"),
        py::arg("normalised"), py::arg("corrections"), "Law of shear.");
  m.def("identify_tension", &tension_law, py::arg("curves"), py::arg("yarns"),
        py::arg("gauge_length"), py::arg("from_strain"), py::arg("to_strain"),
        py::arg("corrections"), "Law of tension.");
  m.def("theory_shear", &shear_curve, py::arg("test"), py::arg("fabric"), py::arg("to_deg"),
        py::arg("points"), py::arg("negative"), "The curve that a fabric should give.");
  m.def("fabric_with_laws", &fabric_with_laws, py::arg("fabric"), py::arg("laws"),
        py::arg("comment"), "Text of a fabric file with laws put in.");
  bind_bending(m);
}

} // namespace plyform
