#pragma once

#include "base/image_view.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>

namespace mfar {

[[nodiscard]] bool isRadianceHdr(std::span<const std::uint8_t> bytes);

/// Reads a Radiance picture (RGBE; uncompressed, or with the old or the new run-length coding;
/// order -Y +X). First calls `size`, which can throw, then calls `row` for each row from the top.
/// The values are divided by the header's EXPOSURE and limited to [0, 1e7]. Throws
/// std::runtime_error with the fault. Source: Ward, Real Pixels, Graphics Gems II, 1991; Radiance's
/// color.c.
void readRadianceHdr(std::span<const std::uint8_t> bytes, const std::function<void(Size)>& size,
                     const std::function<void(int, std::span<const Eigen::Vector3f>)>& row);

}  // namespace mfar
