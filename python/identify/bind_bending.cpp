// SPDX-License-Identifier: GPL-3.0-or-later
// Bending and compression from measured curves: numbers in and out, which
// python/plyform/_bending.py puts into words.
#include "base/format.hpp"
#include "core/identify/bending_tests.hpp"
#include "core/identify/fit_tension.hpp"
#include "python/identify/fit_parts.hpp"

#include <cmath>

namespace plyform {
namespace {

void require_positive(const char* name, double value) {
  if (!(value > 0.0 && std::isfinite(value)))
    throw py::value_error(fmt::format("{} must be greater than 0", name));
}

py::dict bending_law(const BendingFit& fit) {
  py::dict all = quality_of(fit.quality, 1.0);
  all["stiffness"] = fit.stiffness;
  all["limits"] = fit.limits;
  all["bending_length_mm"] = fit.bending_length;
  all["table_curvature"] = array_of(fit.table.curvature);
  all["table_moment_N"] = array_of(fit.table.moment);
  all["of_specimens"] = fit.of_specimen;
  all["scatter"] = fit.scatter;
  all["x"] = array_of(fit.x);
  all["measured"] = array_of(fit.measured);
  all["fitted"] = array_of(fit.fitted);
  return all;
}

py::dict cantilever_law(const std::vector<Curve>& curves, const std::filesystem::path& fabric,
                        bool angle, const py::dict& corrections) {
  Diagnostics diagnostics;
  FitOptions options;
  put_corrections(corrections, options);
  const auto reading = angle ? CantileverReading::chord_angle : CantileverReading::sag;
  const auto fit =
      identify_cantilever(curves, reading, fabric_for_fit(fabric, {}), options, diagnostics);
  if (!fit) raise_mistakes(diagnostics.errors);
  py::dict all = bending_law(*fit);
  all["warnings"] = diagnostics.warnings;
  return all;
}

py::dict three_point_law(const std::vector<Curve>& curves, const std::filesystem::path& fabric,
                         double span, double width, double from, double to,
                         const py::dict& corrections) {
  require_positive("span", span);
  require_positive("width", width);
  Diagnostics diagnostics;
  FitOptions options;
  options.from = from;
  options.to = to;
  put_corrections(corrections, options);
  const auto fit =
      identify_three_point(curves, {span, width}, fabric_for_fit(fabric, {}), options, diagnostics);
  if (!fit) raise_mistakes(diagnostics.errors);
  py::dict all = bending_law(*fit);
  all["warnings"] = diagnostics.warnings;
  return all;
}

py::dict zone_law(const std::vector<Curve>& curves, const std::filesystem::path& fabric,
                  const py::dict& corrections) {
  Diagnostics diagnostics;
  FitOptions options;
  put_corrections(corrections, options);
  const auto fit =
      identify_zone(curves, fabric_for_fit(fabric, {.shear_law = true}), options, diagnostics);
  if (!fit) raise_mistakes(diagnostics.errors);
  py::dict all;
  all["rows"] = fit->quality.rows;
  all["rms"] = fit->quality.rms;
  all["stiffness"] = fit->stiffness;
  all["limits"] = fit->stiffness_limits;
  all["length_mm"] = fit->length;
  all["length_limits_mm"] = fit->length_limits;
  all["plateau_deg"] = fit->plateau / degree;
  all["lengths_mm"] = fit->lengths;
  all["distance_mm"] = array_of(fit->x);
  all["measured_deg"] = array_of(fit->measured, degree);
  all["fitted_deg"] = array_of(fit->fitted, degree);
  all["warnings"] = diagnostics.warnings;
  return all;
}

py::dict compression_law(const Curve& curve, double yarns, double gauge_length, double from,
                         double to, const py::dict& corrections) {
  require_positive("yarns", yarns);
  require_positive("gauge_length", gauge_length);
  Diagnostics diagnostics;
  FitOptions options;
  options.from = from;
  options.to = to;
  put_corrections(corrections, options);
  const auto fit = identify_compression(curve, {yarns, gauge_length}, options, diagnostics);
  if (!fit) raise_mistakes(diagnostics.errors);
  py::dict all = quality_of(fit->quality, 1.0);
  all["stiffness"] = fit->stiffness;
  all["limits"] = fit->stiffness_limits;
  all["buckling_force"] = fit->buckling_force;
  all["strain"] = array_of(fit->strain);
  all["measured_N"] = array_of(fit->measured);
  all["fitted_N"] = array_of(fit->fitted);
  all["warnings"] = diagnostics.warnings;
  return all;
}

void compression_below_tension(double stiffness, const std::string& yarns,
                               const std::filesystem::path& fabric) {
  Diagnostics diagnostics;
  check_compression(stiffness, yarns, fabric_for_fit(fabric, {}), {fabric.string(), 1, 1},
                    diagnostics);
  if (!diagnostics.errors.empty()) raise_mistakes(diagnostics.errors);
}

} // namespace

void bind_bending(py::module_& m) {
  m.def("identify_cantilever", &cantilever_law, py::arg("curves"), py::arg("fabric"),
        py::arg("angle"), py::arg("corrections"), "Bending stiffness from overhangs.");
  m.def("identify_three_point", &three_point_law, py::arg("curves"), py::arg("fabric"),
        py::arg("span"), py::arg("width"), py::arg("from_share"), py::arg("to_share"),
        py::arg("corrections"), "Bending stiffness, or a table.");
  m.def("identify_zone", &zone_law, py::arg("curves"), py::arg("fabric"), py::arg("corrections"),
        "In-plane bending stiffness from profiles of the shear angle.");
  m.def("identify_compression", &compression_law, py::arg("curve"), py::arg("yarns"),
        py::arg("gauge_length"), py::arg("from_strain"), py::arg("to_strain"),
        py::arg("corrections"), "Law of compression.");
  m.def("check_compression", &compression_below_tension, py::arg("stiffness"), py::arg("yarns"),
        py::arg("fabric"), "Raises CaseError for one that is more than that in tension.");
}

} // namespace plyform
