#include "pipeline/warp/warp_params.h"

#include <algorithm>
#include <cmath>

namespace mfar {

void storeRows(float (&rows)[3][4], const RigidTransform& T, double scale) {
    const Eigen::Matrix3d R = scale * T.rotation.toRotationMatrix();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            rows[i][j] = static_cast<float>(R(i, j));
        rows[i][3] = static_cast<float>(T.translation[i]);
    }
}

void storeLens(float (&pinhole)[4], float (&distortion)[4], float (&lens)[4],
               const LensProjection& projection) {
    const CameraModel& c = projection.camera;
    const auto& k = c.distortion;
    const double values[3][4] = {
        {c.fx, c.fy, c.cx, c.cy},
        {k[0], k[1], k[2], k[3]},
        {k[4], projection.rim, projection.rimRadial, LensProjection::kNear},
    };
    std::copy_n(values[0], 4, pinhole);
    std::copy_n(values[1], 4, distortion);
    std::copy_n(values[2], 4, lens);
}

PixelRect pixelsAround(const Eigen::AlignedBox2d& box, int margin, Size picture) {
    const auto held = [margin](double v, int side) {
        return static_cast<int>(std::clamp(v, -1.0 - margin, side + 1.0 + margin));
    };
    return common({held(std::floor(box.min().x()), picture.width) - margin,
                   held(std::floor(box.min().y()), picture.height) - margin,
                   held(std::ceil(box.max().x()), picture.width) + 1 + margin,
                   held(std::ceil(box.max().y()), picture.height) + 1 + margin},
                  {0, 0, picture.width, picture.height});
}

}  // namespace mfar
