#include "pipeline/models/surface_paint.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

std::uint8_t byteOf(float share) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * 255));
}

std::uint8_t srgbByteOf(float linear) {
    const float v = std::clamp(linear, 0.0F, 1.0F);
    return byteOf(v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F);
}

SurfaceTexture normalsOfRelief(const std::vector<float>& relief, const PaintedArea& area) {
    SurfaceTexture out{area.texels, false, {}};
    const auto [width, height] = area.texels;
    const float across = 2 * area.width / static_cast<float>(width),
                down = 2 * area.height / static_cast<float>(height);
    const auto at = [&](int x, int y) {
        const int column = (x + width) % width, row = std::clamp(y, 0, height - 1);
        return relief[static_cast<std::size_t>(row) * width + column];
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Eigen::Vector3f n = Eigen::Vector3f((at(x - 1, y) - at(x + 1, y)) / across,
                                                      (at(x, y + 1) - at(x, y - 1)) / down, 1)
                                          .normalized();
            out.texels.push_back({byteOf(n.x() / 2 + 0.5F), byteOf(n.y() / 2 + 0.5F),
                                  byteOf(n.z() / 2 + 0.5F), 255});
        }
    }
    return out;
}

int append(Model& model, SurfaceTexture texture) {
    model.textures.push_back(std::move(texture));
    return static_cast<int>(model.textures.size()) - 1;
}

}  // namespace

void paint(Model& model, Material& material, const PaintedArea& area,
           const std::function<PaintedPoint(float u, float v)>& look) {
    SurfaceTexture colour{area.texels, true, {}}, roughness{area.texels, false, {}};
    std::vector<float> relief;
    for (int y = 0; y < area.texels.height; ++y) {
        for (int x = 0; x < area.texels.width; ++x) {
            const PaintedPoint p =
                look((static_cast<float>(x) + 0.5F) / static_cast<float>(area.texels.width),
                     (static_cast<float>(y) + 0.5F) / static_cast<float>(area.texels.height));
            colour.texels.push_back({srgbByteOf(p.colour.x()), srgbByteOf(p.colour.y()),
                                     srgbByteOf(p.colour.z()), 255});
            roughness.texels.push_back({0, byteOf(p.roughness), byteOf(p.metallic), 255});
            relief.push_back(p.height);
        }
    }
    material.baseColourTexture = append(model, std::move(colour));
    material.metallicRoughnessTexture = append(model, std::move(roughness));
    material.normalTexture = append(model, normalsOfRelief(relief, area));
}

}  // namespace mfar
