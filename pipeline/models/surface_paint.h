#pragma once

#include "pipeline/scene/scene.h"

#include <functional>

namespace mfar {

/// A painted surface's properties at one point.
struct PaintedPoint {
    Eigen::Vector3f colour;  ///< linear base colour, [0, 1]
    float roughness = 1, metallic = 0;
    float height = 0;  ///< relief [m]
};

/// The painted area: extent of the texture in the world [m], u to the right, v downwards.
struct PaintedArea {
    Size texels;
    float width = 1, height = 1;
};

/// Paints base colour, metallic-roughness and normal textures, appends them to the model's textures
/// and refers to them in the material. The relief is continuous across the borders in u, not in v.
void paint(Model& model, Material& material, const PaintedArea& area,
           const std::function<PaintedPoint(float u, float v)>& look);

}  // namespace mfar
