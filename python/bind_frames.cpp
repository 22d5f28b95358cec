// SPDX-License-Identifier: GPL-3.0-or-later
// States of a run as arrays that share the memory of the C++ frame, and the difference of two.
#include "base/format.hpp"
#include "core/results/field_difference.hpp"
#include "core/results/result_fields.hpp"
#include "python/bindings.hpp"

#include <limits>
#include <memory>

namespace plyform {
namespace {

using SharedFrame = std::shared_ptr<Frame>;

/// An attribute of the ply's that is one of its arrays.
template <class Value>
void add_array(PartClass<PlyFrame>& ply, const char* name, std::vector<Value> PlyFrame::*values,
               const char* doc) {
  ply.def_property_readonly(
      name,
      [values](const py::object& self) {
        return shared_array(self.cast<const PlyFrame&>().*values, self, false);
      },
      doc);
}

/// A column by its name; None where it is left out. Raises AttributeError.
py::object column_of(const py::object& self, const std::string& name) {
  py::object found;
  each_column(self.cast<const PlyFrame&>(), [&](const Column& column, const auto& values) {
    if (column.name != name) return;
    if (column.may_lack && values.empty())
      found = py::none();
    else
      found = shared_array(values, self, false);
  });
  if (!found) throw py::attribute_error(fmt::format("a ply without the column {}", name));
  return found;
}

/// Names of families or stitches.
template <class Named>
py::tuple names_of(const std::vector<Named>& all) {
  py::list names;
  for (const Named& one : all)
    names.append(one.name);
  return py::tuple(names);
}

/// Names of the columns of one place: of nodes all, of triangles those that the ply has.
py::tuple names_at(const PlyFrame& ply, Location place) {
  py::list names;
  each_column(ply, [&](const Column& column, const auto& values) {
    const bool lacks = column.may_lack && values.empty() && place == Location::triangle;
    if (column.location == place && !lacks) names.append(column.name);
  });
  return py::tuple(names);
}

void bind_ply(py::module_& m) {
  PartClass<PlyFrame> ply(m, "PlyFrame",
                          "A ply at one time: n nodes, m triangles; arrays can only be read.");
  ply.def_readonly("name", &PlyFrame::name, "Name in the case.");
  ply.def_readonly("angle_deg", &PlyFrame::angle_deg, "From x to the warp, before forming.");
  add_array(ply, "x0", &PlyFrame::x0, "float64, (n, 3), mm: positions before forming.");
  add_array(ply, "x", &PlyFrame::x, "float64, (n, 3), mm: positions now.");
  add_array(ply, "triangles", &PlyFrame::triangles, "int32, (m, 3): nodes, from 0.");
  ply.def_property_readonly(
      "families", [](const PlyFrame& p) { return names_of(p.families); },
      "Names of its families of yarns, which begin the names of their columns.");
  ply.def_property_readonly(
      "stitches", [](const PlyFrame& p) { return names_of(p.stitches); },
      "Names of its directions of stitches, likewise.");
  ply.def_property_readonly(
      "cell_fields", [](const PlyFrame& p) { return names_at(p, Location::triangle); },
      "Names of its columns with a row a triangle.");
  ply.def_property_readonly(
      "node_fields", [](const PlyFrame& p) { return names_at(p, Location::node); },
      "Names of its columns with a row a node.");
  ply.def("__getattr__", &column_of,
          "A column by its name: float64, (m,), (m, 3), (n,) or (n, 3), as in "
          "docs/users/results.md, or None.");
  ply.def("__dir__", [](const py::object& self) {
    py::list names = py::module_::import("builtins").attr("object").attr("__dir__")(self);
    each_column(self.cast<const PlyFrame&>(),
                [&](const Column& column, const auto&) { names.append(column.name); });
    return names;
  });
  ply.def_property_readonly(
      "areas_before", [](const PlyFrame& p) { return py::array(py::cast(areas_before(p))); },
      "float64, (m,), mm2: area of each triangle before forming.");
}

void bind_bodies(py::module_& m) {
  PartClass<ToolFrame>(m, "ToolFrame", "A tool at one time.")
      .def_readonly("name", &ToolFrame::name, "Name in the case.")
      .def_property_readonly(
          "x0",
          [](const py::object& self) {
            return shared_array(self.cast<const ToolFrame&>().surface.x, self, false);
          },
          "float64, (n, 3), mm: its surface at time 0; it now stands displacement_mm from there.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            return shared_array(self.cast<const ToolFrame&>().surface.triangles, self, false);
          },
          "int32, (m, 3): nodes, from 0.")
      .def_property_readonly(
          "displacement_mm", [](const ToolFrame& t) { return vector_array(t.displacement); },
          "float64, (3,), mm, since time 0.")
      .def_property_readonly(
          "force_vector_N", [](const ToolFrame& t) { return vector_array(t.force); },
          "float64, (3,), N, that the plies exert on the tool.")
      .def_readonly("stroke_mm", &ToolFrame::stroke_mm, "mm, along the tool's direction.")
      .def_readonly("force_N", &ToolFrame::force_N,
                    "N, of the plies against that direction; positive when they push it back; "
                    "filtered, as docs/users/results.md says.")
      .def_readonly("force_raw_N", &ToolFrame::force_raw_N,
                    "N, the same of the last step alone, with the jitter of contact.");
  PartClass<BoundaryFrame>(m, "BoundaryFrame", "A grip, frame, spring or gripper at one time.")
      .def_readonly("name", &BoundaryFrame::name, "Name in the case.")
      .def_readonly("stroke_mm", &BoundaryFrame::stroke_mm, "mm, of its stroke.")
      .def_readonly("force_N", &BoundaryFrame::force_N, "N, positive when it pulls along it.")
      .def_property_readonly(
          "force_vector_N", [](const BoundaryFrame& b) { return vector_array(b.force); },
          "float64, (3,), N, on the plies.");
}

py::dict energies(const Frame& frame) {
  py::dict all;
  for (const EnergyTerm& term : energy_terms)
    all[term.name] = frame.energy.*term.value;
  all["balance_error"] = frame.energy.balance_error();
  return all;
}

SharedFrame read_state(const std::filesystem::path& file, long index) {
  auto frame = std::make_shared<Frame>(read_frame(file, index));
  for (const EnergyTerm& term : energy_terms) // the file does not have them
    frame->energy.*term.value = std::numeric_limits<double>::quiet_NaN();
  return frame;
}

} // namespace

void bind_frames(py::module_& m) {
  bind_ply(m);
  bind_bodies(m);
  py::class_<Frame, SharedFrame>(m, "Frame", "All plies, tools, grips and frames at one time.")
      .def_readonly("time_s", &Frame::time, "s, simulated.")
      .def_readonly("stroke_mm", &Frame::stroke_mm, "mm, of the first tool, grip or frame driven.")
      .def_readonly("step", &Frame::step, "Steps taken.")
      .def_property_readonly(
          "plies", [](const SharedFrame& f) { return parts_of(f, f->plies); },
          "PlyFrame by number, from the bottom, or by name.")
      .def_property_readonly(
          "tools", [](const SharedFrame& f) { return parts_of(f, f->tools); },
          "ToolFrame by number or by name.")
      .def_property_readonly(
          "boundaries", [](const SharedFrame& f) { return parts_of(f, f->boundaries); },
          "BoundaryFrame by number or by name.")
      .def_property_readonly("energies", &energies,
                             "mJ by name, and balance_error; NaN in a state read from a file.");
  py::class_<FieldDifference>(m, "Difference",
                              "Difference of a field, over the area before forming.")
      .def_property_readonly(
          "rms", [](const FieldDifference& d) { return d.error.rms; }, "Root of the mean square.")
      .def_property_readonly(
          "mean", [](const FieldDifference& d) { return d.error.mean; }, "Mean magnitude.")
      .def_property_readonly(
          "p95", [](const FieldDifference& d) { return d.error.p95; },
          "95 % of the area has at most this magnitude.")
      .def_property_readonly(
          "p99", [](const FieldDifference& d) { return d.error.p99; },
          "99 % of the area has at most this magnitude.")
      .def_property_readonly(
          "largest", [](const FieldDifference& d) { return d.error.max; }, "Largest magnitude.")
      .def_property_readonly(
          "at_nodes",
          [](const py::object& self) {
            py::list arrays;
            for (const auto& values : self.cast<const FieldDifference&>().at_nodes)
              arrays.append(shared_array(values, self, false));
            return arrays;
          },
          "For each ply float64, (n,): a less b at the nodes of b.");
  m.def("read_frame", &read_state, py::arg("file"), py::arg("index"),
        "A state of results.h5: from 0, or -1 for the last. Raises Error.");
  m.def("difference",
        py::overload_cast<const Frame&, const Frame&, const std::string&>(&field_difference),
        py::arg("a"), py::arg("b"), py::arg("field"),
        "Difference of a field of triangles, a less b. Raises Error, ValueError.");
}

} // namespace plyform
