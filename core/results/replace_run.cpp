// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/replace_run.hpp"

#include "base/format.hpp"
#include "base/outputs.hpp"
#include "base/write_whole.hpp"
#include "core/results/size_file.hpp"

#include <stdexcept>

namespace plyform {

namespace fs = std::filesystem;

namespace {

void remove_results(const fs::path& folder) {
  for (const fs::path& file : files_of_run(folder)) {
    std::error_code error;
    fs::remove(folder / file, error);
    if (error) throw_cannot(folder / file, "remove the file of a former run", error);
  }
}

void move_results(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to / "plies", error);
  if (error) throw_cannot(to, "create the result folder", error);
  for (const fs::path& file : files_of_run(from)) {
    fs::rename(from / file, to / file, error);
    if (error) throw_cannot(from / file, "move the file", error);
  }
}

} // namespace

std::vector<fs::path> files_of_run(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const char* name :
       {"summary.json", "history.csv", "results.xdmf", "results.h5", size_file_name})
    if (fs::exists(folder / name, error)) files.emplace_back(name);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "plies", error))
    if (entry.is_regular_file() && entry.path().extension() == ".csv")
      files.push_back(fs::path("plies") / entry.path().filename());
  return files;
}

void replace_run(const fs::path& folder, const fs::path& second, const fs::path& former) {
  keep_out_of_link(former);
  keep_out_of_link(former / "plies");
  remove_results(former);
  move_results(folder, former);
  move_results(second, folder);
  std::error_code error;
  fs::remove(second / "plies", error);
  fs::remove(second, error);
  if (error) throw_cannot(second, "remove the folder", error);
}

} // namespace plyform
