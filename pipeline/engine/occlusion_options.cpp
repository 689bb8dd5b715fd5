#include "pipeline/engine/occlusion_options.h"

#include <stdexcept>
#include <string>

namespace mfar {
namespace {

void require(const char* name, double value, double least) {
    constexpr double kMost = 1000;
    if (!(value >= least && value <= kMost))
        throw std::invalid_argument("composite option " + std::string(name) + " is " +
                                    std::to_string(value) + ", not from " + std::to_string(least) +
                                    " to 1000");
}

}  // namespace

void validate(const CompositeOptions& options) {
    require("bias", options.bias, 0);
    require("softness", options.softness, 0.01);
    require("virtualSigma", options.virtualSigma, 0);
    require("likeness", options.likeness, 0.1);
}

}  // namespace mfar
