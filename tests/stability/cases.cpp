#include "tests/stability/cases.h"

#include <fmt/format.h>

#include <exception>

namespace mfar::stress {

Size Context::size(int least, int most) {
    const bool isVideo = scale == Scale::Product || (scale == Scale::Mixed && hostile.chance(0.15));
    if (!isVideo) return hostile.size(least, most);
    return {640 + hostile.integer(-1, 1), 480 + hostile.integer(-1, 1)};
}

StereoRig hostileRig(Context& c) {
    if (c.scale == Scale::Product) return bentRig(c.size(1, 1), {2304, 1728});
    if (c.scale == Scale::Mixed && c.hostile.chance(0.3)) return bentRig({640, 480}, {1152, 864});
    const Size video = c.hostile.size(1, 150), still = c.hostile.size(1, 260);
    StereoRig rig{c.hostile.camera(video), c.hostile.camera(still), c.hostile.gentle(0.05)};
    if (c.hostile.chance(0.2)) rig.T_still_video = c.hostile.motion(0.1);
    return rig;
}

std::vector<Case> allCases() {
    std::vector<Case> out;
    for (const auto& some : {flowCases(), triangulationCases(), pipelineCases(), engineCases(),
                             pictureCases(), virtualCases(), searchCases(), rowCases(),
                             depthCases(), poseCases(), warpCases(), screenCases(), tracerCases()})
        out.insert(out.end(), some.begin(), some.end());
    return out;
}

std::vector<std::string> run(const Case& one, std::uint64_t seed, Checks& checks, GlWatch& gl,
                             Scale scale) {
    // Mixes seed and name, so that the inputs differ between neighbouring seeds, and between two
    // cases with the same seed.
    std::uint64_t mixed = seed;
    for (const char* c = one.name; *c != '\0'; ++c)
        mixed = (mixed ^ static_cast<unsigned char>(*c)) * 0x100000001B3ULL;
    Context context{Hostile(mixed), checks, gl, scale};
    try {
        one.run(context);
        gl.frame(checks, 0);
    } catch (const std::exception& error) {
        checks.fail(fmt::format("the case threw an exception: {}", error.what()));
    }
    std::vector<std::string> out;
    for (const std::string& fault : checks.take())
        out.push_back(fmt::format("case {}, seed {}: {}", one.name, seed, fault));
    return out;
}

}  // namespace mfar::stress
