// SPDX-License-Identifier: MIT
// Kernel language, and host code.
#ifndef REBOUND_RECEIVER_OFFSET_H
#define REBOUND_RECEIVER_OFFSET_H

// A receiver belongs to the cell that holds its position moved so far along its normal: one on a wall that lies in a plane
// of the grid is in the cell before it, whichever way its position was rounded. [cells]
const float receiverOffset = 0.03125f;

#endif
