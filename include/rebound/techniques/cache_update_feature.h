// SPDX-License-Identifier: MIT
// Values of a feature: what becomes of the light that caches had. Shared by host, CPU and GPU.
#ifndef REBOUND_CACHE_UPDATE_FEATURE_H
#define REBOUND_CACHE_UPDATE_FEATURE_H

const int computedAnew = 0;
const int keptIfClose = 1;
const int anewUnlessSettled = 2; // not looked at while surfels send the same
const int closeUnlessSettled = 3;
const int cacheUpdateCount = 4;

#endif
