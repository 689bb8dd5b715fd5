#include "tests/measure/eval/shift_flow.h"

#include "tests/measure/eval/rig_resample.h"
#include "tests/measure/eval/stopwatch.h"

#include <opencv2/imgproc.hpp>

namespace mfar::eval {
namespace {

cv::Mat greyFloats(const cv::Mat& picture) {
    cv::Mat grey, out;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    grey.convertTo(out, CV_32F);
    return out;
}

class ShiftFlow final : public FlowMethod {
public:
    explicit ShiftFlow(const StereoRig& rig) : rig_(rig) {}

    // Resamples the still to the video's size, lens and orientation.
    void setStill(const Shot& still) override {
        still_ = greyFloats(resampleStill(still.picture, rig_));
        cv::createHanningWindow(window_, still_.size(), CV_32F);
    }

    // Video pixel p and still pixel p + flow(p) show the same point.
    Result run(const Shot& frame) override {
        const cv::Mat video = greyFloats(frame.picture);
        cv::Point2d shift;
        Result out;
        const auto correlate = [&] { shift = cv::phaseCorrelate(video, still_, window_); };
        correlate();
        out.ms = medianOfThree([&] { return methodMs(correlate); });
        out.flow = cv::Mat(video.size(), CV_32FC2, cv::Scalar(shift.x, shift.y));
        return out;
    }

private:
    StereoRig rig_;
    cv::Mat still_, window_;
};

}  // namespace

std::unique_ptr<FlowMethod> shiftFlow(const StereoRig& rig) {
    return std::make_unique<ShiftFlow>(rig);
}

}  // namespace mfar::eval
