#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// The default object: a lidded jar with blue glaze, twisted flutes, a gilded shoulder and brass
/// fittings, on a turned stand of walnut. It is 0.145 m high and stands at z = 0 around the z axis.
/// It has about 56,000 triangles and is always the same.
[[nodiscard]] Model showpiece();

}  // namespace mfar
