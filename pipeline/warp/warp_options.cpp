#include "pipeline/warp/warp_options.h"

#include "pipeline/slices/hole_request.h"

#include <stdexcept>
#include <string>

namespace mfar {
namespace {

void requireOption(const char* name, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw std::invalid_argument("warp option " + std::string(name) + " is " +
                                    std::to_string(value) + ", but must be from " +
                                    std::to_string(least) + " to " + std::to_string(most));
}

}  // namespace

void validate(const WarpOptions& options) {
    constexpr double kMostPixels = 16384.0 * 16384;
    requireOption("filling", static_cast<int>(options.filling), 0, 3);
    requireOption("mostRequested", options.mostRequested, 1, kMostPixels);
    requireOption("holeSamples", options.holeSamples, 1, kMostHoleSamples);
    requireOption("sharpenShare", options.sharpenShare, 0, 1);
    requireOption("sharpenSamples", options.sharpenSamples, 1, kMostHoleSamples);
    requireOption("fadeFrames", options.fadeFrames, 0, 100);
    requireOption("leastMotion", options.leastMotion, 0, 10);
}

}  // namespace mfar
