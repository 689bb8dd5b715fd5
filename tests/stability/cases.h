#pragma once

#include "tests/stability/checks.h"
#include "tests/stability/gl_watch.h"
#include "tests/stability/hostile.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Each case makes a random hostile input (extreme or invalid values) from its seed, runs one part
/// of the pipeline and checks the results. No number may be NaN, infinite or outside its stated
/// range. Where the truth is known, the error is checked. Some cases scale the world, mirror the
/// pictures or exchange the views. Then the results may change only as expected.
namespace mfar::stress {

/// Sizes of the pictures. Tests: small. Product: the sizes usual in mfard (video about 640x480).
/// Mixed: either, chosen at random.
enum class Scale { Tests, Mixed, Product };

struct Context {
    Hostile hostile;
    Checks& checks;
    GlWatch& gl;
    Scale scale = Scale::Tests;

    /// Returns a size for the video: about 640x480, or hostile.size(least, most). `scale` decides.
    [[nodiscard]] Size size(int least, int most);
};

/// Two cameras next to each other: either with small pictures and lenses of hostile.camera(), or
/// with larger pictures and moderate distortion, which Scale::Product always selects.
[[nodiscard]] StereoRig hostileRig(Context& context);

struct Case {
    const char* name;
    void (*run)(Context& context);
    bool atProductSize = false;  ///< true: fast enough that Balance runs it at Scale::Product
};

[[nodiscard]] std::vector<Case> allCases();

[[nodiscard]] std::vector<Case> flowCases();
[[nodiscard]] std::vector<Case> triangulationCases();
[[nodiscard]] std::vector<Case> pipelineCases();
[[nodiscard]] std::vector<Case> engineCases();
[[nodiscard]] std::vector<Case> pictureCases();
[[nodiscard]] std::vector<Case> virtualCases();
[[nodiscard]] std::vector<Case> searchCases();
[[nodiscard]] std::vector<Case> rowCases();
[[nodiscard]] std::vector<Case> depthCases();
[[nodiscard]] std::vector<Case> poseCases();
[[nodiscard]] std::vector<Case> warpCases();
[[nodiscard]] std::vector<Case> screenCases();
#ifdef MFAR_PATH_TRACING
[[nodiscard]] std::vector<Case> tracerCases();
#else
[[nodiscard]] inline std::vector<Case> tracerCases() {
    return {};
}
#endif

/// Runs a case. An exception counts as a fault. Returns the faults, each with the case's name and
/// the seed.
[[nodiscard]] std::vector<std::string> run(const Case& one, std::uint64_t seed, Checks& checks,
                                           GlWatch& gl, Scale scale);

[[nodiscard]] inline long pixelsOf(Size size) {
    return static_cast<long>(size.width) * size.height;
}
[[nodiscard]] inline long pixelsOf(const PixelRect& rect) {
    return pixelsOf(Size{rect.x1 - rect.x0, rect.y1 - rect.y0});
}

}  // namespace mfar::stress
