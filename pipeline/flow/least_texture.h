#pragma once

#include "pipeline/engine/params/flow.h"

namespace mfar {

/// Returns the FlowCell::texture above which FlowCell::cost is meaningful [grey levels^2]. `noise`
/// is the standard deviation of the video's noise [grey levels].
[[nodiscard]] inline float leastTexture(double noise) {
    return static_cast<float>(params::kTexturePerVariance * (1 + noise * noise));
}

}  // namespace mfar
