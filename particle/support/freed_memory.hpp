#pragma once

#include <malloc.h>

namespace surge {

/// Makes the C library keep what is freed for the next who asks for memory. By itself it hands the
/// end of what it has back to the system and soon asks for it again: a thread that writes frames did
/// so for every block that it compressed, and each time all cores had to forget addresses. A fifth
/// of the processor time of a run of two thousand particles went there.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int mebibyte = 1 << 20;
  mallopt(M_TRIM_THRESHOLD, 256 * mebibyte);
  mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);  // the most that it takes
#endif
}

}  // namespace surge
