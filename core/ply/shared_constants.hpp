// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of a kernel that plies of the same mesh, angle and fabric hold in common: most plies of
// a stack have one like them.
#pragma once

#include <cstring>
#include <memory>
#include <type_traits>
#include <vector>

namespace plyform {

template <class T>
using SharedConstants = std::shared_ptr<const std::vector<T>>;

/// Lets `mine` be the array of `other` if both are the same to the last bit.
template <class T>
void share(SharedConstants<T>& mine, const SharedConstants<T>& other) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (mine->size() == other->size() &&
      std::memcmp(mine->data(), other->data(), mine->size() * sizeof(T)) == 0)
    mine = other;
}

} // namespace plyform
