#pragma once

#include "hal/gl_context.h"
#include "tests/measure/eval/shot.h"

#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// A method that finds the flow from video frames to a still, set up for one rig. Frames come in
/// the order of their times, so that a method may keep state between them.
class FlowMethod {
public:
    virtual ~FlowMethod() = default;

    /// Sets the still for the following frames.
    virtual void setStill(const Shot& still) = 0;
    struct Result {
        cv::Mat flow;  ///< CV_32FC2 [video px], see FlowField in pipeline/results.h; NaN: no result
        double ms =
            0;  ///< wall time [ms], median of three runs after the first, without work per still
        cv::Mat confidence{};  ///< CV_32F of every pixel, empty if the method has none
    };
    [[nodiscard]] virtual Result run(const Shot& frame) = 0;
};

/// Names that the option --methods accepts for flow.
[[nodiscard]] const std::vector<std::string>& flowMethodNames();

/// Makes flow methods. The product's methods need a GL context, which is created for the first of
/// them and stays current. create() throws std::invalid_argument for an unknown name.
class FlowFactory {
public:
    [[nodiscard]] std::unique_ptr<FlowMethod> create(const std::string& name, const StereoRig& rig);
    [[nodiscard]] GlContext& context();

private:
    std::unique_ptr<GlContext> context_;
};

}  // namespace mfar::eval
