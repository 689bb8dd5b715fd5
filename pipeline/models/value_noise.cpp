#include "pipeline/models/value_noise.h"

#include <cmath>
#include <cstdint>

namespace mfar {
namespace {

float latticeValue(int x, int y, int z) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8DA6B343U ^
                      static_cast<std::uint32_t>(y) * 0xD8163841U ^
                      static_cast<std::uint32_t>(z) * 0xCB1AB31FU;
    h = (h ^ h >> 15U) * 0x2C1B3C6DU;
    h = (h ^ h >> 12U) * 0x297A2D39U;
    h ^= h >> 15U;
    return static_cast<float>(h >> 8U) * 0x1p-23F - 1;
}

float faded(float t) {
    return t * t * (3 - 2 * t);
}

}  // namespace

float valueNoise(const Eigen::Vector3f& p) {
    const Eigen::Vector3f whole = p.array().floor();
    const int x = static_cast<int>(whole.x()), y = static_cast<int>(whole.y()),
              z = static_cast<int>(whole.z());
    const Eigen::Vector3f f = p - whole;
    const auto alongX = [&](int dy, int dz) {
        return std::lerp(latticeValue(x, y + dy, z + dz), latticeValue(x + 1, y + dy, z + dz),
                         faded(f.x()));
    };
    const float near = std::lerp(alongX(0, 0), alongX(1, 0), faded(f.y())),
                far = std::lerp(alongX(0, 1), alongX(1, 1), faded(f.y()));
    return std::lerp(near, far, faded(f.z()));
}

float fractalNoise(const Eigen::Vector3f& p, int octaves) {
    float sum = 0, strength = 0.5F, size = 1;
    for (int i = 0; i < octaves; ++i, strength /= 2, size *= 2)
        sum += strength * valueNoise(p * size + Eigen::Vector3f::Constant(17.3F * size));
    return sum;
}

}  // namespace mfar
