#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/track/tag_detector.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

namespace mfar::test {

inline constexpr double kDegree = std::numbers::pi / 180;

struct PlacedTag {
    TagKey tag;
    double size = 0.1;  ///< edge length between the detected corners [m]
    RigidTransform T_world_tag;
};

struct GrayPicture {
    Size size;
    std::vector<std::uint8_t> pixels;

    GrayPicture(Size pictureSize, std::uint8_t value)
        : size(pictureSize),
          pixels(static_cast<std::size_t>(pictureSize.width) * pictureSize.height, value) {}
    [[nodiscard]] ImageView view() const {
        return {pixels.data(), size, static_cast<std::size_t>(size.width), PixelFormat::Gray8};
    }
};

struct SensorLook {
    double gamma = 2.2;  ///< grey = 255 light^(1 / gamma)
    double noise = 0;    ///< standard deviation [grey levels]
    unsigned seed = 1;
    double dark = 0.03;  ///< light of the tags' dark cells, from 0 to 1
    double bright = 0.8;
};

/// Renders tags with their white borders on a grey ground, through the lens, with 4x4 rays per
/// pixel.
[[nodiscard]] GrayPicture renderTags(const CameraModel& camera,
                                     const RigidTransform& T_world_camera,
                                     const std::vector<PlacedTag>& tags,
                                     const SensorLook& look = {});

/// True positions of the tag's corners in the picture, in the order of TagDetection::corners.
[[nodiscard]] std::array<Eigen::Vector2d, 4>
cornersOf(const CameraModel& camera, const RigidTransform& T_world_camera, const PlacedTag& tag);

[[nodiscard]] CameraModel testCamera();

/// Pose of a camera at `distance` in front of the world's origin. It looks at the origin along +z,
/// is rotated about the origin by pitch (about x) and yaw (about y), and is then rolled [rad].
[[nodiscard]] RigidTransform cameraAt(double distance, double pitch, double yaw, double roll = 0);

[[nodiscard]] double angleBetween(const RigidTransform& a, const RigidTransform& b);

}  // namespace mfar::test
