#pragma once

#include "tests/stability/checks.h"
#include "tests/stability/gl_watch.h"
#include "tests/stability/hostile.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Each case draws an input that is hard to bear from its seed, runs one part of the pipeline on it
/// and checks what must hold whatever the input: no NaN, nothing infinite, everything in its stated
/// range; and where truth is known, its error, and that scaling the world, mirroring the pictures
/// or exchanging the views changes nothing else.
namespace mfar::stress {

/// How large the pictures are: small ones, as in the tests; some of the product's size among them;
/// of the product's size alone.
enum class Scale { Tests, Mixed, Product };

struct Context {
    Hostile hostile;
    Checks& checks;
    GlWatch& gl;
    Scale scale = Scale::Tests;

    /// Of the video; hostile.size(least, most) where it is small.
    [[nodiscard]] Size size(int least, int most);
};

/// Two cameras beside each other: small ones, or with lenses bent at the product's size.
[[nodiscard]] StereoRig hostileRig(Context& context);

struct Case {
    const char* name;
    void (*run)(Context& context);
    bool atProductSize = false;  ///< quick enough to be run again and again at that
};

[[nodiscard]] std::vector<Case> allCases();

// By file.
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

/// Runs a case; what is thrown is a fault as well. The faults, each with the case and the seed.
[[nodiscard]] std::vector<std::string> run(const Case& one, std::uint64_t seed, Checks& checks,
                                           GlWatch& gl, Scale scale);

[[nodiscard]] inline long pixelsOf(Size size) {
    return static_cast<long>(size.width) * size.height;
}
[[nodiscard]] inline long pixelsOf(const PixelRect& rect) {
    return pixelsOf(Size{rect.x1 - rect.x0, rect.y1 - rect.y0});
}

}  // namespace mfar::stress
