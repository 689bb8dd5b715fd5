#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// The default object: a lidded jar of blue glaze with twisted flutes and a gilded shoulder, brass
/// fittings, on a turned stand of walnut. 0.145 m high, stands on z = 0 about the z axis. About
/// 45,000 triangles; always the same.
[[nodiscard]] Model showpiece();

}  // namespace mfar
