#pragma once

#include "base/rows.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/simd/point_lens.h"
#include "pipeline/warp/warp_reference.h"

#include <optional>

namespace mfar::simd {

/// The depth of the reference moved to the current pose (paper, eq. 5), apart for objects and the
/// catcher: DepthSplat on the host. The look-up by the models' own depth needs none of it; it is
/// the method that is compared with.
class DepthSplat {
public:
    explicit DepthSplat(const LensProjection& layer);

    /// The layer's pixels of `where` alone are valid afterwards.
    void run(const WarpReference& reference, const RigidTransform& T_world_camera,
             const PixelRect& where);
    [[nodiscard]] Rows<const float> objects() const { return objects_.rows(); }  ///< z [m], 0 none
    [[nodiscard]] Rows<const float> catcher() const { return catcher_.rows(); }  ///< the same

private:
    void splat(AlignedRows<float>& to, const Point3& at, const PixelRect& where) const;

    PointLens lens_;
    AlignedRows<float> objects_, catcher_, rayX_, rayY_;
    std::optional<CameraModel> raysOf_;
};

}  // namespace mfar::simd
