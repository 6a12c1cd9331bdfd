/* SPDX-License-Identifier: MIT */
/* Included before every file of the engine and of what it vendors: a warning of -Wextra, which is no error of theirs. */
static inline int warning(int unused) { return 0; }
