#pragma once

#include <array>

namespace mfar {

/// What an sRGB byte stands for, [0, 1] linear (IEC 61966-2-1).
[[nodiscard]] const std::array<float, 256>& linearOfSrgbByte();

}  // namespace mfar
