// SPDX-License-Identifier: GPL-3.0-or-later
// States of a run as arrays that share the memory of the C++ frame, and the difference of two.
#include "core/results/field_difference.hpp"
#include "core/results/result_fields.hpp"
#include "python/bindings.hpp"

#include <limits>
#include <memory>

namespace plyform {
namespace {

using SharedFrame = std::shared_ptr<Frame>;
template <class Part>
using PartClass = py::class_<Part, std::shared_ptr<Part>>;

/// The parts of a frame, each of which keeps the frame alive.
template <class Part>
py::object parts_of(const SharedFrame& frame, std::vector<Part>& items) {
  py::list list;
  for (Part& item : items)
    list.append(py::cast(std::shared_ptr<Part>(frame, &item)));
  return parts(list);
}

/// An attribute of the ply's that is one of its arrays; None where it is empty and may be.
template <class Value>
void add_column(PartClass<PlyFrame>& ply, const char* name, std::vector<Value> PlyFrame::*values,
                const std::string& doc, bool may_lack = false) {
  ply.def_property_readonly(
      name,
      [values, may_lack](const py::object& self) -> py::object {
        const PlyFrame& frame = self.cast<const PlyFrame&>();
        if (may_lack && (frame.*values).empty()) return py::none();
        return shared_array(frame.*values, self, false);
      },
      doc.c_str());
}

/// Adds the columns of one table, and their names to a list.
template <class Table>
void add_columns(PartClass<PlyFrame>& ply, const Table& table, const char* shape, bool may_lack,
                 py::list& names) {
  for (const auto& column : table) {
    add_column(ply, column.name, column.values,
               std::string("float64, ") + shape + (may_lack ? ", or None" : "") +
                   ": as in docs/users/results.md; the unit is in the name (pressure: N/mm2).",
               may_lack);
    names.append(column.name);
  }
}

void bind_ply(py::module_& m) {
  PartClass<PlyFrame> ply(m, "PlyFrame",
                          "A ply at one time: n nodes, m triangles; arrays can only be read.");
  ply.def_readonly("name", &PlyFrame::name, "Name in the case.");
  ply.def_readonly("angle_deg", &PlyFrame::angle_deg, "From x to the warp, before forming.");
  add_column(ply, "x0", &PlyFrame::x0, "float64, (n, 3), mm: positions before forming.");
  add_column(ply, "x", &PlyFrame::x, "float64, (n, 3), mm: positions now.");
  add_column(ply, "triangles", &PlyFrame::triangles, "int32, (m, 3): nodes, from 0.");
  py::list cells, nodes;
  add_columns(ply, cell_scalars, "(m,)", false, cells);
  add_columns(ply, cell_vectors, "(m, 3)", false, cells);
  add_columns(ply, node_scalars, "(n,)", false, nodes);
  add_columns(ply, node_vectors, "(n, 3)", true, nodes);
  ply.attr("cell_fields") = py::tuple(cells);
  ply.attr("node_fields") = py::tuple(nodes);
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
