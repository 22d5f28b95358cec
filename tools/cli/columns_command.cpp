// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "core/model/ply_frame.hpp"
#include "tools/cli/commands.hpp"

#include <stdexcept>

namespace plyform {

int columns_command(const std::vector<std::string>& families) {
  PlyFrame ply;
  for (const std::string& name : families)
    ply.families.push_back({name, 0.0, {}, {}, {}});
  const std::string twice = name_used_twice(ply);
  if (!twice.empty())
    throw std::invalid_argument(
        fmt::format("two columns would be called {}: give a family another name", twice));
  fmt::print("name,word,label,unit,place,numbers\n");
  each_column(ply, []<class Value>(const Column& column, const std::vector<Value>&) {
    fmt::print("{},{},{},{},{},{}\n", column.name, column.word, column.label, column.unit,
               word_of(column.location), sizeof(Value) / sizeof(double));
  });
  return exit_done;
}

} // namespace plyform
