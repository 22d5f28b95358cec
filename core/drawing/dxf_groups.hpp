// SPDX-License-Identifier: GPL-3.0-or-later
// What dxflib would read as another drawing without a word.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace plyform {

/// Throws std::runtime_error ("rule; remedy", with the line) where dxflib would lose the pairs of
/// lines, a group code and its value: it cuts lines of more than a thousand characters in two, ends
/// them at a byte 0, and takes words for code 0.
void check_dxf_lines(std::string_view content);

/// Groups of one entity as they pass. dxflib takes 0 for a number that is missing or none, and as
/// many points as are counted.
class DxfGroups {
public:
  /// A group of the entity `name`, its value in that line of the file. Throws std::runtime_error
  /// for counts for which dxflib would take much memory at once.
  void add(const std::string& name, unsigned int code, const std::string& value, int line);

  /// Why the entity is not what dxflib makes of it; empty if it is.
  std::string fault_of(const std::string& name) const;

private:
  int times(unsigned int code) const;

  std::map<unsigned int, int> times_;   ///< how often each code has passed
  std::map<unsigned int, long> counts_; ///< what the codes of counts say
  std::string fault_;
};

} // namespace plyform
