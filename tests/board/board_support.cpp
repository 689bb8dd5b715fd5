#include "tests/board/board_support.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <memory>

namespace mfar::test {

SyntheticBoard& sharedBoard(synthetic::Scene scene) {
    static std::map<synthetic::Scene, std::unique_ptr<SyntheticBoard>> boards;
    auto& board = boards[scene];
    if (!board) {
        SyntheticOptions options;
        options.scene = scene;
        options.pace = Pace::Consumer;
        board = std::make_unique<SyntheticBoard>(options);
    }
    return *board;
}

SyntheticOptions smallBoard(int frames, std::uint64_t seed) {
    SyntheticOptions out;
    out.scene = synthetic::Scene::Flat;
    out.pace = Pace::Consumer;
    out.frames = frames;
    out.seed = seed;
    out.rig = synthetic::boardRig({160, 120}, {576, 432});
    return out;
}

cv::Mat1b grey(const ImageView& image) {
    const cv::Mat4b rgba(image.size.height, image.size.width,
                         reinterpret_cast<cv::Vec4b*>(const_cast<std::uint8_t*>(image.data)),
                         image.stride);
    cv::Mat1b out;
    cv::cvtColor(rgba, out, cv::COLOR_RGBA2GRAY);
    return out;
}

cv::Mat3f colour(const StoredImage& image) {
    cv::Mat3f out(image.size.height, image.size.width);
    for (int i = 0; i < image.size.width * image.size.height; ++i)
        for (int k = 0; k < 3; ++k)
            out(i / image.size.width, i % image.size.width)[k] =
                static_cast<float>(image.pixels[4 * i + k]) / 255;
    return out;
}

std::map<int, std::array<Eigen::Vector2d, 4>> detectTags(const cv::Mat1b& picture) {
    apriltag_family_t* family = tag36h11_create();
    apriltag_detector_t* detector = apriltag_detector_create();
    apriltag_detector_add_family(detector, family);
    detector->quad_decimate = 1;
    image_u8_t view{picture.cols, picture.rows, static_cast<int>(picture.step), picture.data};
    zarray_t* found = apriltag_detector_detect(detector, &view);
    std::map<int, std::array<Eigen::Vector2d, 4>> out;
    for (int i = 0; i < zarray_size(found); ++i) {
        apriltag_detection_t* d = nullptr;
        zarray_get(found, i, static_cast<void*>(&d));
        // In libapriltag's coordinates the centre of the first pixel is (0.5, 0.5).
        for (int k = 0; k < 4; ++k)
            out[d->id][k] = {d->p[k][0] - 0.5, d->p[k][1] - 0.5};
    }
    apriltag_detections_destroy(found);
    apriltag_detector_destroy(detector);
    tag36h11_destroy(family);
    return out;
}

std::array<Eigen::Vector2d, 4> projectedCorners(const synthetic::Tag& tag,
                                                const CameraModel& camera,
                                                const RigidTransform& T_world_camera) {
    const RigidTransform T_camera_tag = T_world_camera.inverse() * tag.T_world_tag;
    const double h = tag.size / 2;
    const std::array<Eigen::Vector2d, 4> corners{{{-h, h}, {h, h}, {h, -h}, {-h, -h}}};
    std::array<Eigen::Vector2d, 4> out;
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d p = T_camera_tag * Eigen::Vector3d(corners[k].x(), corners[k].y(), 0);
        out[k] = camera.project({p.x() / p.z(), p.y() / p.z()});
    }
    return out;
}

double psnr(const cv::Mat3f& a, const cv::Mat3f& b) {
    const double mse = cv::norm(a, b, cv::NORM_L2SQR) / (3. * static_cast<double>(a.total()));
    return -10 * std::log10(std::max(mse, 1e-12));
}

}  // namespace mfar::test
