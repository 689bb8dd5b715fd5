#include "tests/measure/eval/match_classes.h"

#include "tests/measure/eval/rig_resample.h"

#include <fmt/format.h>

#include <cmath>

namespace mfar::eval {
namespace {

double errorWithin(const cv::Mat& mask, const cv::Mat& picture, const cv::Mat& truth) {
    const cv::Mat off = picture - truth;
    return cv::mean(off.mul(off), mask)[0];
}

std::optional<double> gainWithin(const cv::Mat& mask, const cv::Mat& picture,
                                 const cv::Mat& bicubic, const cv::Mat& truth) {
    const double ours = errorWithin(mask, picture, truth);
    const double theirs = errorWithin(mask, bicubic, truth);
    if (!(ours > 0 && theirs > 0)) return std::nullopt;
    return 10 * std::log10(theirs / ours);
}

MatchClass classOf(const cv::Vec2f& lookUp, float confidence, Size still) {
    const float right = static_cast<float>(still.width) - 0.5F;
    const float bottom = static_cast<float>(still.height) - 0.5F;
    const bool inside =
        lookUp[0] >= -0.5F && lookUp[0] <= right && lookUp[1] >= -0.5F && lookUp[1] <= bottom;
    if (!inside) return MatchClass::Outside;
    return confidence >= kWellMatched ? MatchClass::Matched : MatchClass::Unmatched;
}

cv::Mat lookUpsOf(const StereoRig& rig, const cv::Mat& flow) {
    const Eigen::Matrix3d rotation = rig.T_still_video.rotation.toRotationMatrix();
    cv::Mat out(flow.size(), CV_32FC2, cv::Scalar::all(-1e6));
    for (int y = 0; y < flow.rows; ++y)
        for (int x = 0; x < flow.cols; ++x) {
            const auto& moved = flow.at<cv::Vec2f>(y, x);
            const Eigen::Vector2d ray = rig.video.unproject({x + moved[0], y + moved[1]});
            const Eigen::Vector3d seen = rotation * Eigen::Vector3d(ray.x(), ray.y(), 1);
            if (!(seen.z() > 1e-6)) continue;
            const Eigen::Vector2d p = rig.still.project(seen.head<2>() / seen.z());
            out.at<cv::Vec2f>(y, x) = {static_cast<float>(p.x()), static_cast<float>(p.y())};
        }
    return out;
}

}  // namespace

cv::Mat matchClasses(const StereoRig& rig, Size output, const StillMatch& match) {
    const Size video = rig.video.size;
    CV_Assert(match.flow.size() == cv::Size(video.width, video.height));
    CV_Assert(match.confidence.size() == match.flow.size());
    const cv::Mat lookUps = lookUpsOf(rig, match.flow);
    cv::Mat classes(output.height, output.width, CV_8U);
    for (int y = 0; y < classes.rows; ++y)
        for (int x = 0; x < classes.cols; ++x) {
            const int vx = x * video.width / output.width, vy = y * video.height / output.height;
            classes.at<unsigned char>(y, x) = static_cast<unsigned char>(classOf(
                lookUps.at<cv::Vec2f>(vy, vx), match.confidence.at<float>(vy, vx), rig.still.size));
        }
    return classes;
}

std::string matchClassesHead() {
    return fmt::format(
        "classes of pixels by mfar's flow: outside = the flow leads outside the still; unmatched = "
        "confidence below {:g} (two-way error above 1 video px, or occluded in the still); matched "
        "= all others. For each class: share of the pixels, and gain of luma PSNR over bicubic "
        "[dB] if the class has at least {:g} % of the pixels\n",
        kWellMatched, 100 * kSmallestClass);
}

std::vector<Column> matchClassColumns() {
    std::vector<Column> out;
    for (const char* name : {"outside", "unmatched", "matched"}) {
        out.push_back({fmt::format("{}_share", name), 3});
        out.push_back({fmt::format("{}_gain_db", name), 2});
    }
    return out;
}

std::vector<std::optional<double>> matchClassValues(const cv::Mat& classes, const cv::Mat& picture,
                                                    const cv::Mat& bicubic, const cv::Mat& truth) {
    CV_Assert(classes.size() == truth.size());
    std::vector<std::optional<double>> out;
    for (int i = 0; i < kMatchClasses; ++i) {
        const cv::Mat mask = classes == i;
        const double share = cv::countNonZero(mask) / static_cast<double>(mask.total());
        out.emplace_back(share);
        out.push_back(share < kSmallestClass ? std::nullopt
                                             : gainWithin(mask, picture, bicubic, truth));
    }
    return out;
}

}  // namespace mfar::eval
