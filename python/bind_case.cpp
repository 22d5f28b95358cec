// SPDX-License-Identifier: GPL-3.0-or-later
// Keys, mistakes, and cases as they were checked.
#include "base/format.hpp"
#include "base/text.hpp"
#include "base/thread_pool.hpp"
#include "core/accuracy/error_model.hpp"
#include "core/model/fabric_estimates.hpp"
#include "core/setup/key_value.hpp"
#include "core/setup/outlook.hpp"
#include "core/setup/scene_mesh.hpp"
#include "python/bindings.hpp"

#include <cmath>

namespace plyform {
namespace {

using Kind = TomlNode::Kind;

py::object to_python(const TomlNode& node) {
  switch (node.kind) {
  case Kind::table: {
    py::dict table;
    for (const TomlNode& child : node.children)
      table[py::str(child.key)] = to_python(child);
    return table;
  }
  case Kind::list: {
    py::list list;
    for (const TomlNode& child : node.children)
      list.append(to_python(child));
    return list;
  }
  case Kind::integer:
    return py::int_(std::llround(node.number));
  case Kind::number:
    return py::float_(node.number);
  case Kind::string:
    return py::str(node.text);
  case Kind::boolean:
  case Kind::date:
    break; // values of no key
  }
  return py::str(node.source_text);
}

py::object value_of(const std::filesystem::path& file, const std::vector<Override>& overrides,
                    const std::string& key) {
  Diagnostics unknown;
  const std::optional<TomlNode> value = value_of_key(file, overrides, key, unknown);
  if (!unknown.errors.empty())
    throw py::key_error(unknown.errors.front().item + ": " + unknown.errors.front().rule + "; " +
                        unknown.errors.front().remedy);
  return value ? to_python(*value) : py::none();
}

/// None for a number that is not finite.
template <class Member>
auto bound(Member KeyColumn::*member) {
  return [member](const KeyColumn& column) -> py::object {
    const double value = column.*member;
    return std::isfinite(value) ? py::object(py::float_(value)) : py::object(py::none());
  };
}

/// An attribute of the key's form.
template <class Member>
auto of_form(Member KeyForm::*member) {
  return [member](const KeyInfo& key) { return key.form.*member; };
}

void bind_key_columns(py::module_& m) {
  py::class_<KeyColumn>(m, "KeyColumn", "What the numbers of a column of a key may be.")
      .def_readonly("unit", &KeyColumn::unit, "mm, N, s, deg ...; - for none.")
      .def_property_readonly("least", bound(&KeyColumn::least), "Least number allowed, or None.")
      .def_property_readonly("most", bound(&KeyColumn::most), "Largest number allowed, or None.")
      .def_readonly("open_least", &KeyColumn::open_least, "Whether least itself is not allowed.")
      .def_readonly("open_most", &KeyColumn::open_most, "Whether most itself is not allowed.")
      .def_property_readonly("usual_least", bound(&KeyColumn::usual_least),
                             "What is less gets a warning; or None.")
      .def_property_readonly("usual_most", bound(&KeyColumn::usual_most),
                             "What is more gets a warning; or None.");
}

void bind_keys(py::module_& m) {
  bind_key_columns(m);
  py::class_<KeyInfo>(m, "Key", "A key of case and fabric files.")
      .def_readonly("key", &KeyInfo::key, "Dotted path: tool[].radius, fabrics.NAME.thickness.")
      .def_readonly("type", &KeyInfo::type, "number, integer, string, list of 3 numbers ...")
      .def_readonly("unit", &KeyInfo::unit, "mm, N, s, deg ...; - for none.")
      .def_readonly("default", &KeyInfo::fallback, "Default as TOML, or in words, or required.")
      .def_readonly("range", &KeyInfo::range, "Allowed values: > 0, [0, 1], one of ...")
      .def_readonly("meaning", &KeyInfo::meaning, "What it means.")
      .def_property_readonly("kind", of_form(&KeyForm::kind),
                             "table, tables, map, fabric, text, name, path, choice, number, "
                             "integer, boolean, numbers, "
                             "pairs ([a, b] each), names, profile or outlines.")
      .def_property_readonly("required", of_form(&KeyForm::required),
                             "Whether every table that may have it must.")
      .def_property_readonly("fallback", of_form(&KeyForm::fallback),
                             "Default as TOML; empty if there is none or it is no value.")
      .def_property_readonly("otherwise", of_form(&KeyForm::otherwise),
                             "Default in words, if it is no value; else empty.")
      .def_property_readonly("implied_by", of_form(&KeyForm::implied_by),
                             "Keys of the same table beside one of which `implied` is the default.")
      .def_property_readonly("implied", of_form(&KeyForm::implied), "TOML, or empty.")
      .def_property_readonly("choices", of_form(&KeyForm::choices),
                             "Words of a choice; beside `refers` words that stand for several "
                             "items.")
      .def_property_readonly("refers", of_form(&KeyForm::refers),
                             "Tables or lists of whose items it is a name: blanks, ply, "
                             "fabrics.NAME.family.")
      .def_property_readonly("columns", of_form(&KeyForm::columns),
                             "KeyColumn of each column of numbers; the last one is that of all "
                             "further ones. Empty for what has no numbers.")
      .def_property_readonly("count", of_form(&KeyForm::count),
                             "How many numbers or names; 0 for any number of them.")
      .def_property_readonly("least_items", of_form(&KeyForm::least_items),
                             "Least number of items of a list.")
      .def_property_readonly("most_items", of_form(&KeyForm::most_items),
                             "Largest number of them; 0 for no bound but that of all lists.")
      .def_property_readonly("instead", of_form(&KeyForm::instead),
                             "Keys of the same table of which, with this one, only one is given; "
                             "and one must be unless there is an otherwise.")
      .def_property_readonly("of", of_form(&KeyForm::of),
                             "Choice key of the same table that it depends on; or empty.")
      .def_property_readonly("of_values", of_form(&KeyForm::of_values),
                             "Values of that key with which it may stand.")
      .def("__repr__", [](const KeyInfo& k) { return "<Key " + k.key + ">"; });
}

void bind_mistakes(py::module_& m) {
  py::class_<CaseError>(m, "Mistake", "One mistake in a file: where, what, which rule, what to do.")
      .def_property_readonly(
          "file", [](const CaseError& e) { return printable(e.file); },
          "File, as it was named; --set for a value set from Python.")
      .def_readonly("line", &CaseError::line, "Line, from 1.")
      .def_readonly("column", &CaseError::column, "Column, from 1, in characters.")
      .def_readonly(
          "item", &CaseError::item,
          "Key as a dotted path with numbers from 0: ply.2.angle, fabrics.glass.warp.stiffness "
          "of a fabric file; of a part as a whole tool.1. Empty for a file that cannot "
          "be read or is no TOML.")
      .def_readonly("value", &CaseError::value, "Value as written; empty where it is missing.")
      .def_readonly("rule", &CaseError::rule, "The rule that is broken: must be at least 0.")
      .def_readonly("remedy", &CaseError::remedy, "What to do about it.")
      .def("__str__", &CaseError::text)
      .def("__repr__", [](const CaseError& e) { return "<Mistake " + e.text() + ">"; });
  bind_keys(m);
}

void bind_outlook(py::module_& m) {
  py::class_<Outlook>(m, "Outlook", "What will be modelled, and how long it takes.")
      .def_property_readonly(
          "lines",
          [](const Outlook& o) {
            std::vector<std::string> lines;
            for (const std::string& line : o.lines)
              lines.push_back(printable(line));
            return lines;
          },
          "What plyform check prints; lines that need a look start with warning or note, "
          "after four spaces.")
      .def_readonly("stable_step_s", &Outlook::stable_step, "s, the stable step at the start.")
      .def_readonly("step_s", &Outlook::step, "s, the step used at the start.")
      .def_readonly("steps", &Outlook::steps, "About how many steps the run takes.")
      .def_readonly("estimated_s", &Outlook::seconds, "About how long it takes, s of wall time.")
      .def_readonly("stop", &Outlook::stop, "Why the first steps went wrong; else empty.")
      .def("__str__", [](const Outlook& o) { return fmt::format("{}", fmt::join(o.lines, "\n")); })
      .def("__repr__", [](const Outlook& o) {
        return o.stop.empty() ? fmt::format("<Outlook of {} steps of {:.3g} s, about {:.3g} s>",
                                            o.steps, o.step, o.seconds)
                              : fmt::format("<Outlook: {}>", o.stop);
      });
  m.def(
      "look_ahead",
      [](const PreparedCase& prepared, int threads) {
        if (!prepared.value) raise_mistakes(prepared.errors);
        const py::gil_scoped_release others;
        return look_ahead(prepared, threads_or_cores(threads));
      },
      py::arg("prepared"), py::arg("threads"),
      "Outlook of a case; takes some steps of it. Raises CaseError if there are mistakes.");
}

} // namespace

void bind_case(py::module_& m) {
  bind_mistakes(m);
  py::class_<PredictedError>(
      m, "PredictedError",
      "Predicted error of the shear angle, rms over all plies, by cause; nan where "
      "the rule was not measured.")
      .def_readonly("inertia_deg", &PredictedError::inertia, "Degrees, from the duration.")
      .def_readonly("softening_deg", &PredictedError::softening, "Degrees, from softened fibres.")
      .def_readonly("mesh_deg", &PredictedError::mesh, "Degrees, from the element size.")
      .def_property_readonly("total_deg", &PredictedError::total,
                             "Degrees, of all three together.");
  py::class_<PreparedCase>(m, "Prepared", "A case as it was read and checked.")
      .def_readonly("mistakes", &PreparedCase::errors, "List of Mistake; empty if it can run.")
      .def_readonly("warnings", &PreparedCase::warnings, "Sentences with places.")
      .def_readonly("notes", &PreparedCase::notes, "What an accuracy asked for did not change.")
      .def_readonly("element_size_factor", &PreparedCase::coarsening,
                    "Element sizes over those of the file.")
      .def_property_readonly(
          "assumed",
          [](const PreparedCase& c) {
            return c.value ? assumptions(*c.value) : std::vector<std::string>{};
          },
          "Estimates for what the fabrics do not say.")
      .def_property_readonly(
          "predicted_error",
          [](const PreparedCase& c) {
            if (!c.value) raise_mistakes(c.errors);
            return predicted_error(*c.value);
          },
          "PredictedError. Raises CaseError if there are mistakes.");
  bind_outlook(m);
  const auto prepare = [](const std::filesystem::path& file, const std::vector<Override>& overrides,
                          bool quick) {
    PreparedCase prepared = prepare_case(file, overrides);
    if (prepared.value)
      mesh_from_scene(prepared, available_cores(), {.kept = true, .scouts = !quick});
    return prepared;
  };
  m.def("prepare", prepare, py::arg("file"), py::arg("overrides"), py::arg("quick"),
        py::call_guard<py::gil_scoped_release>(),
        "Reads, meshes and checks a case file; overrides as (key, TOML text). quick: without the "
        "fast "
        "run that finds a mesh from the scene, unless its sizes are kept from before.");
  m.def("value_of", &value_of, py::arg("file"), py::arg("overrides"), py::arg("key"),
        "The value of a key after overrides, None without one. Raises KeyError.");
  m.def("keys", &case_keys, "Every key of case and fabric files, as Key.");
  m.def("preset_error", &preset_error, py::arg("word"),
        "Degrees that an accuracy promises; 0 for a word that is none.");
}

} // namespace plyform
