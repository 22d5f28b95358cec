// SPDX-License-Identifier: GPL-3.0-or-later
// The compiled part of `import plyform`. What its users see, and how it is to be called, is in
// python/plyform: __init__.py and, for this part, _plyform.pyi.
#include "base/text.hpp"
#include "base/version.hpp"
#include "core/results/export.hpp"
#include "python/bindings.hpp"

#include <stdexcept>

namespace plyform {
namespace {

py::object error_class(const char* name) {
  return py::module_::import("plyform._errors").attr(name);
}

/// What the program ends with exit code 1 for is plyform.Error; the rest is left to pybind11.
void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const std::runtime_error& error) {
    PyErr_SetString(error_class("Error").ptr(), printable(error.what()).c_str()); // UTF-8
  }
}

newfunc made_by_pybind = nullptr; ///< of all classes here

PyObject* make(PyTypeObject* type, PyObject* arguments, PyObject* keywords) {
  return made_by_pybind(type, arguments, keywords);
}

/// Only a constructor, or C++, makes objects: what __new__ alone makes, which copy.copy and
/// unpickling call too, would be memory without a value, in which pybind11 sees one.
void refuse_unfinished_objects(const py::module_& m) {
  const py::cpp_function refuse([](const py::args&, const py::kwargs&) -> py::object {
    throw py::type_error("objects of this class are made by plyform: they cannot be made without "
                         "their contents, copied or unpickled");
  });
  for (const auto& [name, value] : m.attr("__dict__").cast<py::dict>()) {
    if (PyType_Check(value.ptr()) == 0) continue;
    auto* type = reinterpret_cast<PyTypeObject*>(value.ptr());
    made_by_pybind = type->tp_new;
    py::setattr(value, "__new__", py::staticmethod(refuse)); // sets tp_new too, to call it
    type->tp_new = make;
    PyType_Modified(type);
  }
}

} // namespace

void raise_mistakes(const std::vector<CaseError>& mistakes) {
  const py::object type = error_class("CaseError");
  PyErr_SetObject(type.ptr(), type(mistakes).ptr());
  throw py::error_already_set();
}

} // namespace plyform

PYBIND11_MODULE(_plyform, m) {
  using namespace plyform;
  py::register_local_exception_translator(translate);
  m.doc() = "The compiled part of plyform.";
  m.attr("version") = version();
  bind_case(m);
  bind_frames(m);
  bind_scene(m);
  bind_simulation(m);
  bind_identify(m);
  m.def(
      "export_results", [](const std::filesystem::path& folder) { return export_results(folder); },
      py::arg("folder"),
      "Writes FOLDER/export/NAME.vtu, .stl and .csv of the last state; the files written.");
  refuse_unfinished_objects(m);
}
