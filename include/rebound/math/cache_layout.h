// SPDX-License-Identifier: MIT
// How the buffer of caches holds radiance: [cache][coefficient][3] floats. Kernel language, and host code.
#ifndef REBOUND_CACHE_LAYOUT_H
#define REBOUND_CACHE_LAYOUT_H

// From one cache to the next: whole groups of four, which are written at once.
//   bands   minus 2
RB_FUNCTION int floatsOfCache(int bands) { return (3 * (bands + 2) * (bands + 2) + 3) / 4 * 4; }

#endif
