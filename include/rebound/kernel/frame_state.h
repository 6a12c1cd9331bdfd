// SPDX-License-Identifier: MIT
// What kernels know of the frames before; shared by host, CPU and GPU (std140). Filled by the device.
#ifndef REBOUND_FRAME_STATE_H
#define REBOUND_FRAME_STATE_H

struct FrameState {
    // .x 1: history images and persistent buffers hold what the frame before has left; 0: zeros, in the first frame and
    // after Program::reset(). .y frames since they held zeros, 0 to 2^30.
    ivec4 history;
};

#endif
