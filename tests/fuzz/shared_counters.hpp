// SPDX-License-Identifier: GPL-3.0-or-later
// Lets a fuzzer see where a file has been read in a process of its own.
#pragma once

#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

// How often each place of the code was passed, from which libFuzzer learns: clang's section, under
// names that the linker gives it (CMakeLists.txt); none in the test that replays the corpus.
extern "C" __attribute__((weak)) std::uint8_t counters_begin[];
extern "C" __attribute__((weak)) std::uint8_t counters_end[];

namespace plyform::fuzz {

/// Has the counters in memory that the process which reads shares with this one.
inline bool share_counters() {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(counters_begin) + page - 1;
  const auto end = reinterpret_cast<std::uintptr_t>(counters_end);
  if (end < begin + page) return false;
  auto* const first = reinterpret_cast<std::uint8_t*>(begin / page * page);
  const std::size_t bytes = (end / page - begin / page) * page;
  const std::string now(first, first + bytes);
  if (mmap(first, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED, -1, 0) ==
      MAP_FAILED)
    throw std::bad_alloc();
  std::memcpy(first, now.data(), bytes);
  return true;
}

} // namespace plyform::fuzz
