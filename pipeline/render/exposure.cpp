#include "pipeline/render/exposure.h"

namespace mfar {

Eigen::Vector3f displayed(const Eigen::Vector3f& radiance, const Exposure& exposure) {
    Eigen::Vector3f out;
    for (int c = 0; c < 3; ++c)
        out[c] = srgbEncoded(radiance[c] * exposure.scale);
    return out;
}

}  // namespace mfar
