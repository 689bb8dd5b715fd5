#pragma once

#include "base/image_view.h"

#include <cstddef>

namespace mfar {

/// A plane of texels in memory that devices share (dma-buf).
struct SharedPlane {
    int fd = -1;
    std::size_t offset = 0, stride = 0;  ///< bytes
    Size size;                           ///< texels
    int channels = 1;                    ///< of 8 bits: 1, 2 or 4
};

/// Makes textures of memory that a camera fills, without a copy. GL thread, context current.
class PlaneImporter {
public:
    virtual ~PlaneImporter() = default;

    /// The name of a texture that shows the plane as it is whenever it is read. Throws
    /// std::runtime_error where the driver refuses that memory or layout.
    [[nodiscard]] virtual unsigned import(const SharedPlane& plane) = 0;
    /// Gives it up. Never throws.
    virtual void forget(unsigned texture) = 0;
};

}  // namespace mfar
