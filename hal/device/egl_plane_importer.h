#pragma once

#include "hal/plane_importer.h"

#include <EGL/egl.h>

#include <memory>

namespace mfar {

/// Empty if the display or context lacks EGL_EXT_image_dma_buf_import or GL_OES_EGL_image. Needs
/// the current context.
[[nodiscard]] std::unique_ptr<PlaneImporter> createPlaneImporter(EGLDisplay display);

}  // namespace mfar
