#pragma once

#include "tests/stability/checks.h"
#include "tests/stability/gl_watch.h"
#include "tests/stability/hostile.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Each case draws a hostile input from its seed, runs one part of the pipeline on it and checks
/// invariants: no NaN, nothing infinite, everything within its stated range; where truth is known,
/// the error; and that scaling the world, mirroring the pictures or exchanging the views changes
/// nothing else.
namespace mfar::stress {

/// Size of the pictures: small, as in the tests; a mixture of small and the product's size; the
/// product's size only.
enum class Scale { Tests, Mixed, Product };

struct Context {
    Hostile hostile;
    Checks& checks;
    GlWatch& gl;
    Scale scale = Scale::Tests;

    /// Size of the video; hostile.size(least, most) where it is small.
    [[nodiscard]] Size size(int least, int most);
};

/// Two cameras next to each other: small ones, or with distorted lenses at the product's size.
[[nodiscard]] StereoRig hostileRig(Context& context);

struct Case {
    const char* name;
    void (*run)(Context& context);
    bool atProductSize = false;  ///< fast enough for many runs at the product's size
};

[[nodiscard]] std::vector<Case> allCases();

// One function per file.
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

/// Runs a case; an exception is a fault, too. Returns the faults, each with the case and the seed.
[[nodiscard]] std::vector<std::string> run(const Case& one, std::uint64_t seed, Checks& checks,
                                           GlWatch& gl, Scale scale);

[[nodiscard]] inline long pixelsOf(Size size) {
    return static_cast<long>(size.width) * size.height;
}
[[nodiscard]] inline long pixelsOf(const PixelRect& rect) {
    return pixelsOf(Size{rect.x1 - rect.x0, rect.y1 - rect.y0});
}

}  // namespace mfar::stress
