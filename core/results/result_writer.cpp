// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/result_writer.hpp"

#include "base/format.hpp"
#include "base/names.hpp"
#include "base/outputs.hpp"
#include "base/text.hpp"
#include "base/thread_pool.hpp"
#include "base/write_whole.hpp"
#include "core/results/checkpoint_file.hpp"
#include "core/results/folder_lock.hpp"
#include "core/results/result_fields.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/compile.h>
#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>
#include <system_error>

namespace plyform {

namespace fs = std::filesystem;

// What a frame must satisfy before anything is written.

namespace {

void check_name(const std::string& name, const char* kind) {
  if (const std::string fault = fault_of_file_name(name); !fault.empty())
    throw std::runtime_error(
        fmt::format("{} name \"{}\" cannot be a file name: it {}; rename the {} in the case file",
                    kind, shown(name), fault, kind));
}

void check_columns(const PlyFrame& ply) {
  for (const Column& column : columns_of(ply))
    check_name(column.name, "column");
  if (const std::string name = name_used_twice(ply); !name.empty())
    throw std::runtime_error(
        fmt::format("ply \"{}\": two of its columns would be called {}; rename the family in the "
                    "fabric file",
                    ply.name, shown(name)));
}

void check_sizes(const PlyFrame& ply) {
  const std::size_t n = ply.x0.size(), m = ply.triangles.size();
  bool fits = ply.x.size() == n;
  each_column(ply, [&](const Column& column, const auto& values) {
    fits = fits && ((column.may_lack && values.empty()) ||
                    values.size() == (column.location == Location::node ? n : m));
  });
  if (!fits)
    throw std::logic_error(fmt::format(
        "ply \"{}\": an array has not one entry for each of its {} nodes or {} triangles", ply.name,
        n, m));
}

} // namespace

void check_frame(const Frame& frame) {
  // unique among plies and tools, as files and blocks are named after them
  std::set<std::string> names;
  const auto take = [&](const std::string& name, const char* kind) {
    check_name(name, kind);
    if (!names.insert(name).second)
      throw std::runtime_error(
          fmt::format("{} name \"{}\" is used twice: every ply and tool needs a name of its own, "
                      "because the result files are named by it; rename one in the case file",
                      kind, name));
  };
  for (const PlyFrame& ply : frame.plies) {
    take(ply.name, "ply");
    check_columns(ply);
    check_sizes(ply);
  }
  for (const ToolFrame& tool : frame.tools)
    take(tool.name, "tool");
  for (const BoundaryFrame& boundary : frame.boundaries)
    take(boundary.name, "boundary");
}

// The tables.

namespace {

using Buffer = fmt::memory_buffer;

void put(Buffer& out, double value) {
  fmt::format_to(std::back_inserter(out), FMT_COMPILE("{:.9g},"), value);
}

void put(Buffer& out, const Vec3& v) {
  fmt::format_to(std::back_inserter(out), FMT_COMPILE("{:.9g},{:.9g},{:.9g},"), v.x(), v.y(),
                 v.z());
}

void end_row(Buffer& out) {
  out.data()[out.size() - 1] = '\n';
} // replaces the last comma

Vec3 centroid(const std::vector<Vec3>& x, const Triangle& t) {
  return (x[t[0]] + x[t[1]] + x[t[2]]) / 3;
}

/// A column heading; one with a comma in quotes (names hold no quotes, see check_name).
std::string heading(const std::string& text) {
  return text.find(',') == std::string::npos ? text : fmt::format("\"{}\"", text);
}

/// Of the numbers of a value.
template <class Value>
std::vector<std::string> headings_of(const std::string& name) {
  if constexpr (std::is_same_v<Value, Vec3>)
    return {name + "_x", name + "_y", name + "_z"};
  else
    return {name};
}

std::string history_header(const std::vector<Series>& history) {
  Buffer out;
  for (const Series& series : history)
    if (series.what.in_table)
      fmt::format_to(std::back_inserter(out), "{},", heading(series.heading()));
  end_row(out);
  return fmt::to_string(out);
}

std::string history_row(const std::vector<Series>& history) {
  Buffer out;
  for (const Series& series : history)
    if (series.what.in_table) put(out, series.values.back());
  end_row(out);
  return fmt::to_string(out);
}

} // namespace

std::string ply_table(const PlyFrame& ply) {
  Buffer out;
  out.append(std::string_view("x0,y0,z0,x,y,z,"));
  std::vector<std::function<void(std::size_t)>> cells; // of a row
  each_column(ply, [&]<class Value>(const Column& column, const std::vector<Value>& values) {
    if (column.location != Location::triangle || (column.may_lack && values.empty())) return;
    for (const std::string& name : headings_of<Value>(column.name))
      fmt::format_to(std::back_inserter(out), "{},", heading(name));
    cells.emplace_back([&out, &values](std::size_t i) { put(out, values[i]); });
  });
  end_row(out);
  for (std::size_t i = 0; i < ply.triangles.size(); ++i) {
    put(out, centroid(ply.x0, ply.triangles[i]));
    put(out, centroid(ply.x, ply.triangles[i]));
    for (const auto& cell : cells)
      cell(i);
    end_row(out);
  }
  return fmt::to_string(out);
}

// The folder.

namespace {

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error)
    throw std::runtime_error(fmt::format("{}: cannot remove the file of a former run: {}",
                                         path.string(), error.message()));
}

/// Removes results of a former run that this one might not overwrite, so that a folder never has
/// the states of one run and the summary of another. Removes only files that runs write.
void remove_former_run(const fs::path& directory) {
  remove_file(directory / "summary.json");
  remove_file(directory / "history.csv");
  remove_file(directory / "results.xdmf");
  remove_file(directory / "results.h5");
  remove_file(directory / size_file_name);
  remove_file(directory / "checkpoint");
  remove_states(directory);
  std::vector<fs::path> tables;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory / "plies")) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() && (name.ends_with(".csv") || name.ends_with(".csv.tmp")))
      tables.push_back(entry.path());
  }
  for (const fs::path& table : tables)
    remove_file(table);
}

/// Throws WouldOverwrite if the files that a run removes and writes are not all of one.
void check_former_run(const fs::path& directory) {
  keep_out_of_link(directory / "plies");
  keep_foreign(directory / "summary.json", "\"wall_time_s\"");
  keep_foreign(directory / "history.csv", "time_s,stroke_mm");
  keep_foreign(directory / "results.xdmf", "<Grid Name=\"plyform\"");
  keep_foreign(directory / "results.h5", "plyform_version");
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory / "plies", ignored))
    if (entry.path().extension() == ".csv") keep_foreign(entry.path(), "x0,y0,z0,x,y,z");
}

/// Creates the folder of a run; returns its path.
fs::path make_folder(const fs::path& directory) {
  check_former_run(directory);
  const fs::path plies = directory / "plies";
  std::error_code error;
  fs::create_directories(plies, error);
  if (!error && !fs::is_directory(plies)) error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw std::runtime_error(fmt::format("{}: cannot create the result folder: {}",
                                         directory.string(), error.message()));
  return directory;
}

/// Makes the texts of as many plies at a time as there are threads, and writes one after the other.
void write_ply_tables(const fs::path& folder, const std::vector<PlyFrame>& plies, int threads) {
  ThreadPool pool(threads);
  std::vector<std::string> texts(static_cast<std::size_t>(threads));
  for (std::size_t first = 0; first < plies.size(); first += texts.size()) {
    const std::size_t count = std::min(texts.size(), plies.size() - first);
    pool.run(static_cast<int>(count), [&](int i) {
      texts[static_cast<std::size_t>(i)] = ply_table(plies[first + static_cast<std::size_t>(i)]);
    });
    for (std::size_t i = 0; i < count; ++i)
      write_whole(folder / (plies[first + i].name + ".csv"), texts[i]);
  }
}

} // namespace

struct ResultWriter::Impl {
  explicit Impl(const fs::path& folder)
      : directory(make_folder(folder)), lock(directory), states(directory) {
    std::error_code ignored; // of a run that was killed: nobody else writes here now
    fs::remove(directory / progress_file_name, ignored);
  }

  fs::path directory;
  FolderLock lock;
  StateFiles states;
  std::string history; ///< all of history.csv so far
  XdmfText xdmf;
  std::vector<PlySizes> sizes; ///< of meshes from the scene
  double last_time = 0;
  long last_step = 0;
};

ResultWriter::ResultWriter(const fs::path& directory) : impl_(new Impl(directory)) {}

ResultWriter::~ResultWriter() = default;

void ResultWriter::keep_sizes(std::vector<PlySizes> sizes) {
  impl_->sizes = std::move(sizes);
}

std::size_t ResultWriter::states() const {
  return impl_->states.frames();
}

void ResultWriter::write_frame(const Frame& frame) {
  check_frame(frame);
  if (impl_->states.frames() == 0) {
    remove_former_run(impl_->directory);
    if (!impl_->sizes.empty()) write_sizes(impl_->directory / size_file_name, impl_->sizes);
  }
  const std::size_t index = impl_->states.frames();
  impl_->states.append(frame);
  const std::vector<Series>& history = impl_->states.index().history;
  if (index == 0) impl_->history = history_header(history);
  impl_->history += history_row(history);
  impl_->xdmf.add(frame, index);
  impl_->last_time = frame.time;
  impl_->last_step = frame.step;
  write_whole(impl_->directory / "results.xdmf", impl_->xdmf.document());
  write_whole(impl_->directory / "history.csv", impl_->history);
}

void ResultWriter::write_checkpoint(const std::string& identity, const std::string& state) {
  Impl& my = *impl_;
  write_checkpoint_file(my.directory / "checkpoint", identity,
                        {my.states.index(), my.history, my.xdmf, my.last_time, my.last_step},
                        state);
}

std::optional<Resume> ResultWriter::go_on(const std::string& identity) {
  Impl& my = *impl_;
  const std::optional<Checkpoint> found =
      read_checkpoint_file(my.directory / "checkpoint", identity);
  if (!found) {
    std::error_code ignored;
    if (fs::exists(my.directory / "summary.json", ignored))
      remove_states(my.directory); // killed then
    return std::nullopt;
  }
  const WriterState& written = found->writer;
  remove_file(my.directory / "summary.json"); // of the interrupted run
  my.states.go_on(written.states);
  my.history = written.history;
  my.xdmf = written.xdmf;
  my.last_time = written.last_time;
  my.last_step = written.last_step;
  write_whole(my.directory / "results.xdmf", my.xdmf.document());
  write_whole(my.directory / "history.csv", my.history);
  Resume resume{found->solver, read_last_frame(my.directory / "results.h5")};
  if (resume.last.time != written.last_time || resume.last.step != written.last_step)
    throw std::runtime_error(fmt::format(
        "{}: its last state is not that of the checkpoint, so that the run cannot go on; run it "
        "anew, without --resume",
        (my.directory / state_file(written.states.step.size() - 1)).string()));
  return resume;
}

void ResultWriter::write_summary(const Frame& last, const Summary& summary) {
  write_whole(impl_->directory / "summary.json", summary_json(last, summary));
}

void ResultWriter::write_final(const Frame& last, const Summary& summary) {
  Impl& my = *impl_;
  const bool written =
      my.states.frames() > 0 && last.time == my.last_time && last.step == my.last_step;
  // If the run stopped between two outputs: results.h5 must end with the same state as the tables.
  if (!written) write_frame(last);
  write_ply_tables(my.directory / "plies", last.plies, std::max(summary.threads, 1));
  const bool goes_on = summary.status == "interrupted" && fs::exists(my.directory / "checkpoint");
  if (!goes_on) my.states.merge();
  write_summary(last, summary); // when all other files are complete
  if (goes_on) return;
  // In this order the run can go on until it has ended, wherever it is killed.
  remove_file(my.directory / "checkpoint");
  remove_states(my.directory);
}

} // namespace plyform
