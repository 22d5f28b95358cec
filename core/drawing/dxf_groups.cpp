// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/drawing/dxf_groups.hpp"

#include "base/format.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace plyform {
namespace {

/// Groups without which dxflib would take 0 for a coordinate, a radius or an angle.
const std::map<std::string, std::vector<unsigned int>> required{
    {"LINE", {10, 20, 11, 21}},        {"ARC", {10, 20, 40, 50, 51}}, {"CIRCLE", {10, 20, 40}},
    {"ELLIPSE", {10, 20, 11, 21, 40}}, {"VERTEX", {10, 20}},          {"INSERT", {10, 20}}};

/// A group with a count, and those that follow so often.
struct Count {
  unsigned int code;
  const char* what;
  std::vector<unsigned int> follow;
};

const std::map<std::string, std::vector<Count>> counts{
    {"LWPOLYLINE", {{90, "vertices", {10, 20}}}},
    {"SPLINE", {{72, "knots", {40}}, {73, "control points", {10, 20}}, {74, "fit points", {}}}},
    {"LEADER", {{76, "vertices", {}}}}};

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

bool is_number(std::string value) {
  std::replace(value.begin(), value.end(), ',', '.'); // as dxflib does
  const std::optional<double> number = number_in(trimmed(value));
  return number && std::isfinite(*number);
}

} // namespace

void DxfGroups::add(const std::string& name, unsigned int code, const std::string& value,
                    int line) {
  constexpr long most = 1'000'000; // at 32 bytes each
  ++times_[code];
  if (const auto of = counts.find(name); of != counts.end())
    for (const Count& count : of->second)
      if (count.code == code) {
        counts_[code] = std::atol(value.c_str());
        if (counts_[code] > most)
          throw std::runtime_error(fmt::format("line {} counts {} {} of a {}", line,
                                               shown(value, 30), count.what, name));
      }
  const bool real = (code >= 10 && code < 60) || (code >= 210 && code < 240);
  if (fault_.empty() && real && !is_number(value))
    fault_ = fmt::format("has no finite number in line {}", line);
}

int DxfGroups::times(unsigned int code) const {
  const auto found = times_.find(code);
  return found == times_.end() ? 0 : found->second;
}

std::string DxfGroups::fault_of(const std::string& name) const {
  if (!fault_.empty()) return fault_;
  if (const auto needs = required.find(name); needs != required.end())
    for (const unsigned int code : needs->second)
      if (times(code) == 0) return fmt::format("has no group {}", code);
  if (const auto of = counts.find(name); of != counts.end())
    for (const Count& count : of->second) {
      const auto said = counts_.find(count.code);
      const long number = said == counts_.end() ? 0 : said->second;
      for (const unsigned int code : count.follow)
        if (times(code) != number)
          return fmt::format("counts {} {} (group {}), and group {} follows {} times", number,
                             count.what, count.code, code, times(code));
    }
  return "";
}

void check_dxf_lines(std::string_view content) {
  constexpr std::size_t longest = 1022; // bytes, of dxflib's lines without their end
  bool last = false;
  for (int number = 1; !content.empty(); ++number) {
    const std::size_t end_of_line = std::min(content.find('\n'), content.size());
    std::string_view text = content.substr(0, end_of_line);
    content.remove_prefix(std::min(end_of_line + 1, content.size()));
    if (text.size() > longest)
      throw std::runtime_error("has a line of more than 1000 characters; take long texts out");
    if (text.find('\0') != std::string_view::npos)
      throw std::runtime_error(
          fmt::format("is no text: line {} has a byte 0; save the drawing as ASCII DXF", number));
    if (number == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3); // UTF-8
    text = trimmed(text);
    if (number % 2 == 0) {
      if (last && text == "EOF") return;
      continue;
    }
    int code = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), code);
    if (error != std::errc() || end != text.data() + text.size() || code < -5 || code > 1071)
      throw std::runtime_error(fmt::format(
          "is no DXF file: line {} is no group code; save the drawing as ASCII DXF", number));
    last = code == 0;
  }
}

} // namespace plyform
