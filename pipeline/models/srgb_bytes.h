#pragma once

#include <array>

namespace mfar {

/// Linear value of each sRGB byte, [0, 1] (IEC 61966-2-1).
[[nodiscard]] const std::array<float, 256>& linearOfSrgbByte();

}  // namespace mfar
