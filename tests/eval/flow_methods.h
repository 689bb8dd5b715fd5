#pragma once

#include "hal/gl_context.h"

#include <opencv2/core.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mfar::eval {

/// Dense flow from a to b: CV_8UC1 pictures of one size in, CV_32FC2 [px] out.
using FlowMethod = std::function<cv::Mat(const cv::Mat& a, const cv::Mat& b)>;

/// What --methods accepts for flow.
[[nodiscard]] const std::vector<std::string>& flowMethodNames();

/// The method of this product needs a GL context: it is created on first need and stays current.
/// Throws std::invalid_argument for an unknown name.
class FlowFactory {
public:
    [[nodiscard]] FlowMethod create(const std::string& name);

private:
    std::unique_ptr<GlContext> context_;
};

}  // namespace mfar::eval
