// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/diagnostics.hpp"

#include "base/format.hpp"
#include "base/words.hpp"

namespace plyform {

std::string CaseError::text() const {
  const std::string equals = value.empty() ? "" : " = " + value;
  const std::string subject = item.empty() ? "" : item + equals + ": ";
  return printable(
      fmt::format("{}:{}:{}: error: {}{}; {}", file, line, column, subject, rule, remedy));
}

void Diagnostics::error(const Place& at, const std::string& item, const std::string& value,
                        const std::string& rule, const std::string& remedy) {
  constexpr std::size_t key = 200, short_text = 100, long_text = 2000; // characters, at most
  errors.push_back({at.file, at.line, at.column, shown(item, key), shown(value, short_text),
                    shown(rule, long_text), shown(remedy, long_text)});
}

void Diagnostics::error_from(const Place& at, const std::string& item, const std::string& value,
                             const std::string& what, const std::string& message) {
  const std::size_t cut = message.rfind("; ");
  const bool has_remedy = cut != std::string::npos;
  error(at, item, value, what + message.substr(0, cut),
        has_remedy ? message.substr(cut + 2) : "correct it or take it out");
}

void Diagnostics::warning(const Place& at, const std::string& text) {
  warnings.push_back(
      printable(fmt::format("{}:{}:{}: warning: {}", at.file, at.line, at.column, text)));
}

} // namespace plyform
