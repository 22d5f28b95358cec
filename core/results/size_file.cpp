// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/size_file.hpp"

#include "base/format.hpp"
#include "base/read_file.hpp"
#include "base/words.hpp"
#include "base/write_whole.hpp"

#include <cmath>
#include <iterator>
#include <stdexcept>

namespace plyform {
namespace {

constexpr std::string_view size_file_head = "plyform mesh sizes 1";
constexpr double most_points_a_way = 10000.0;

/// The lines and words of a file, in turn.
class Lines {
public:
  Lines(std::string text, std::filesystem::path file)
      : text_(std::move(text)), left_(text_), file_(std::move(file)) {}

  bool next() {
    if (left_.empty()) return false;
    const std::size_t end = std::min(left_.find('\n'), left_.size());
    line_ = left_.substr(0, end);
    left_.remove_prefix(std::min(end + 1, left_.size()));
    ++number_;
    return true;
  }

  std::string_view rest() const { return line_; }

  std::string_view word() {
    const std::size_t end = std::min(line_.find(' '), line_.size());
    const std::string_view found = line_.substr(0, end);
    line_.remove_prefix(std::min(end + 1, line_.size()));
    return found;
  }

  /// A number between least and most.
  double number(double least, double most) {
    const std::string_view found = word();
    const std::optional<double> value = number_in(found);
    if (!value || !(*value >= least && *value <= most))
      fail(fmt::format("\"{}\" is no number from {:g} to {:g}", shown(found), least, most));
    return *value;
  }

  int count() {
    const double value = number(1.0, most_points_a_way);
    if (value != std::floor(value)) fail("the size of a grid is no whole number");
    return static_cast<int>(value);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(
        fmt::format("{}:{}: {}; run the case that wrote it again", file_.string(), number_, what));
  }

private:
  std::string text_;
  std::string_view left_, line_;
  std::filesystem::path file_;
  int number_ = 0;
};

PlySizes read_ply(Lines& lines) {
  constexpr double far = 1e9, largest = 1e6; // mm
  if (lines.word() != "ply") lines.fail("a line that begins with \"ply\" should stand here");
  PlySizes ply;
  SizeGrid& grid = ply.sizes;
  grid.origin.x() = lines.number(-far, far);
  grid.origin.y() = lines.number(-far, far);
  grid.spacing = lines.number(1e-9, largest);
  grid.columns = lines.count();
  grid.rows = lines.count();
  ply.ply = lines.rest();
  for (int row = 0; row < grid.rows; ++row) {
    if (!lines.next()) lines.fail("the file ends before its sizes do");
    for (int column = 0; column < grid.columns; ++column)
      grid.size.push_back(lines.number(1e-9, largest));
  }
  return ply;
}

} // namespace

std::string text_of(const std::vector<PlySizes>& plies) {
  std::string text = fmt::format("{}\n", size_file_head);
  for (const PlySizes& ply : plies) {
    const SizeGrid& g = ply.sizes;
    fmt::format_to(std::back_inserter(text), "ply {} {} {} {} {} {}\n", g.origin.x(), g.origin.y(),
                   g.spacing, g.columns, g.rows, ply.ply);
    for (std::size_t i = 0; i < g.size.size(); ++i)
      fmt::format_to(std::back_inserter(text), "{}{}", g.size[i],
                     (i + 1) % static_cast<std::size_t>(g.columns) == 0 ? "\n" : " ");
  }
  return text;
}

void write_sizes(const std::filesystem::path& file, const std::vector<PlySizes>& plies) {
  write_whole(file, text_of(plies));
}

std::vector<PlySizes> read_sizes(const std::filesystem::path& path) {
  std::error_code none;
  const std::filesystem::path file =
      std::filesystem::is_directory(path, none) ? path / size_file_name : path;
  std::string reason;
  std::optional<std::string> text = read_file(file, most_mesh_bytes, reason);
  if (!text)
    throw std::runtime_error(
        fmt::format("{} {}; element sizes are in the folder of a run whose mesh_from is \"scene\"",
                    file.string(), reason));
  Lines lines(*std::move(text), file);
  if (!lines.next() || lines.rest() != size_file_head)
    lines.fail("is no file of element sizes of this program");
  std::vector<PlySizes> plies;
  while (lines.next())
    plies.push_back(read_ply(lines));
  return plies;
}

} // namespace plyform
