#include "pipeline/models/spherical_harmonics.h"

namespace mfar {

Eigen::Vector<float, 9> harmonicsAt(const Eigen::Vector3f& direction) {
    const float x = direction.x(), y = direction.y(), z = direction.z();
    Eigen::Vector<float, 9> out;
    out << 0.282095F, 0.488603F * y, 0.488603F * z, 0.488603F * x, 1.092548F * x * y,
        1.092548F * y * z, 0.315392F * (3 * z * z - 1), 1.092548F * x * z,
        0.546274F * (x * x - y * y);
    return out;
}

}  // namespace mfar
