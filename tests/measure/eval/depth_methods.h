#pragma once

#include "tests/measure/eval/flow_methods.h"

#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// A method that finds the depth of video frames with a still, set up for one rig. Frames come in
/// the order of their times, so that a method may keep state between them.
class DepthMethod {
public:
    virtual ~DepthMethod() = default;

    /// Sets the still for the following frames.
    virtual void setStill(const Shot& still) = 0;
    struct Result {
        cv::Mat inverseDepth;  ///< CV_32F [1/m] of every video pixel, 0 = unknown
        double ms = 0;         ///< wall time [ms] as FlowMethod::Result::ms, with triangulation
        cv::Mat variance{};    ///< CV_32F of inverseDepth [1/m^2], empty if the method has none
    };
    [[nodiscard]] virtual Result run(const Shot& frame) = 0;
};

/// Names that the option --methods accepts for depth.
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
