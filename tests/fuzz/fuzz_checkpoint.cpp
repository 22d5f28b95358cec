// SPDX-License-Identifier: GPL-3.0-or-later
// A checkpoint with fields changed and its size and checksum made right again: refused with
// std::runtime_error, or a scene that is computed on. The bytes are the changes, twelve of each:
// where (4), how (1), by what (7), so that seeds do not depend on the layout of a checkpoint.
#include "core/results/checkpoint_file.hpp"
#include "core/run/checkpoint.hpp"
#include "core/setup/prepare_case.hpp"
#include "core/solver/step.hpp"
#include "fuzz/fuzz_file.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace plyform::fuzz {
namespace {

/// Two plies between a punch and a floor from a mesh, held by a grip and a spring.
PreparedCase small_case() {
  static const std::string off =
      "OFF\n8 12 0\n-50 -50 -9\n50 -50 -9\n50 50 -9\n-50 50 -9\n-50 -50 0\n50 -50 0\n50 50 0\n"
      "-50 50 0\n3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n"
      "3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";
  static const std::string text =
      "[fabrics.f]\nsurface_density = 600.0\nthickness = 0.6\nwarp = {density = 0.25, stiffness = "
      "460.0, bending_stiffness = 1.0}\nweft = {density = 0.25, stiffness = 460.0, "
      "bending_stiffness = 1.0}\nshear = {polynomial = [0.37, -0.84, 1.03]}\n"
      "[blanks.b]\nsize = [60.0, 60.0]\nelement_size = 20.0\n"
      "[[ply]]\nname = \"a\"\nfabric = \"f\"\nblank = \"b\"\nangle = 0.0\n"
      "[[ply]]\nname = \"c\"\nfabric = \"f\"\nblank = \"b\"\nangle = 45.0\n"
      "[[tool]]\nname = \"floor\"\nshape = \"mesh\"\nfile = \"floor.off\"\n"
      "[[tool]]\nname = \"punch\"\nshape = \"sphere\"\nradius = 20.0\nposition = [0.0, 0.0, "
      "21.2]\nmotion = \"driven\"\nstroke = 0.5\n"
      "[[boundary]]\nname = \"grip\"\nkind = \"grip\"\nply = \"a\"\nbox = [[-31.0, -31.0], "
      "[-29.0, 31.0]]\n"
      "[solver]\nduration = 0.01\n";
  put("floor.off", reinterpret_cast<const std::uint8_t*>(off.data()), off.size());
  return prepare_case(
      put("checkpointed.toml", reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
      {});
}

struct Saved {
  Case data;
  std::vector<BlankMesh> meshes;
  std::string file; ///< all of a checkpoint
};

/// A checkpoint some steps on.
Saved saved_run() {
  PreparedCase prepared = small_case();
  if (!prepared.value) {
    for (const CaseError& error : prepared.errors)
      std::fprintf(stderr, "%s\n", error.text().c_str());
    std::abort();
  }
  Saved saved{*prepared.value, prepared.meshes, {}};
  ThreadPool pool(1);
  Scene scene = make_scene(saved.data, saved.meshes);
  start(scene, pool);
  for (int i = 0; i < 60; ++i) {
    if (compute_forces(scene, pool)) std::abort();
    move_plies(scene, pool);
  }
  RunState run;
  keep(scene, run.energy, run.good);
  run.outputs_written = 0;
  WriterState writer;
  writer.states = {{"a", "c"},
                   {"floor", "punch"},
                   {"grip"},
                   {0.0},
                   {0.0},
                   {0},
                   "a/16/18\nc/16/18\ntools\nfloor/8/12\npunch/9/9\nboundaries\ngrip\n"};
  writer.history = "head\nrow\n";
  writer.xdmf = {{"a", "c", "floor", "punch"}, {"1", "2", "3", "4"}};
  const auto path = folder() / "checkpoint";
  write_checkpoint_file(path, "case", writer, save_state(scene, run));
  std::ifstream in(path, std::ios::binary);
  saved.file.assign(std::istreambuf_iterator<char>(in), {});
  return saved;
}

/// Changes one field of `bytes`.
void change(std::string& bytes, const std::uint8_t* by) {
  constexpr double doubles[] = {std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity(),
                                1e300,
                                -1e300,
                                1e10,
                                -1.0,
                                0.0,
                                1e-300};
  if (bytes.size() < 16) return;
  std::uint32_t place = 0;
  std::memcpy(&place, by, sizeof place);
  const std::size_t at = place % (bytes.size() - 8);
  std::int32_t whole = 0;
  std::memcpy(&whole, by + 5, sizeof whole);
  const std::int64_t wide = whole;
  switch (by[4] % 8) {
  case 0:
    bytes[at] = static_cast<char>(by[5]);
    break;
  case 1:
    std::memcpy(&bytes[at], &whole, sizeof whole);
    break;
  case 2:
    std::memcpy(&bytes[at / 4 * 4], &whole, sizeof whole);
    break;
  case 3:
    std::memcpy(&bytes[at / 4 * 4], &wide, sizeof wide);
    break;
  case 4:
    std::memcpy(&bytes[at / 4 * 4], &doubles[by[5] % std::size(doubles)], 8);
    break;
  case 5:
    bytes.resize(at);
    break;
  case 6:
    bytes.insert(at, bytes.substr(at, by[5]));
    break;
  default:
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << by[5] % 8));
    break;
  }
}

} // namespace
} // namespace plyform::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plyform;
  static const auto& saved = *new fuzz::Saved(fuzz::saved_run());
  constexpr std::size_t record = 12;
  const std::size_t first = saved.file.find('\n') + 1, head = first + 2 * sizeof(std::uint64_t);
  std::string rest = saved.file.substr(head);
  for (std::size_t at = 0; at + record <= std::min(size, 8 * record); at += record)
    fuzz::change(rest, data + at);
  const std::uint64_t bytes = rest.size(), sum = checkpoint_sum(rest);
  std::string file = saved.file.substr(0, first) + std::string(16, '\0') + rest;
  std::memcpy(&file[first], &bytes, sizeof bytes);
  std::memcpy(&file[first + 8], &sum, sizeof sum);
  const auto path =
      fuzz::put("checkpoint", reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  try {
    const std::optional<Checkpoint> found = read_checkpoint_file(path, "case");
    if (!found) std::abort();
    if (found->writer.xdmf.document().empty()) std::abort();
    ThreadPool pool(1);
    Scene scene = make_scene(saved.data, saved.meshes);
    RunState run;
    load_state(found->solver, scene, run);
    for (int i = 0; i < 4 && !compute_forces(scene, pool); ++i)
      move_plies(scene, pool);
  } catch (const std::runtime_error& refused) {
    if (*refused.what() == '\0' || size < record) std::abort(); // as it was, it is accepted
  }
  return 0;
}
