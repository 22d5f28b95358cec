// SPDX-License-Identifier: GPL-3.0-or-later
// A simulation that Python watches, stops, and whose arrays it sees while it goes on.
#include "core/results/result_fields.hpp"
#include "core/run/output_state.hpp"
#include "core/setup/instant.hpp"
#include "core/setup/run_prepared.hpp"
#include "core/solver/scene.hpp"
#include "core/solver/whole_step.hpp"
#include "python/bindings.hpp"

#include <stdexcept>
#include <unistd.h>

namespace plyform {
namespace {

/// What a run has come to.
struct Outcome {
  std::shared_ptr<Frame> last;
  std::string summary; ///< content of summary.json
  py::object error;    ///< that a callback raised, or Ctrl-C; else None
};

/// Calls Python from within a run, and remembers when it wants the run to stop. All need the GIL.
class Callbacks {
public:
  /// `value`: makes the argument; only called if there is something to call.
  template <class MakeValue>
  void call(const py::object& function, const MakeValue& value) {
    if (stop) return;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (function.is_none()) return;
      const py::object answer = function(value());
      leave_if_forked(nullptr);
      py::detail::make_caster<bool> truth; // of a bool, or NumPy's, only
      if (truth.load(answer, false) && !static_cast<bool>(truth)) stop = true;
    } catch (py::error_already_set& raised) {
      leave_if_forked(&raised);
      error = raised.value();
      if (raised.trace()) PyException_SetTraceback(error.ptr(), raised.trace().ptr());
      stop = true;
    }
  }
  std::atomic<bool> stop{false};
  py::object error = py::none();

private:
  const pid_t process_ = getpid();

  /// In a copy of this process, which a callback forked and then came back from: the threads that
  /// the run waits for are not in it, and the files are those of the first process. It ends, with
  /// the code of a SystemExit.
  void leave_if_forked(py::error_already_set* raised) const {
    if (getpid() == process_) return;
    int code = 1;
    if (raised != nullptr && raised->matches(PyExc_SystemExit)) {
      const py::object told = raised->value().attr("code");
      if (told.is_none()) code = 0;
      if (py::isinstance<py::int_>(told)) code = told.cast<int>() & 0xff;
    } else {
      if (raised != nullptr) {
        raised->restore();
        PyErr_Print();
      }
      PySys_WriteStderr(
          "plyform: a callback forked, and the copy came back into the run, which goes "
          "on in the first process only: the copy ends here; end it in the callback, "
          "with os._exit\n");
    }
    for (const char* name : {"stdout", "stderr"})
      if (PyObject* stream = PySys_GetObject(name); stream != nullptr && stream != Py_None) {
        Py_XDECREF(PyObject_CallMethod(stream, "flush", nullptr));
        PyErr_Clear();
      }
    _exit(code);
  }
};

class Simulation {
public:
  Simulation(PreparedCase prepared, int threads) : prepared_(std::move(prepared)) {
    threads_ = threads_or_cores(threads);
    const py::gil_scoped_release others;
    scene_ = std::make_shared<Scene>(make_scene(*prepared_.value, prepared_.meshes, threads_));
  }

  py::object plies() const {
    py::list list;
    for (PlyBody& ply : scene_->plies)
      list.append(py::cast(std::shared_ptr<PlyBody>(scene_, &ply)));
    return parts(list);
  }

  Outcome run(const std::optional<std::filesystem::path>& output, const py::object& progress,
              const py::object& frame) {
    if (std::exchange(used_, true))
      throw std::runtime_error("this simulation has run; make another one of its case");
    std::optional<ResultWriter> writer;
    if (output) writer.emplace(*output);
    Callbacks callbacks;
    RunHooks hooks;
    hooks.progress = [&](const Progress& p) {
      const py::gil_scoped_acquire python;
      if (progress.is_none()) return callbacks.call(progress, [] { return py::none(); });
      const VelocitiesAtPositions now(*scene_);
      callbacks.call(progress, [&] { return py::cast(p); });
    };
    hooks.frame = [&](const Frame& f) {
      // h5py's calls of HDF5, which is not made for threads, are kept out by the GIL too.
      const py::gil_scoped_acquire python;
      if (writer) writer->write_frame(f);
      if (frame.is_none()) return callbacks.call(frame, [] { return py::none(); });
      const VelocitiesAtPositions now(*scene_);
      callbacks.call(frame, [&] { return py::cast(std::make_shared<Frame>(f)); });
    };
    hooks.interrupt = &callbacks.stop;
    RunResult result = [&] {
      const py::gil_scoped_release others;
      return run_prepared(prepared_, *scene_, threads_, hooks);
    }();
    if (result.summary.status != "stopped") VelocitiesAtPositions(*scene_).keep();
    if (writer) writer->write_final(result.last, result.summary);
    const std::string summary = summary_json(result.last, result.summary);
    return {std::make_shared<Frame>(std::move(result.last)), summary, callbacks.error};
  }

  const Scene& scene() const { return *scene_; }
  int threads() const { return threads_; }

private:
  PreparedCase prepared_;
  std::shared_ptr<Scene> scene_;
  int threads_ = 1;
  bool used_ = false;
};

/// form_ply of core/setup/instant.hpp.
Outcome formed_ply(const PreparedCase& prepared, std::size_t ply, int threads,
                   const py::object& progress) {
  if (ply >= prepared.value->plies.size()) throw py::index_error("there is no such ply");
  Callbacks callbacks;
  RunHooks hooks;
  hooks.progress = [&](const Progress& p) {
    const py::gil_scoped_acquire python;
    callbacks.call(progress, [&] { return py::cast(p); });
  };
  hooks.interrupt = &callbacks.stop;
  RunResult result = [&] {
    const py::gil_scoped_release others;
    return form_ply(prepared, ply, threads_or_cores(threads), hooks);
  }();
  const std::string summary = summary_json(result.last, result.summary);
  return {std::make_shared<Frame>(std::move(result.last)), summary, callbacks.error};
}

/// An array of the scene's own.
template <class Part, class Value>
void add_live(py::class_<PlyBody, std::shared_ptr<PlyBody>>& ply, const char* name,
              std::vector<Value> Part::*values, bool writable, const char* doc) {
  ply.def_property_readonly(
      name,
      [values, writable](const py::object& self) {
        return shared_array(self.cast<const PlyBody&>().*values, self, writable);
      },
      doc);
}

void bind_live_ply(py::module_& m) {
  py::class_<PlyBody, std::shared_ptr<PlyBody>> ply(
      m, "LivePly",
      "A ply of a simulation: n nodes, m triangles; its arrays are those computed on.");
  ply.def_property_readonly(
      "name", [](const PlyBody& p) { return p.name; }, "Name in the case.");
  ply.def_property_readonly(
      "angle_deg", [](const PlyBody& p) { return p.angle / degree; },
      "From x to the warp, before forming.");
  ply.def_property_readonly(
      "thickness_mm", [](const PlyBody& p) { return p.thickness; }, "mm, before forming.");
  add_live(ply, "positions", &PlyState::x, true, "float64, (n, 3), mm: where the nodes are.");
  add_live(ply, "velocities", &PlyState::velocity, true,
           "float64, (n, 3), mm/s, at the time of the positions.");
  add_live(ply, "x0", &PlyModel::x0, false, "float64, (n, 3), mm: before forming.");
  ply.def_property_readonly(
      "triangles",
      [](const py::object& self) {
        return shared_array(self.cast<const PlyBody&>().membrane.triangles, self, false);
      },
      "int32, (m, 3): nodes, from 0.");
}

} // namespace

void bind_simulation(py::module_& m) {
  bind_live_ply(m);
  py::class_<Progress>(m, "Progress", "Where a run stands.")
      .def_readonly("fraction", &Progress::fraction, "Of the simulated time, 0 to 1.")
      .def_readonly("stroke_mm", &Progress::stroke_mm, "mm")
      .def_readonly("step", &Progress::step, "Steps taken.")
      .def_readonly("elapsed_s", &Progress::elapsed_s, "s, wall time.")
      .def_readonly("remaining_s", &Progress::remaining_s, "s, wall time, if it goes on like this.")
      .def_readonly("kinetic_over_shear", &Progress::kinetic_over_shear, "Ratio of energies.")
      .def_readonly("balance_error", &Progress::balance_error, "Of the energies, relative.");
  py::class_<Outcome>(m, "Outcome", "What a run has come to.")
      .def_readonly("last", &Outcome::last, "Frame: the last good state.")
      .def_readonly("summary", &Outcome::summary, "The content of summary.json.")
      .def_readonly("error", &Outcome::error, "What a callback raised, or None.");
  py::class_<Simulation>(m, "Simulation", "A scene in motion.")
      .def(py::init<PreparedCase, int>(), py::arg("prepared"), py::arg("threads"),
           "Of a case without mistakes; threads: 0 for as many as there are cores.")
      .def_property_readonly("plies", &Simulation::plies, "LivePly by number or by name.")
      .def_property_readonly("threads", &Simulation::threads, "Number of threads.")
      .def_property_readonly(
          "time_s", [](const Simulation& s) { return s.scene().time; }, "s, simulated so far.")
      .def_property_readonly(
          "step", [](const Simulation& s) { return s.scene().step; }, "Steps taken so far.")
      .def_property_readonly(
          "stroke_mm", [](const Simulation& s) { return current_stroke(s.scene()); },
          "mm, so far, of the first tool, grip or frame driven.")
      .def("run", &Simulation::run, py::arg("output"), py::arg("progress"), py::arg("frame"),
           "Runs to the end. Raises Error.");
  m.def("form_ply", &formed_ply, py::arg("prepared"), py::arg("ply"), py::arg("threads"),
        py::arg("progress"),
        "One ply of a case without mistakes, formed alone; threads: 0 for as many as cores.");
}

} // namespace plyform
