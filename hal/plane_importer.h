#pragma once

#include "base/image_view.h"

#include <cstddef>

namespace mfar {

/// A plane of texels in memory shared between devices (dma-buf).
struct SharedPlane {
    int fd = -1;
    std::size_t offset = 0, stride = 0;  ///< bytes
    Size size;                           ///< texels
    int channels = 1;                    ///< 8-bit channels: 1, 2 or 4
};

/// Creates textures from camera memory without a copy. GL thread, context current.
class PlaneImporter {
public:
    virtual ~PlaneImporter() = default;

    /// Creates a texture that always shows the plane's current content and returns its name. Throws
    /// std::runtime_error when the driver refuses the memory or layout.
    [[nodiscard]] virtual unsigned import(const SharedPlane& plane) = 0;
    /// Deletes the texture. Never throws.
    virtual void forget(unsigned texture) = 0;
};

}  // namespace mfar
