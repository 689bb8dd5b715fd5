#include "tests/eval/flow_methods.h"

#include "pipeline/pipeline.h"
#include "tests/eval/paper_pipeline.h"
#include "tests/eval/picture.h"

#include <fmt/format.h>
#include <opencv2/video/tracking.hpp>

#include <stdexcept>

namespace mfar::eval {
namespace {

FlowMethod disMethod(DisPreset preset, bool fullResolution) {
    auto dis = createDis(preset);
    if (fullResolution) dis->setFinestScale(0);
    return [dis](const cv::Mat& a, const cv::Mat& b) {
        cv::Mat flow;
        dis->calc(a, b, flow);
        return flow;
    };
}

cv::Mat farneback(const cv::Mat& a, const cv::Mat& b) {
    cv::Mat flow;
    // The values of OpenCV's own samples.
    cv::calcOpticalFlowFarneback(a, b, flow, 0.5, 3, 15, 3, 5, 1.2, 0);
    return flow;
}

cv::Mat flow2d(const cv::Mat& a, const cv::Mat& b) {
    std::vector<float> vectors = flowBetween(viewOf(a), viewOf(b));
    CV_Assert(vectors.size() == 2 * a.total());
    return cv::Mat(a.rows, a.cols, CV_32FC2, vectors.data()).clone();
}

}  // namespace

const std::vector<std::string>& flowMethodNames() {
    static const std::vector<std::string> names{"flow2d", "dis-fast", "dis-medium",
                                                "dis-medium-full", "farneback"};
    return names;
}

FlowMethod FlowFactory::create(const std::string& name) {
    if (name == "dis-fast") return disMethod(DisPreset::Fast, false);
    if (name == "dis-medium") return disMethod(DisPreset::Medium, false);
    if (name == "dis-medium-full") return disMethod(DisPreset::Medium, true);
    if (name == "farneback") return farneback;
    if (name != "flow2d") throw std::invalid_argument(fmt::format("unknown method '{}'", name));
    if (!context_) context_ = createGlContext();
    return flow2d;
}

}  // namespace mfar::eval
