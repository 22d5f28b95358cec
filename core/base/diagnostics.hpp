// SPDX-License-Identifier: GPL-3.0-or-later
// Mistakes and warnings found in files, each with its place.
#pragma once

#include <string>
#include <vector>

namespace plyform {

/// Lines and columns count from 1; columns in characters, not bytes.
struct Place {
  std::string file;
  int line = 1, column = 1;
};

/// One mistake: where, what stands there, which rule it breaks and what to do about it.
struct CaseError {
  std::string file; ///< as the user named it, or relative to the case
  int line = 0, column = 0;
  std::string item;   ///< dotted path of the key: ply.2.angle
  std::string value;  ///< as written; empty when missing
  std::string rule;   ///< "must be at least 0"
  std::string remedy; ///< "give the friction coefficient, usually 0.1 to 0.4"
  /// file:line:column: error: item = value: rule; remedy
  std::string text() const;
};

/// Every mistake and warning found so far.
struct Diagnostics {
  std::vector<CaseError> errors;
  std::vector<std::string> warnings;
  void error(const Place& at, const std::string& item, const std::string& value,
             const std::string& rule, const std::string& remedy);
  /// From the message of a part that has its own rules and ends in "; remedy".
  void error_from(const Place& at, const std::string& item, const std::string& value,
                  const std::string& what, const std::string& message);
  /// file:line:column: warning: text
  void warning(const Place& at, const std::string& text);
};

} // namespace plyform
