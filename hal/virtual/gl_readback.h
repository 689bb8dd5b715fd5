#pragma once

#include "hal/display.h"

#include <cstdint>

namespace mfar {

/// Copies the picture into `rgba`, row 0 first, rows without padding. Waits for the GPU. Leaves the
/// context's bindings as they were. Throws std::runtime_error when GL refuses.
void readBack(const GlImage& image, std::uint8_t* rgba);

}  // namespace mfar
