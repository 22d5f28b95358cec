// SPDX-License-Identifier: GPL-3.0-or-later
// A case before it runs, as arrays that share the memory of the C++ preview.
#include "base/format.hpp"
#include "core/input/keys/tool_mesh_cache.hpp"
#include "core/setup/scene_preview.hpp"
#include "python/bindings.hpp"

namespace plyform {
namespace {

using SharedScene = std::shared_ptr<ScenePreview>;

/// An array of its own, of so many columns of numbers.
py::array rows(const double* values, std::size_t count, std::size_t columns) {
  return py::array_t<double>({count, columns}, values);
}

/// None for a word that is empty.
py::object word_or_none(const std::string& word) {
  return word.empty() ? py::object(py::none()) : py::object(py::str(word));
}

template <class Value>
py::object array_or_none(const std::vector<Value>& values, const py::object& owner) {
  if (values.empty()) return py::none();
  return shared_array(values, owner, false);
}

template <class Self, class Member>
auto shared(Member Self::*member) {
  return [member](const py::object& self) {
    return array_or_none(self.cast<const Self&>().*member, self);
  };
}

py::array nodes_array(const std::vector<int>& nodes) {
  return py::array_t<std::int32_t>(static_cast<py::ssize_t>(nodes.size()), nodes.data());
}

void bind_scene_ply(py::module_& m) {
  PartClass<PlyPreview>(m, "ScenePly", "A ply as it is laid, flat: n nodes, m triangles.")
      .def_readonly("name", &PlyPreview::name, "Name in the case; empty if it has none.")
      .def_readonly("fabric", &PlyPreview::fabric, "Name of its fabric, as the file has it.")
      .def_readonly("blank", &PlyPreview::blank, "Name of its blank, likewise.")
      .def_property_readonly(
          "angle_deg", [](const PlyPreview& p) { return p.angle / degree; },
          "From x to the warp; NaN where it has a mistake.")
      .def_readonly("thickness_mm", &PlyPreview::thickness, "mm; 0 if it cannot be drawn.")
      .def_readonly("coarser", &PlyPreview::coarser,
                    "Its elements over those of the run: 1 but for meshes too large to draw.")
      .def_property_readonly("x", shared(&PlyPreview::x),
                             "float64, (n, 3), mm, as placed; None if it cannot be drawn.")
      .def_property_readonly("triangles", shared(&PlyPreview::triangles),
                             "int32, (m, 3): nodes, from 0; None if it cannot be drawn.")
      .def_property_readonly(
          "edges",
          [](const PlyPreview& p) {
            py::list edges;
            for (const std::vector<int>& edge : p.edges)
              edges.append(nodes_array(edge));
            return edges;
          },
          "List of int32, (k,): nodes along its edge and along each hole, closed.")
      .def_property_readonly(
          "families",
          [](const PlyPreview& p) {
            py::dict families;
            for (const auto& [name, direction] : p.families)
              families[py::str(name)] = vector_array(direction);
            return families;
          },
          "float64, (3,) by family: unit vector along its yarns; empty where the fabric has "
          "mistakes.")
      .def_property_readonly(
          "trouble", [](const PlyPreview& p) { return word_or_none(printable(p.trouble)); },
          "Why it cannot be drawn, or None.")
      .def("__repr__", [](const PlyPreview& p) { return "<ScenePly " + p.name + ">"; });
}

void bind_scene_contacts(py::module_& m) {
  py::class_<PlyGap>(m, "PlyGap", "How far a tool is from the nearest ply at the start.")
      .def_readonly("gap_mm", &PlyGap::gap, "mm; below 0 the tool is in the ply.")
      .def_readonly("ply", &PlyGap::ply, "Number of the ply, from 0.")
      .def_property_readonly(
          "where", [](const PlyGap& g) { return vector_array(g.where); },
          "float64, (3,), mm, on a face of the ply.");
  py::class_<FirstContact>(m, "FirstContact", "Where a moving tool first touches a ply.")
      .def_readonly("stroke_mm", &FirstContact::stroke, "mm, along the tool's direction.")
      .def_readonly("time_s", &FirstContact::time, "s, when; None of a tool under a force.")
      .def_readonly("ply", &FirstContact::ply, "Number of the ply, from 0.")
      .def_property_readonly(
          "where", [](const FirstContact& c) { return vector_array(c.where); },
          "float64, (3,), mm, on a face of the ply.");
}

void bind_scene_tool(py::module_& m) {
  PartClass<ToolPreview>(m, "SceneTool", "A tool as it stands at the start, and its way.")
      .def_readonly("name", &ToolPreview::name, "Name in the case; empty if it has none.")
      .def_readonly("shape", &ToolPreview::shape, "sphere, box, mesh ...: as the file has it.")
      .def_property_readonly(
          "motion", [](const ToolPreview& t) { return word_or_none(t.motion); },
          "fixed, driven or force; None where it has a mistake.")
      .def_property_readonly(
          "x0",
          [](const py::object& self) {
            return array_or_none(self.cast<const ToolPreview&>().surface.x, self);
          },
          "float64, (n, 3), mm, at time 0; None if it cannot be drawn.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            return array_or_none(self.cast<const ToolPreview&>().surface.triangles, self);
          },
          "int32, (m, 3): nodes, from 0; None if it cannot be drawn.")
      .def_property_readonly(
          "direction", [](const ToolPreview& t) { return vector_array(t.direction); },
          "float64, (3,): unit vector.")
      .def_property_readonly("shifts_mm", shared(&ToolPreview::shifts),
                             "float64, (k, 3), mm from x0 at Scene.times_s; None of a tool under "
                             "a force, whose way only a run finds.")
      .def_property_readonly(
          "strokes_mm",
          [](const py::object& self) {
            return array_or_none(self.cast<const ToolPreview&>().moves.strokes, self);
          },
          "float64, (k,), mm along its direction at Scene.times_s; None likewise.")
      .def_property_readonly(
          "forces_N",
          [](const py::object& self) {
            return array_or_none(self.cast<const ToolPreview&>().moves.forces, self);
          },
          "float64, (k,), N that it is pushed with at Scene.times_s; None if it is not.")
      .def_readonly("gap", &ToolPreview::gap, "PlyGap at the start; None without a ply or tool.")
      .def_readonly("first_contact", &ToolPreview::first_contact,
                    "FirstContact on its way, with plies flat and all else at its start; None if "
                    "there is none, or it stands.")
      .def_property_readonly(
          "trouble", [](const ToolPreview& t) { return word_or_none(printable(t.trouble)); },
          "Why it cannot be drawn, or None.")
      .def("__repr__", [](const ToolPreview& t) { return "<SceneTool " + t.name + ">"; });
}

/// What boundaries of one kind have, by name.
struct BoundaryFields {
  py::dict& fields;

  void place(const HeldPlace& place) const {
    const std::array<double, 4> ends = {place.ends[0].x(), place.ends[0].y(), place.ends[1].x(),
                                        place.ends[1].y()};
    fields[place.on_edge ? "edge" : "box"] = rows(ends.data(), 2, 2);
  }
  void operator()(const Grip& grip) const {
    place(grip.place);
    fields["direction"] = vector_array(grip.direction);
    fields["held"] = py::make_tuple(grip.held[0], grip.held[1], grip.held[2]);
  }
  void operator()(const HingedFrame&) const {}
  void operator()(const SymmetryPlane& plane) const {
    fields["point"] = py::array_t<double>(2, plane.point.data());
    fields["normal"] = py::array_t<double>(2, plane.normal.data());
  }
  void operator()(const TensionSpring& spring) const {
    place(spring.place);
    fields["anchor"] = vector_array(spring.anchor);
    fields["stiffness_N_mm"] = spring.stiffness;
    fields["preload_N"] = spring.preload;
    fields["carried_by"] =
        spring.carrier < 0 ? py::object(py::none()) : py::object(py::int_(spring.carrier));
  }
  void operator()(const Gripper& gripper) const {
    place(gripper.place);
    fields["direction"] = vector_array(gripper.direction);
    fields["stiffness_N_mm"] = gripper.stiffness;
    fields["guided"] = gripper.guided;
  }
};

py::dict fields_of(const BoundaryPreview& b) {
  py::dict fields;
  if (b.trouble.empty()) std::visit(BoundaryFields{fields}, b.boundary.kind);
  return fields;
}

void bind_scene_boundary(py::module_& m) {
  PartClass<BoundaryPreview>(m, "SceneBoundary",
                             "A grip, frame, plane of symmetry, spring or "
                             "gripper.")
      .def_property_readonly(
          "name", [](const BoundaryPreview& b) { return b.boundary.name; },
          "Name in the case; empty if it has none.")
      .def_readonly("kind", &BoundaryPreview::kind, "grip, frame ...: as the file has it.")
      .def_property_readonly(
          "ply", [](const BoundaryPreview& b) { return word_or_none(b.ply); },
          "Name of the ply that it holds; None: all.")
      .def_property_readonly(
          "nodes",
          [](const BoundaryPreview& b) {
            py::list nodes;
            for (const std::vector<int>& held : b.nodes)
              nodes.append(nodes_array(held));
            return nodes;
          },
          "int32, (k,) of each ply: its nodes that it holds.")
      .def_property_readonly("fields", &fields_of,
                             "What its kind has, by name, mm, N, unit vectors: edge or box (2, 2), "
                             "direction, held; point, normal; anchor, stiffness_N_mm, preload_N, "
                             "carried_by (number of a tool); guided.")
      .def_property_readonly(
          "strokes_mm",
          [](const py::object& self) {
            return array_or_none(self.cast<const BoundaryPreview&>().moves.strokes, self);
          },
          "float64, (k,), mm at Scene.times_s, of the drive of a gripper too; None if it has no "
          "stroke.")
      .def_property_readonly(
          "forces_N",
          [](const py::object& self) {
            return array_or_none(self.cast<const BoundaryPreview&>().moves.forces, self);
          },
          "float64, (k,), N at Scene.times_s, of a gripper that is pulled; else None.")
      .def_property_readonly(
          "hinges_mm",
          [](const BoundaryPreview& b) -> py::object {
            if (b.hinges.empty()) return py::none();
            return py::array_t<double>(std::array<std::size_t, 3>{b.hinges.size(), 4, 3},
                                       b.hinges[0][0].data());
          },
          "float64, (k, 4, 3), mm: hinges of a frame at Scene.times_s; else None.")
      .def_property_readonly(
          "trouble", [](const BoundaryPreview& b) { return word_or_none(printable(b.trouble)); },
          "Why it cannot be drawn, or None.")
      .def("__repr__",
           [](const BoundaryPreview& b) { return "<SceneBoundary " + b.boundary.name + ">"; });
}

py::list loads_of(const ScenePreview& scene) {
  py::list loads;
  for (const PressureLoad& load : scene.loads) {
    py::dict one;
    one["entry"] = load.entry;
    one["ply"] = load.ply;
    one["side"] = load.side == PlyFace::above ? "above" : "below";
    one["pressure_N_mm2"] = load.pressure;
    loads.append(one);
  }
  return loads;
}

py::list spacings_of(const ScenePreview& scene) {
  py::list spacings;
  for (const PlySpacing& s : scene.spacings) {
    py::dict one;
    one["lower"] = s.lower;
    one["upper"] = s.upper;
    one["gap_mm"] = s.gap;
    spacings.append(one);
  }
  return spacings;
}

py::list tool_spacings_of(const ScenePreview& scene) {
  py::list spacings;
  for (const ToolSpacing& s : scene.tool_spacings) {
    py::dict one;
    one["a"] = s.a;
    one["b"] = s.b;
    one["gap_mm"] = s.gap;
    one["time_s"] = scene.times[s.time];
    one["where"] = vector_array(s.where);
    one["stack_mm"] = s.stack;
    spacings.append(one);
  }
  return spacings;
}

} // namespace

void bind_scene(py::module_& m) {
  bind_scene_ply(m);
  bind_scene_contacts(m);
  bind_scene_tool(m);
  bind_scene_boundary(m);
  py::class_<ScenePreview, SharedScene>(m, "Scene",
                                        "A case as it will stand before it runs; arrays can only "
                                        "be read.")
      .def_readonly("title", &ScenePreview::title, "Title of the case.")
      .def_readonly("duration_s", &ScenePreview::duration,
                    "s, simulated; 0 where it has a mistake.")
      .def_property_readonly(
          "times_s",
          [](const py::object& self) {
            return shared_array(self.cast<const ScenePreview&>().times, self, false);
          },
          "float64, (k,), s: evenly over the duration, and the ends of stages.")
      .def_property_readonly(
          "plies", [](const SharedScene& s) { return parts_of(s, s->plies); },
          "ScenePly by number, from the bottom, or by name: each of the file.")
      .def_property_readonly(
          "tools", [](const SharedScene& s) { return parts_of(s, s->tools); },
          "SceneTool by number or by name, likewise.")
      .def_property_readonly(
          "boundaries", [](const SharedScene& s) { return parts_of(s, s->boundaries); },
          "SceneBoundary by number or by name, likewise.")
      .def_property_readonly("loads", &loads_of,
                             "Pressures without mistakes: ply (its number), side (above, below), "
                             "pressure_N_mm2, the largest.")
      .def_property_readonly("spacings", &spacings_of,
                             "Neighbours of the stack: lower, upper (numbers of plies), gap_mm, "
                             "below 0 where they overlap.")
      .def_property_readonly("tool_spacings", &tool_spacings_of,
                             "How near tools whose ways are known come to each other: a, b "
                             "(numbers of tools), gap_mm, below 0 where one is in the other, "
                             "time_s, where, stack_mm, of the plies that lie there.")
      .def_property_readonly(
          "gravity", [](const ScenePreview& s) { return vector_array(s.gravity); },
          "float64, (3,), mm/s2.")
      .def_readonly("stack_thickness_mm", &ScenePreview::stack_thickness,
                    "mm, of all plies that can be drawn.")
      .def_readonly("mistakes", &ScenePreview::mistakes,
                    "List of Mistake of the file; those of the scene Case.check finds.")
      .def("__repr__", [](const ScenePreview& s) {
        return fmt::format("<Scene of {} plies, {} tools, {} boundaries>", s.plies.size(),
                           s.tools.size(), s.boundaries.size());
      });
  m.def(
      "preview",
      [](const std::filesystem::path& file, const std::vector<Override>& overrides, int threads) {
        const py::gil_scoped_release others;
        keep_tool_meshes(3'000'000); // who looks at a case once looks again
        return std::make_shared<ScenePreview>(
            preview_scene(file, overrides, threads_or_cores(threads)));
      },
      py::arg("file"), py::arg("overrides"), py::arg("threads"),
      "The scene of a case before it runs; overrides as (key, TOML text).");
}

} // namespace plyform
