#pragma once

#include "base/image_view.h"

#include <cstddef>

namespace mfar {

/// An image plane in memory that several devices can use (dma-buf).
struct SharedPlane {
    int fd = -1;
    /// Offset and stride in bytes, size in texels. A texel has 1, 2 or 4 channels of 8 bits.
    std::size_t offset = 0, stride = 0;
    Size size;
    int channels = 1;
};

/// Creates textures from camera memory without a copy. The GL context must be current on the
/// calling thread.
class PlaneImporter {
public:
    virtual ~PlaneImporter() = default;

    /// Creates a texture that always shows the plane's current content, and returns its GL name.
    /// Throws std::runtime_error if the driver refuses the memory or the layout.
    [[nodiscard]] virtual unsigned import(const SharedPlane& plane) = 0;
    virtual void forget(unsigned texture) = 0;
};

}  // namespace mfar
