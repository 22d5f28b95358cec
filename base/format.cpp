// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"

fmt::format_parse_context::iterator
fmt::formatter<plyform::ToldNumber>::parse_then(format_parse_context& context) {
  return number.parse(context);
}

fmt::format_context::iterator
fmt::formatter<plyform::ToldNumber>::format(plyform::ToldNumber told,
                                            format_context& context) const {
  if (std::isfinite(told.value)) return number.format(told.value, context);
  return fmt::format_to(context.out(), "{}", told.word());
}
