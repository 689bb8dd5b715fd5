#pragma once

#include "hal/plane_importer.h"

#include <EGL/egl.h>

#include <memory>

namespace mfar {

/// Returns null if EGL_EXT_image_dma_buf_import or GL_OES_EGL_image is not supported.
[[nodiscard]] std::unique_ptr<PlaneImporter> createPlaneImporter(EGLDisplay display);

}  // namespace mfar
