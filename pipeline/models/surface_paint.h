#pragma once

#include "pipeline/scene/scene.h"

#include <functional>

namespace mfar {

struct PaintedPoint {
    Eigen::Vector3f colour;  ///< linear base colour, [0, 1]
    float roughness = 1, metallic = 0;
    float height = 0;  ///< height of the relief [m]
};

/// A painted area: size of its textures, and its width and height [m]. u increases to the right and
/// v downwards.
struct PaintedArea {
    Size texels;
    float width = 1, height = 1;
};

/// Paints textures for base colour, metallic-roughness and normals, adds them to the model and
/// makes the material refer to them. `look` returns the look of each point. The relief continues
/// across the left and right borders, but not across the upper and lower ones.
void paint(Model& model, Material& material, const PaintedArea& area,
           const std::function<PaintedPoint(float u, float v)>& look);

}  // namespace mfar
