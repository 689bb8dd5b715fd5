#pragma once

#include "tests/measure/eval/flow_methods.h"

#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// A method that computes the depth of video frames from a still, for one rig. run() must get the
/// frames in the order of their times, because some methods use earlier frames.
class DepthMethod {
public:
    virtual ~DepthMethod() = default;

    virtual void setStill(const Shot& still) = 0;
    struct Result {
        cv::Mat inverseDepth;  ///< CV_32F [1/m] of every video pixel; 0: unknown
        /// Method `depth`: wall time of the needed stages in a single run. Other methods:
        /// FlowMethod::Result::ms, without the time of the triangulation.
        double ms = 0;
        cv::Mat variance{};  ///< of inverseDepth, CV_32F [1/m^2]; empty if the method has none
    };
    [[nodiscard]] virtual Result run(const Shot& frame) = 0;
};

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
