#pragma once

#include "pipeline/simd/view_look_up.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace mfar::simd {

/// Result of looking up a pixel of the layer.
struct RestPixel {
    std::uint32_t colour;  ///< RGBA8 premultiplied
    float depth;
    std::uint32_t state;       ///< see WarpStep::state()
    std::optional<Hole> hole;  ///< without its index
};

/// Pixels for which lookUpRow() is not enough: edges, covered by quarters, and pixels that the
/// reference picture does not show but the re-rendered patches may. Objects and the shadow on the
/// real surface are two layers, the shadow below (warp_rest.comp).
class RestPixels {
public:
    /// `lights`: those of the reference, for this view.
    RestPixels(const ViewLookUp::Input& input, const WarpReference& reference,
               std::span<const LightWords> lights, const ViewLookUpInput& plain,
               const LensProjection& layer, const RigidTransform& T_world_camera);

    /// A pixel of the layer.
    struct Asked {
        const std::uint32_t *upper, *lower;  ///< two words each
        float rayX, rayY;
        PaintWords paint;
    };
    [[nodiscard]] RestPixel at(const Asked& asked) const;
    /// Whether any picture stores light without paint.
    [[nodiscard]] bool needsPaint() const;

private:
    struct Colour {
        std::array<float, 4> rgba{};  // [0, 255]
    };
    /// A picture in which surfaces are looked up.
    struct View {
        std::span<const WarpSurface> surfaces;
        std::span<const std::array<std::uint8_t, 4>> colours;
        std::span<const LightWords> lights;  ///< empty: only colours are known
        Size size;
        PointTransform fromCamera;
        const PointLens* lens;
        float share;
    };

    static bool inView(const View& view, const Point3& point, Point3& at);
    /// The surface to look up.
    struct Wanted {
        Point3 point;
        float id;
        PaintWords paint;
    };
    static bool lookUp(const View& view, const Point3& at, const Wanted& wanted, Colour& found);
    float known(const Wanted& wanted, Colour& found) const;

    const ViewLookUpInput& plain_;
    PointLens layerLens_;
    View reference_;
    std::array<View, PatchPictures::kPatches> patches_;
    int patchCount_ = 0;
};

}  // namespace mfar::simd
