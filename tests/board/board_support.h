#pragma once

#include "hal/virtual/synthetic_board.h"

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <array>
#include <cstdint>
#include <map>

namespace mfar::test {

/// Returns the simulated board that shows this scene. The board delivers pictures as fast as they
/// are fetched, and it lives until the program ends.
SyntheticBoard& sharedBoard(synthetic::Scene scene);

/// Options of a board with small pictures, which take less time to render and to write.
SyntheticOptions smallBoard(int frames = 0, std::uint64_t seed = 1);

cv::Mat1b grey(const ImageView& image);
/// Copy of a picture with values in [0, 1], in the picture's order of channels.
cv::Mat3f colour(const StoredImage& image);

/// Corners [px] of the 36h11 tags that libapriltag finds, by tag id. Order of the corners: bottom
/// left, bottom right, top right, top left.
std::map<int, std::array<Eigen::Vector2d, 4>> detectTags(const cv::Mat1b& picture);
/// True positions [px] of a tag's corners, in the order of detectTags().
std::array<Eigen::Vector2d, 4> projectedCorners(const synthetic::Tag& tag,
                                                const CameraModel& camera,
                                                const RigidTransform& T_world_camera);

double psnr(const cv::Mat3f& a, const cv::Mat3f& b);

}  // namespace mfar::test
