// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of a fabric from measured curves, and the curves that it should give: numbers in and out,
// which python/plyform/_fit.py puts into words.
#include "core/fit/fit_shear.hpp"
#include "core/input/fabric_file.hpp"
#include "python/bindings.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plyform {
namespace {

constexpr double deg = std::numbers::pi / 180.0;

py::array array_of(std::vector<double> values, double unit = 1.0) {
  for (double& value : values)
    value /= unit;
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

Curve curve_from_file(const std::filesystem::path& file, const std::string& x_column,
                      const std::string& y_column) {
  Diagnostics diagnostics;
  std::optional<Curve> curve = read_curve(file, x_column, y_column, diagnostics);
  if (!curve) raise_mistakes(diagnostics.errors);
  return std::move(*curve);
}

Curve curve_of(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size())
    throw py::value_error(fmt::format("curve: {} places, but {} values", x.size(), y.size()));
  Curve curve{"curve", "x", "y", x, y, {}};
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

/// A fabric whose shear tests have a theory; `law`: with a law of shear.
Fabric fabric_for_shear(const std::filesystem::path& file, bool law) {
  FabricReading reading = read_fabric_file(file, true);
  const auto wrong = [&](const std::string& item, const std::string& rule,
                         const std::string& remedy) {
    reading.errors.push_back({file.string(), 1, 1, item, "", rule, remedy});
  };
  for (const std::string& missing : reading.missing)
    if (law && missing == "shear")
      wrong("shear", "is missing", "give the law of shear, or identify it from a measured curve");
  if (reading.value && !(std::abs(reading.value->fibre_angle - 0.5 * std::numbers::pi) < 1e-6))
    wrong("fibre_angle", "must be 90 degrees: the theory of the shear tests is for such fabrics",
          "take the law from a test of your own evaluation and write it in by hand");
  if (!reading.errors.empty()) raise_mistakes(reading.errors);
  return std::move(*reading.value);
}

py::dict quality(const FitQuality& q, double unit) {
  py::dict all;
  all["rows"] = q.rows;
  all["rms"] = q.rms;
  all["largest"] = q.largest;
  all["largest_at"] = q.largest_at / unit;
  return all;
}

py::dict shear_law(const Curve& curve, const ShearTest& test, const std::filesystem::path& fabric,
                   int coefficients, double from_deg, double to_deg) {
  Diagnostics diagnostics;
  const auto fit = identify_shear(curve, test, fabric_for_shear(fabric, false),
                                  {coefficients, from_deg * deg, to_deg * deg}, diagnostics);
  if (!fit) raise_mistakes(diagnostics.errors);
  py::dict all = quality(fit->quality, deg);
  all["coefficients"] = fit->law.k;
  all["extension_mm"] = array_of(fit->extension);
  all["shear_deg"] = array_of(fit->angle, deg);
  all["measured_N"] = array_of(fit->measured);
  all["fitted_N"] = array_of(fit->fitted);
  all["warnings"] = diagnostics.warnings;
  return all;
}

py::dict tension_law(const Curve& curve, double yarns, double gauge_length, double from,
                     double to) {
  if (!(yarns > 0.0 && std::isfinite(yarns) && gauge_length > 0.0 && std::isfinite(gauge_length)))
    throw py::value_error("yarns and gauge length must be greater than 0");
  Diagnostics diagnostics;
  const auto fit = identify_tension(curve, {yarns, gauge_length}, {1, from, to}, diagnostics);
  if (!fit) raise_mistakes(diagnostics.errors);
  py::dict all = quality(fit->quality, 1.0);
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
                     int points) {
  if (!(to_deg > 0.0 && to_deg < 90.0))
    throw py::value_error("to_deg must be above 0 and below 90");
  if (points < 1 || points > 1000000) throw py::value_error("points must be 1 to 1000000");
  const Fabric fabric = fabric_for_shear(file, true);
  const double end = extension_at(test, to_deg * deg);
  const double bending = in_plane_bending_share(test, fabric).mean();
  std::vector<double> extension, angle, load;
  for (int i = 0; i <= points; ++i) {
    const double d = end * i / points;
    extension.push_back(d);
    angle.push_back(shear_angle(test, d));
    load.push_back((1.0 + bending) * test_load(test, fabric, d));
  }
  py::dict all;
  all["displacement_mm"] = array_of(extension);
  all["shear_deg"] = array_of(angle, deg);
  all["force_N"] = array_of(load);
  return all;
}

std::string fabric_with_law(const std::filesystem::path& file, const std::string& table,
                            const std::string& key, const std::string& value,
                            const std::vector<std::string>& comment) {
  const FabricReading reading = read_fabric_file(file, true);
  if (!reading.errors.empty()) raise_mistakes(reading.errors);
  return with_law(reading.text, {table, key, value, comment});
}

} // namespace

void bind_fit(py::module_& m) {
  py::class_<Curve>(m, "Curve", "A measured curve.")
      .def(py::init(&curve_of), py::arg("x"), py::arg("y"),
           "Of two sequences as long as each other.")
      .def_property_readonly(
          "x", [](const Curve& c) { return array_of(c.x); }, "float64, one a row.")
      .def_property_readonly(
          "y", [](const Curve& c) { return array_of(c.y); }, "float64, one a row.");
  py::class_<ShearTest>(m, "ShearTest", "Sizes of a shear test.");
  m.def("read_curve", &curve_from_file, py::arg("file"), py::arg("x_column"), py::arg("y_column"),
        "Two columns of a CSV file, by name or number from 1; empty: the first two.");
  m.def(
      "bias_test",
      [](double length, double width) {
        return test_of("bias", BiasSpecimen{length, width});
      },
      py::arg("length"), py::arg("width"), "Bias-extension test; free length and width, mm.");
  m.def(
      "frame_test", [](double side) { return test_of("frame", FrameSpecimen{side}); },
      py::arg("side"), "Picture frame; side from hinge to hinge, mm.");
  m.def("identify_shear", &shear_law, py::arg("curve"), py::arg("test"), py::arg("fabric"),
        py::arg("coefficients"), py::arg("from_deg"), py::arg("to_deg"), "Law of shear.");
  m.def("identify_tension", &tension_law, py::arg("curve"), py::arg("yarns"),
        py::arg("gauge_length"), py::arg("from_strain"), py::arg("to_strain"), "Law of tension.");
  m.def("theory_shear", &shear_curve, py::arg("test"), py::arg("fabric"), py::arg("to_deg"),
        py::arg("points"), "The curve that a fabric should give.");
  m.def("fabric_with_law", &fabric_with_law, py::arg("fabric"), py::arg("table"), py::arg("key"),
        py::arg("value"), py::arg("comment"), "Text of a fabric file with a law put in.");
}

} // namespace plyform
