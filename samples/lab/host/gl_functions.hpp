// SPDX-License-Identifier: MIT
// OpenGL as samples and tests call it: linked, since they run where libOpenGL is.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
