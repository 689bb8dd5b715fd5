#pragma once

#include "base/workers.h"
#include "pipeline/engine/engine.h"
#include "pipeline/engine/field.h"

#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

namespace mfar::test {

/// An engine that only warps. Without arguments, the environment variable MFAR_ENGINE names it. The
/// GLES engine needs a current context.
inline std::unique_ptr<Engine> warpEngine(EngineKind kind, int threads = 0) {
    const CameraModel camera{{64, 48}, 60, 60, 31.5, 23.5, {}};
    StepSetup setup{};
    setup.rig.video = setup.rig.still = camera;
    setup.output = camera.size;
    setup.workers = std::make_shared<Workers>(threads);
    return kind == EngineKind::Gles ? makeGlesEngine(setup) : makeSimdEngine(setup);
}
inline std::unique_ptr<Engine> warpEngine() {
    return warpEngine(EngineChoice::fromEnvironment().occlusion);
}

inline std::vector<std::uint8_t> bytesOf(const Field<std::uint32_t>& field) {
    const auto rows = field.host();
    std::vector<std::uint8_t> out(4UL * rows.size.width * rows.size.height);
    for (int y = 0; y < rows.size.height; ++y)
        std::memcpy(out.data() + 4UL * y * rows.size.width, rows[y], 4UL * rows.size.width);
    return out;
}

inline std::vector<float> valuesOf(const Field<float>& field) {
    const auto rows = field.host();
    std::vector<float> out;
    for (int y = 0; y < rows.size.height; ++y)
        out.insert(out.end(), rows[y], rows[y] + rows.size.width);
    return out;
}

}  // namespace mfar::test
