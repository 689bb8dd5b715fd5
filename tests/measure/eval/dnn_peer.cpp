#include "tests/measure/eval/dnn_peer.h"

#include "tests/measure/eval/report.h"

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn_superres.hpp>
#include <opencv2/imgproc.hpp>

#include <fstream>
#include <memory>

namespace mfar::eval {
namespace {

constexpr int kTrial = 32;

EvalError unusable(const std::filesystem::path& file, std::string why) {
    why.erase(std::min(why.find('\n'), why.size()));
    return EvalError(
        fmt::format("{}: OpenCV's dnn_superres cannot use this file ({})", file.string(), why));
}

class Enlarger {
public:
    Enlarger(std::filesystem::path file, Size output)
        : file_(std::move(file)), output_(output.width, output.height) {
        const DnnModelName name = dnnModelNamed(file_);
        if (!std::ifstream(file_)) throw EvalError(fmt::format("{}: no such file", file_.string()));
        // Keeps OpenCV from printing errors that it also throws.
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        try {
            model_.readModel(file_.string());
        } catch (const cv::Exception& e) {
            throw unusable(file_, e.err);
        }
        model_.setModel(name.algorithm, name.scale);
        // OpenCV detects some faults of a file only when the network runs.
        (void)enlarged(cv::Mat(kTrial, kTrial, CV_8UC3, cv::Scalar::all(90)));
    }

    cv::Mat run(const cv::Mat& video) {
        const cv::Mat picture = enlarged(video);
        cv::Mat out;
        const bool shrinks = picture.cols > output_.width;
        cv::resize(picture, out, output_, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_CUBIC);
        return out;
    }

private:
    cv::Mat enlarged(const cv::Mat& video) {
        cv::Mat out;
        try {
            model_.upsample(video, out);
        } catch (const cv::Exception& e) {
            throw unusable(file_, e.err);
        }
        return out;
    }

    std::filesystem::path file_;
    cv::Size output_;
    cv::dnn_superres::DnnSuperResImpl model_;
};

}  // namespace

std::function<cv::Mat(const cv::Mat&)> dnnEnlarger(const std::filesystem::path& file, Size output) {
    const auto enlarger = std::make_shared<Enlarger>(file, output);
    return [enlarger](const cv::Mat& video) { return enlarger->run(video); };
}

}  // namespace mfar::eval
