#pragma once

#include "pipeline/simd/view_look_up.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mfar::simd {

/// The result of RestPixels for one pixel of the virtual layer.
struct RestPixel {
    std::uint32_t colour;  ///< RGBA8 premultiplied
    float depth;
    std::uint32_t state;  ///< see WarpStep::state()
    /// Set if the pixel's colour is not completely known. The caller must set Hole::pixel.
    std::optional<Hole> hole;
};

/// Looks up the pixels that lookUpRow() leaves out. These are edge pixels, whose quarters can show
/// different surfaces, and pixels that the traced picture does not show. An object that the traced
/// picture does not show is looked up in the re-rendered pictures. A pixel is composed of an object
/// and, below it, the shadow catcher. CPU version of warp_rest.comp.
class RestPixels {
public:
    /// `lights`: light of the traced picture's pixels as seen from T_world_camera, or empty if only
    /// their colours are known.
    RestPixels(const ViewLookUp::Input& input, const TracedPicture& traced,
               std::span<const LightWords> lights, const ViewLookUpInput& plain,
               const LensProjection& layer, const RigidTransform& T_world_camera);

    struct Asked {
        const std::uint32_t *upper, *lower;  ///< surfaces of the two upper and two lower quarters
        float rayX, rayY;
        PaintWords paint;
    };
    [[nodiscard]] RestPixel at(const Asked& asked) const;
    [[nodiscard]] bool needsPaint() const;

private:
    struct Colour {
        std::array<float, 4> rgba{};
    };
    struct View {
        std::span<const WarpSurface> surfaces;
        std::span<const std::array<std::uint8_t, 4>> colours;
        std::span<const LightWords> lights;  ///< empty if only colours are known
        Size size;
        PointTransform fromCamera;
        std::span<const PointTransform> ofNumbers;  ///< see ViewLookUpInput; empty if nothing moves
        const PointLens* lens;
        float share;
    };

    struct Wanted {
        Point3 point;
        float id;
        PaintWords paint;
    };
    static bool inView(const View& view, const Wanted& wanted, Point3& at);
    static bool lookUp(const View& view, const Point3& at, const Wanted& wanted, Colour& found);
    float known(const Wanted& wanted, Colour& found) const;

    const ViewLookUpInput& plain_;
    PointLens layerLens_;
    View traced_;
    std::array<View, RerenderedPictures::kPictures> rerendered_;
    std::array<std::vector<PointTransform>, RerenderedPictures::kPictures> ofNumbers_;
    int rerenderedCount_ = 0;
};

}  // namespace mfar::simd
