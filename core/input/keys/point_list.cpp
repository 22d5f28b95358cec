// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/point_list.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Assembles a chain from runs of points, rounded where they have fillets, and arcs between them.
struct ChainReader {
  const TomlNode& list;
  const std::string& item;
  const PointWords& words;
  Diagnostics& diagnostics;
  Profile chain{};
  std::vector<std::array<double, 3>> run{}; ///< points of the current polyline
  std::vector<std::size_t> run_entries{};   ///< their numbers in the list

  bool is_arc(std::size_t i) const { return list.children[i].kind == TomlNode::Kind::table; }
  void fail(std::size_t i, const std::string& rule, const std::string& remedy) {
    const TomlNode& at = list.children[i];
    diagnostics.error(at.at, fmt::format("{}.{}", item, i), at.source_text, rule, remedy);
  }
  Vec2 point_of(std::size_t i, const char* key) const {
    const TomlNode* pair = list.children[i].find(key);
    return {pair->children[0].number, pair->children[1].number};
  }
  std::array<double, 3> corner(std::size_t i) const;
  bool append(const std::vector<std::array<double, 3>>& points, bool closed);
  void entry(std::size_t i);
  void arc(std::size_t i);
  void finish_run();
};

std::array<double, 3> ChainReader::corner(std::size_t i) const {
  const std::vector<TomlNode>& numbers = list.children[i].children;
  return {numbers[0].number, numbers[1].number, numbers.size() > 2 ? numbers[2].number : 0.0};
}

bool ChainReader::append(const std::vector<std::array<double, 3>>& points, bool closed) {
  try {
    const Profile part = round_corners(points, closed, words);
    chain.insert(chain.end(), part.begin(), part.end());
    return true;
  } catch (const std::exception& error) {
    diagnostics.error_from(list.at, item, list.source_text, "", error.what());
    return false;
  }
}

/// Appends the current polyline to the chain; a fillet needs a line on both sides.
void ChainReader::finish_run() {
  for (const std::size_t end : {std::size_t{0}, run.size() - 1})
    if (run[end][2] != 0.0)
      return fail(run_entries[end], "rounds a corner that has no straight line on both sides",
                  "take the third number out, or give the rounding as an arc");
  if (run.size() > 1) append(run, false);
}

/// Appends an arc {to, centre, turn = "left" or "right"} from the last point.
void ChainReader::arc(std::size_t i) {
  const Vec2 a(run.back()[0], run.back()[1]), b = point_of(i, "to"), centre = point_of(i, "centre");
  const double radius = (a - centre).norm();
  constexpr double tolerance = 1e-3; // of the radius: numbers rounded to some digits
  if (!(std::abs((b - centre).norm() - radius) <= tolerance * radius) || !(radius > 0.0))
    return fail(i,
                fmt::format("is no arc: its start is {:g} mm from the centre, its end {:g} mm",
                            radius, (b - centre).norm()),
                "correct centre or to: both must have one distance");
  finish_run();
  const int turn = list.children[i].find("turn")->text == "left" ? 1 : -1;
  chain.push_back({ProfileSegment::Kind::arc, a, b, centre, turn});
  run = {{b.x(), b.y(), 0.0}};
  run_entries = {i};
}

void ChainReader::entry(std::size_t i) {
  if (is_arc(i)) return arc(i);
  run.push_back(corner(i));
  run_entries.push_back(i);
}

} // namespace

Profile read_points(const TomlNode& list, const std::string& item, const PointWords& words,
                    bool closed, Diagnostics& diagnostics) {
  ChainReader reader{list, item, words, diagnostics};
  const std::size_t n = list.children.size(), errors = diagnostics.errors.size();
  if (reader.is_arc(0)) {
    reader.fail(0, "is an arc without a point before it",
                fmt::format("start with a point [{}, {}]", words.first, words.second));
    return {};
  }
  std::size_t first_arc = 0;
  while (first_arc < n && !reader.is_arc(first_arc))
    ++first_arc;
  if (!closed || first_arc == n) {
    for (std::size_t i = 0; i < n && diagnostics.errors.size() == errors; ++i)
      reader.entry(i);
    if (diagnostics.errors.size() > errors) return reader.chain;
    if (closed)
      reader.append(reader.run, true);
    else
      reader.finish_run();
    return reader.chain;
  }
  // Once round from the end of the first arc to the same arc, so that each run has both its ends.
  const Vec2 start = reader.point_of(first_arc, "to");
  reader.run = {{start.x(), start.y(), 0.0}};
  reader.run_entries = {first_arc};
  for (std::size_t k = 1; k <= n && diagnostics.errors.size() == errors; ++k) {
    const std::size_t i = (first_arc + k) % n;
    if (const auto& last = reader.run.back();
        i == 0 && reader.is_arc(n - 1) && reader.corner(0) == std::array{last[0], last[1], 0.0})
      continue; // the last arc ends where the outline begins
    reader.entry(i);
  }
  return reader.chain;
}

} // namespace plyform
