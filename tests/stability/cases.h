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

struct Context {
    Hostile hostile;
    Checks& checks;
    GlWatch& gl;
    bool large = false;  ///< pictures of the product's size may come
};

struct Case {
    const char* name;
    void (*run)(Context& context);
};

[[nodiscard]] std::vector<Case> allCases();

// By file.
[[nodiscard]] std::vector<Case> flowCases();
[[nodiscard]] std::vector<Case> triangulationCases();
[[nodiscard]] std::vector<Case> pipelineCases();
[[nodiscard]] std::vector<Case> pictureCases();
[[nodiscard]] std::vector<Case> virtualCases();
[[nodiscard]] std::vector<Case> searchCases();
[[nodiscard]] std::vector<Case> depthCases();
[[nodiscard]] std::vector<Case> poseCases();

/// Runs a case; what is thrown is a fault as well. The faults, each with the case and the seed.
[[nodiscard]] std::vector<std::string> run(const Case& one, std::uint64_t seed, Checks& checks,
                                           GlWatch& gl, bool large);

[[nodiscard]] inline long pixelsOf(Size size) {
    return static_cast<long>(size.width) * size.height;
}

}  // namespace mfar::stress
