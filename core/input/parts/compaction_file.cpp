// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/parts/compaction_file.hpp"

#include "base/format.hpp"
#include "core/input/keys/compaction_keys.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/model/usual_ranges.hpp"

#include <cmath>

namespace plyform {
namespace {

/// Area below a curve over depth: the work per area, N/mm.
double work_of(const ThicknessCurve& curve) {
  double sum = 0.0;
  for (std::size_t i = 1; i < curve.pressure.size(); ++i)
    sum += 0.5 * (curve.pressure[i] + curve.pressure[i - 1]) *
           (curve.thickness[i - 1] - curve.thickness[i]);
  return sum;
}

struct CompactionReader {
  const TableView& section;
  const Fabric& fabric;
  Diagnostics& diagnostics;

  void fail(const std::string& key, const std::string& rule, const std::string& remedy) const {
    value_error(section, key, rule, remedy, diagnostics);
  }

  /// mm, the thickness of the fibres alone.
  double weight() const { return fabric.surface_density / *fabric.fibre_density; }

  /// Reports a table that goes on to thicknesses in which the fibres have no room.
  bool has_room(const Compaction& c) const {
    const double volume = weight() / (c.densest() - c.nesting);
    constexpr double rounding = 1e-9;
    if (!(volume > densest_packing * (1.0 + rounding))) return true;
    fail(given(section, "table") ? "table" : "densest",
         fmt::format("goes to {:g} mm{}, where fibres would be {:.1f} % of the volume, and no "
                     "packing of fibres goes above {:g} %",
                     c.densest(),
                     c.nesting > 0.0 ? fmt::format(" less the nesting of {:g} mm", c.nesting) : "",
                     100.0 * volume, 100.0 * densest_packing),
         "leave out what no press reaches, or check thickness, surface_density and fibre_density");
    return false;
  }

  /// A table of [thickness, pressure]; empty if it is not given or wrong.
  ThicknessCurve curve(const std::string& key) const {
    ThicknessCurve curve;
    const std::vector<Vec2> points = pairs(section, key);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double t = points[i].x(), p = points[i].y();
      const auto wrong = [&](const std::string& rule, const std::string& remedy) {
        row_error(section, key, i, rule, remedy, diagnostics);
        return ThicknessCurve();
      };
      if (i == 0 && p != 0.0)
        return wrong("must begin without pressure", "put [thickness, 0.0] first");
      if (i > 0 && !(t < curve.thickness.back()))
        return wrong("must be thinner than the row before", "put the rows in order, the thickest "
                                                            "first, each thickness once");
      if (i > 0 && !(p > curve.pressure.back()))
        return wrong("must have more pressure than the row before", "take out what does not rise");
      curve.thickness.push_back(t), curve.pressure.push_back(p);
    }
    return curve;
  }

  /// A stiffness says what it is worth only by the pressure of the densest packing.
  void warn_of_pressure(double most) const {
    if (most <= usual_compaction_pressure) return;
    const TomlNode* stiffness = given(section, "stiffness");
    diagnostics.warning(
        stiffness->at,
        fmt::format("{} = {}: packs it to densest by {:.4g} N/mm2, which is unusual, usually up to "
                    "{:g} N/mm2; check number and unit",
                    item_of(section, "stiffness"), stiffness->source_text, most,
                    usual_compaction_pressure));
  }

  ThicknessCurve by_formula() const {
    for (const char* key : {"exponent", "densest"})
      if (!is_sound(section, key)) {
        return {}; // told
      } else if (!given(section, key)) {
        fail("stiffness", fmt::format("needs {} beside it", key),
             "give stiffness, exponent and densest, or a table");
        return {};
      }
    const double densest = number(section, "densest"), loose = weight() / fabric.thickness;
    if (densest <= loose) {
      fail("densest",
           fmt::format("must be more than the fibre volume before forming, {:.3g} with {:g} mm",
                       loose, fabric.thickness),
           "give what the mould packs it to, or check thickness, surface_density, fibre_density");
      return {};
    }
    const ThicknessCurve curve =
        toll_manson(number(section, "stiffness"), number(section, "exponent"), densest, weight(),
                    fabric.thickness);
    warn_of_pressure(curve.pressure.back());
    return curve;
  }

  bool begins_right(const ThicknessCurve& curve) const {
    if (std::abs(curve.thickness.front() - fabric.thickness) <= 1e-6 * fabric.thickness)
      return true;
    fail("table", fmt::format("begins at {:g} mm", curve.thickness.front()),
         fmt::format("begin with [{:g}, 0.0], the fabric's thickness, or change that",
                     fabric.thickness));
    return false;
  }

  bool ends_alike(const Compaction& c) const {
    const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); };
    const double t = c.densest(), p = c.loading.pressure.back();
    if (!same(c.unloading.thickness.back(), t) || !same(c.unloading.pressure.back(), p)) {
      fail("unloading", "must end where loading does",
           fmt::format("let its last row be [{:g}, {:g}]", t, p));
      return false;
    }
    if (c.unloading.thickness.front() <= fabric.thickness * (1.0 + 1e-9) &&
        work_of(c.unloading) <= work_of(c.loading) * (1.0 + 1e-9))
      return true;
    fail("unloading", "gives back more work than loading took",
         "give the curve of the plates going apart: thinner than the fabric without pressure");
    return false;
  }
};

} // namespace

void read_compaction(const TableView& section, Fabric& fabric, Diagnostics& diagnostics) {
  if (!section.entry) return;
  const CompactionReader reader{section, fabric, diagnostics};
  const bool formula = given(section, "stiffness") != nullptr;
  if (formula == (given(section, "table") != nullptr)) return; // told by the table of keys
  if (!fabric.fibre_density)
    return reader.fail(formula ? "stiffness" : "table",
                       "needs the fabric's fibre_density, from which its fibre volume follows",
                       "give fibre_density beside thickness, 2.55 g/cm3 of E glass, 1.8 of carbon");
  Compaction c;
  c.loading = formula ? reader.by_formula() : reader.curve("table");
  if (c.loading.thickness.size() < 2 || !reader.begins_right(c.loading)) return;
  if (given(section, "unloading")) {
    c.unloading = reader.curve("unloading");
    if (c.unloading.thickness.size() < 2 || !reader.ends_alike(c)) return;
  }
  c.nesting = number(section, "nesting");
  if (c.nesting >= 0.5 * c.densest())
    return reader.fail(
        "nesting",
        fmt::format("must be less than half of the densest packing, {:.3g} mm", c.densest()),
        "give what two plies lose together, some percent of the thickness");
  if (reader.has_room(c)) fabric.compaction = std::move(c);
}

bool check_fibre_volume(const TableView& fabric_section, const Fabric& fabric,
                        Diagnostics& diagnostics) {
  if (!fabric.fibre_density) return true;
  const double volume = fabric.surface_density / *fabric.fibre_density / fabric.thickness;
  if (!(volume > densest_packing)) return true;
  const auto words = [&](const char* key) {
    const TomlNode* value = given(fabric_section, key);
    return value ? value->source_text : std::string();
  };
  value_error(fabric_section, "fibre_density",
              fmt::format("with surface_density = {} and thickness = {} makes {:.1f} % of the "
                          "volume fibres, and no packing of fibres goes above {:g} %",
                          words("surface_density"), words("thickness"), 100.0 * volume,
                          100.0 * densest_packing),
              "check the three: fibre_density in g/cm3, 2.55 of E glass, surface_density in g/m2, "
              "thickness in mm",
              diagnostics);
  return false;
}

} // namespace plyform
