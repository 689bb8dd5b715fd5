#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/engine/occlusion_options.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/layer_rows.h"
#include "pipeline/simd/visibility_rows.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace mfar::simd {

/// A picture of the virtual objects alone, as the video camera sees them. This struct does not own
/// its memory. It is the counterpart in host memory of VirtualLayer, which has textures.
struct LayerRowsView {
    Rows<const std::uint32_t> colour;  ///< RGBA8, premultiplied by coverage
    /// z along the camera's axis [m]; 0: no surface. The z of shadows is multiplied by
    /// 1 - kShadowLift.
    Rows<const float> depth;
    PixelRect bounds;  ///< bounds of the covered pixels; empty: nothing is drawn
};

/// Depth of the real scene at every video pixel, in memory that this struct does not own.
struct RealDepth {
    /// `inverse`: inverse depth [1/m]. `sigma`: standard deviation of the inverse depth [1/m], or
    /// its variance [1/m^2] if `squared` is true.
    Rows<const float> inverse;
    Rows<const float> sigma;
    bool squared = false;

    [[nodiscard]] static RealDepth of(const InverseDepthField& field) {
        return {{field.inverseDepth.data(), field.size.width, field.size},
                {field.variance.data(), field.size.width, field.size},
                true};
    }
};

/// Draws a virtual layer over the picture of the real scene, except where real surfaces occlude it.
/// Processes only pixels within the layer's bounds. CPU version of the GLES engine's
/// LayerComposite.
class OcclusionStep {
public:
    /// `layer`: size of the layers. Null workers: all work runs in the caller's thread. Throws
    /// std::invalid_argument if an option is not finite or out of range.
    OcclusionStep(Size video, Size output, Size layer, const CompositeOptions& options,
                  std::shared_ptr<Workers> workers);

    /// Draws `layer` over `picture`, the RGBA8 picture of the frame at output size. `real`,
    /// `video`: depth and colours of the same frame. Real pixels occlude nothing if their inverse
    /// depth or sigma is NaN or outside the limits of params::kLeastInverseDepth. Layer pixels are
    /// drawn only if their depth is between the limits of params::kLeastVirtualDepth. If the
    /// layer's size differs from the output's, the layer's colours are interpolated linearly, and
    /// an output pixel gets the depth of one of the four surrounding layer pixels: of the one that
    /// is nearest in the picture and has a depth.
    void run(const LayerRowsView& layer, const RealDepth& real, const RgbPlanes& video,
             Rows<std::uint32_t> picture);

    [[nodiscard]] bool hides(double inverseDepth, double sigma, double inverse) const {
        return options_.hides(inverseDepth, sigma, inverse);
    }
    /// Visibility of the layer at each output pixel: 0 (occluded) to 255 (visible). Valid only in
    /// output pixels within the bounds of the last layer.
    [[nodiscard]] Rows<const std::uint8_t> visibility() const { return visibility_.rows(); }

private:
    /// Positions of output pixels in another picture, along one axis. Output pixel i is at the
    /// position first[i] + share[i] [px of the other picture]; share is in [0, 1).
    struct Between {
        Between(int pixels, int others);
        std::vector<std::int32_t> first;  ///< pixel before the position, or -1 before pixel 0
        std::vector<float> share;
    };
    using Plane = AlignedRows<float>;
    struct TwoRows {
        int above, below;
        float share;
    };
    struct Task;
    struct Strip;

    void prepareRow(const Task& task, int y);
    void drawRows(const Task& task, int base);
    void drawPart(const Task& task, Strip& strip, int y);
    void enlargeDepth(const Task& task, Strip& strip, int y) const;
    void enlargeColour(const Task& task, Strip& strip, int y) const;
    [[nodiscard]] TwoRows layerRowsAt(int y) const;
    [[nodiscard]] LayerColumns layerColumns(const Strip& strip) const;
    [[nodiscard]] SampleRow samplesOf(int y);
    [[nodiscard]] SampleWindow windowOf(int y);

    Size video_, output_, layer_;
    CompositeOptions options_;
    VisibilityParams params_;
    std::shared_ptr<Workers> workers_;
    Between columns_, rows_, layerColumns_, layerRows_;
    int longestStrip_;
    std::vector<std::int32_t> column_, sampleColumn_, layerLeft_, layerRight_;
    std::vector<std::uint32_t> layerShare_;
    std::vector<float> columnWeights_;
    Plane inverse_, variance_, red_, green_, blue_, nearest_, farthest_, greatest_, least_;
    AlignedRows<std::uint8_t> visibility_;
};

}  // namespace mfar::simd
