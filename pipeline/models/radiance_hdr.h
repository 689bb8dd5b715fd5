#pragma once

#include "base/image_view.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>

namespace mfar {

/// Whether the bytes begin like a Radiance picture.
[[nodiscard]] bool isRadianceHdr(std::span<const std::uint8_t> bytes);

/// Reads a Radiance picture (RGBE, uncompressed or with either kind of run-length coding, -Y +X
/// order). Calls `size` first, which may throw, and then `row` for each row from the top. Values
/// are finite and not negative. The header's EXPOSURE is undone. Throws std::runtime_error with the
/// fault. Source: Ward, Real Pixels, Graphics Gems II, 1991; Radiance's color.c.
void readRadianceHdr(std::span<const std::uint8_t> bytes, const std::function<void(Size)>& size,
                     const std::function<void(int, std::span<const Eigen::Vector3f>)>& row);

}  // namespace mfar
