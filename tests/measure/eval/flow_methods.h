#pragma once

#include "hal/gl_context.h"
#include "tests/measure/eval/shot.h"

#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// One way to find the flow from video frames to a still, set up for one rig. Frames come in the
/// order of their times, so that a method may carry what it knows from one to the next.
class FlowMethod {
public:
    virtual ~FlowMethod() = default;

    /// The reference of the following frames.
    virtual void setStill(const Shot& still) = 0;
    struct Result {
        cv::Mat flow;  ///< CV_32FC2 [video px], FlowField in pipeline/results.h; NaN = no answer
        double ms =
            0;  ///< wall time [ms], median of three after the answer, work per still not in it
        cv::Mat confidence{};  ///< CV_32F of every pixel, empty where the method has none
    };
    [[nodiscard]] virtual Result run(const Shot& frame) = 0;
};

/// What --methods accepts for flow.
[[nodiscard]] const std::vector<std::string>& flowMethodNames();

/// The methods of this product need a GL context: it is created on first need and stays current.
/// Throws std::invalid_argument for an unknown name.
class FlowFactory {
public:
    [[nodiscard]] std::unique_ptr<FlowMethod> create(const std::string& name, const StereoRig& rig);
    [[nodiscard]] GlContext& context();

private:
    std::unique_ptr<GlContext> context_;
};

}  // namespace mfar::eval
