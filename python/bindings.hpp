// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the compiled module _plyform, a file each, and what they share.
#pragma once

#include "base/diagnostics.hpp"
#include "base/geometry.hpp"

#include <algorithm>
#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <thread>
#include <vector>

namespace plyform {

namespace py = pybind11;

// Each adds its classes and functions, after those that it needs.
void bind_case(py::module_& m);       ///< python/bind_case.cpp: keys, mistakes, checked cases
void bind_frames(py::module_& m);     ///< python/bind_frames.cpp: states, their difference
void bind_scene(py::module_& m);      ///< python/bind_scene.cpp: cases before they run
void bind_simulation(py::module_& m); ///< python/bind_simulation.cpp
void bind_identify(py::module_& m);   ///< python/identify/bind_identify.cpp: laws and curves

/// Raises plyform.CaseError with these mistakes.
[[noreturn]] void raise_mistakes(const std::vector<CaseError>& mistakes);

/// As many threads as there are cores for 0.
inline int threads_or_cores(int threads) {
  return threads > 0 ? threads
                     : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// A Sequence that takes names besides numbers (python/plyform/_parts.py).
inline py::object parts(const py::list& items) {
  return py::module_::import("plyform._parts").attr("Parts")(items);
}

template <class Part>
using PartClass = py::class_<Part, std::shared_ptr<Part>>;

/// The parts of a whole, each of which keeps the whole alive.
template <class Whole, class Part>
py::object parts_of(const std::shared_ptr<Whole>& whole, std::vector<Part>& items) {
  py::list list;
  for (Part& item : items)
    list.append(py::cast(std::shared_ptr<Part>(whole, &item)));
  return parts(list);
}

/// `values` as an array that shares their memory and keeps `owner` alive. Whoever owns them must
/// not make them longer or shorter.
template <class Value>
py::array shared_array(const std::vector<Value>& values, const py::handle& owner, bool writable) {
  using Number = std::conditional_t<std::is_same_v<Value, Triangle>, std::int32_t, double>;
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size())};
  if (sizeof(Value) > sizeof(Number)) shape.push_back(sizeof(Value) / sizeof(Number));
  py::array array(py::dtype::of<Number>(), std::move(shape), values.data(), owner);
  auto& flags = py::detail::array_proxy(array.ptr())->flags;
  if (writable)
    flags |= py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  else
    flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Three numbers as an array of their own.
inline py::array vector_array(const Vec3& v) {
  return py::array_t<double>(3, v.data());
}

} // namespace plyform
