#pragma once

#include "tests/measure/eval/flow_methods.h"

#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// One way to find the depth of video frames with the help of a still, set up for one rig. Frames
/// come in the order of their times, so that a method may carry what it knows from one to the next.
class DepthMethod {
public:
    virtual ~DepthMethod() = default;

    /// The reference of the following frames.
    virtual void setStill(const Shot& still) = 0;
    struct Result {
        cv::Mat inverseDepth;  ///< CV_32F [1/m] of every video pixel, 0 = unknown
        double ms = 0;         ///< wall time [ms], as of FlowMethod, with the triangulation
        cv::Mat variance{};    ///< CV_32F of inverseDepth [1/m^2], empty where there is none
    };
    [[nodiscard]] virtual Result run(const Shot& frame) = 0;
};

/// What --methods accepts for depth.
[[nodiscard]] const std::vector<std::string>& depthMethodNames();

class DepthFactory {
public:
    /// Throws std::invalid_argument for an unknown name.
    [[nodiscard]] std::unique_ptr<DepthMethod> create(const std::string& name,
                                                      const StereoRig& rig);

private:
    FlowFactory flows_;
};

}  // namespace mfar::eval
