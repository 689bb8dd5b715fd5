#pragma once

#include "hal/plane_importer.h"

#include <EGL/egl.h>

#include <memory>

namespace mfar {

/// Nothing where display or context lacks what it takes: EGL_EXT_image_dma_buf_import,
/// GL_OES_EGL_image. Context current.
[[nodiscard]] std::unique_ptr<PlaneImporter> createPlaneImporter(EGLDisplay display);

}  // namespace mfar
