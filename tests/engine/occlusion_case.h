#pragma once

#include "pipeline/engine/engine.h"
#include "tests/engine/gl_test.h"
#include "tests/oracle/visibility.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mfar {

struct LaidLayer {
    Size size;
    std::function<std::array<std::uint8_t, 4>(int, int)> colour = [](int, int) {
        return std::array<std::uint8_t, 4>{200, 100, 50, 255};
    };
    std::function<double(int, int)> z = [](int, int) { return 2.0; };  ///< depth of a pixel [m]
    PixelRect bounds{0, 0, 5000, 5000};
};

struct LaidOver {
    Size output;
    std::vector<std::uint8_t> shown;       ///< RGBA8
    std::vector<std::uint8_t> visibility;  ///< visible share of each output pixel [1/255]

    [[nodiscard]] double visibleAt(int x, int y) const {
        return visibility[static_cast<std::size_t>(y) * output.width + x] / 255.0;
    }
    [[nodiscard]] double visibleEverywhere() const {
        for (const std::uint8_t share : visibility)
            if (share != visibility[0]) return -1;
        return visibility[0] / 255.0;
    }
    [[nodiscard]] int at(int x, int y, int channel) const {
        return shown[4 * (static_cast<std::size_t>(y) * output.width + x) + channel];
    }
};

class OcclusionCase : public GlTest {
protected:
    static constexpr Size kCoarse{53, 37};
    static constexpr Size kFine{191, 133};

    static twin::Scene plainScene(const twin::RealSample& real);
    static LaidOver laidOver(EngineKind engine, const twin::Scene& scene, const LaidLayer& layer,
                             const CompositeOptions& options = {});
};

class OcclusionTest : public OcclusionCase, public testing::WithParamInterface<EngineKind> {
protected:
    static LaidOver run(const twin::Scene& scene, const LaidLayer& layer,
                        const CompositeOptions& options = {}) {
        return laidOver(GetParam(), scene, layer, options);
    }
};

void expectOracles(const LaidOver& got, twin::Scene scene, const LaidLayer& layer,
                   const CompositeOptions& options = {});

}  // namespace mfar
