#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// The thing that is shown where nobody chose another: a lidded jar of blue glaze with twisted
/// flutes and a gilded shoulder, brass fittings, on a turned stand of walnut. 0.145 m high, stands
/// on z = 0 about the z axis. Some 45,000 triangles; the same each time.
[[nodiscard]] Model showpiece();

}  // namespace mfar
