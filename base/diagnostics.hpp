// SPDX-License-Identifier: GPL-3.0-or-later
// Errors and warnings found in files, each with its position there.
#pragma once

#include <string>
#include <vector>

namespace plyform {

/// Lines and columns count from 1; columns in characters, not bytes.
struct Place {
  std::string file;
  int line = 1, column = 1;
};

/// One error: its position, the value found, the rule that it breaks and the remedy.
struct CaseError {
  std::string file; ///< as the user named it, or relative to the case
  int line = 0, column = 0;
  std::string item;   ///< dotted path of the key: ply.2.angle
  std::string value;  ///< as written; empty when missing
  std::string rule;   ///< "must be at least 0"
  std::string remedy; ///< "give the friction coefficient, usually 0.1 to 0.4"
  /// file:line:column: error: item = value: rule; remedy; printable, whatever stands in the file
  std::string text() const;
};

/// All errors and warnings found so far.
struct Diagnostics {
  std::vector<CaseError> errors;
  std::vector<std::string> warnings;
  void error(const Place& at, const std::string& item, const std::string& value,
             const std::string& rule, const std::string& remedy);
  /// Adds an error from `message`, "rule; remedy", of a module with its own checks; `what` is put
  /// before the rule. Without "; " a general remedy is used.
  void error_from(const Place& at, const std::string& item, const std::string& value,
                  const std::string& what, const std::string& message);
  /// file:line:column: warning: text
  void warning(const Place& at, const std::string& text);
};

} // namespace plyform
