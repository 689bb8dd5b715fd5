#pragma once

#include "hal/gl_context.h"
#include "tests/measure/eval/shot.h"

#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// A method that computes the flow from video frames to a still, for one rig. run() must get the
/// frames in the order of their times, because some methods use earlier frames.
class FlowMethod {
public:
    virtual ~FlowMethod() = default;

    virtual void setStill(const Shot& still) = 0;
    struct Result {
        cv::Mat flow;  ///< CV_32FC2 [video px], see FlowField in pipeline/results.h; NaN: no result
        /// Median time of three runs (by methodClock) after one that warms up, without the work for
        /// each still.
        double ms = 0;
        cv::Mat confidence{};  ///< CV_32F of every pixel; empty if the method has none
    };
    [[nodiscard]] virtual Result run(const Shot& frame) = 0;
};

[[nodiscard]] const std::vector<std::string>& flowMethodNames();

/// Makes flow methods. For the first of mfar's own methods, the factory creates a GL context,
/// which stays current. create() throws std::invalid_argument for an unknown name.
class FlowFactory {
public:
    [[nodiscard]] std::unique_ptr<FlowMethod> create(const std::string& name, const StereoRig& rig);
    [[nodiscard]] GlContext& context();

private:
    std::unique_ptr<GlContext> context_;
};

}  // namespace mfar::eval
