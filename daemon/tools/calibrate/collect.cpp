#include "daemon/tools/calibrate/collect.h"

#include "daemon/tools/calibrate/target_finder.h"
#include "hal/virtual/image_files.h"

#include <opencv2/imgproc.hpp>

#include <vector>

namespace mfar::calibration {
SensorViews collect(const std::vector<RecordedImage>& pictures, Size picture, const Target& target,
                    const std::function<void(const Progress&)>& progress) {
    SensorViews out{picture, {}};
    TargetFinder finder(target, picture);
    Coverage coverage(picture);
    Progress now{coverage, 0, static_cast<int>(pictures.size()), 0};
    cv::Mat4b colour(picture.height, picture.width);
    cv::Mat1b luma;
    for (const RecordedImage& file : pictures) {
        loadImageInto(file.file, picture, colour.ptr(), colour.step);
        cv::cvtColor(colour, luma, cv::COLOR_RGBA2GRAY);
        std::vector<Corner> corners =
            finder.find({luma.ptr(), picture, luma.step, PixelFormat::Gray8});
        ++now.done;
        if (corners.size() >= kLeastViewCorners) {
            coverage.add(corners);
            ++now.found;
            out.views.push_back({file.time, std::move(corners)});
        }
        progress(now);
    }
    return out;
}

}  // namespace mfar::calibration
