#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/simd/moving_mirrors.h"
#include "pipeline/simd/scratch_slots.h"
#include "pipeline/simd/view_rows.h"
#include "pipeline/warp/rerendered_pictures.h"
#include "pipeline/warp/traced_picture.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

class RestPixels;
class SurfaceRaster;

/// Converts `views`, the result of viewsOfObjects(), to a table with one transform for each of the
/// params::kSurfaceNumbers surface numbers. The table is empty if `views` is empty.
[[nodiscard]] std::vector<PointTransform> transformsByNumber(std::span<const RigidTransform> views);

/// A pixel of the layer whose colour is not completely known.
struct Hole {
    std::uint32_t pixel;
    std::uint32_t colour;  ///< known part of the colour, RGBA8 premultiplied
    /// isEdge: several surfaces meet in the pixel. isOpen: an object fills the pixel, and no
    /// picture shows the object there.
    bool isEdge, isOpen;
};

/// The pixels of the re-rendered pictures, in host memory. A picture is addressed by its slot (see
/// RerenderedPictures::Picture::slot).
class RerenderedStore {
public:
    using Rgba = std::array<std::uint8_t, 4>;
    struct Picture {
        std::vector<Rgba> colours;
        std::vector<LightWords> lights;     // empty if only colours are known
        std::vector<WarpSurface> surfaces;  // like `colours`, empty until rows are stored
    };
    explicit RerenderedStore(Size layer) : layer_(layer) {}
    void store(const RerenderedPictures::StoredRows& rows);
    [[nodiscard]] const Picture& operator[](int slot) const {
        return pictures_[static_cast<std::size_t>(slot)];
    }

private:
    Size layer_;
    std::array<Picture, RerenderedPictures::kPictures> pictures_;
};

/// Looks up the colour of every layer pixel that shows a surface. The colour comes from the traced
/// picture or, if that does not show an object, from RerenderedPictures. Plain pixels (see
/// lookUpRow()) are processed in vectors, all others one by one. Several threads process different
/// rows. CPU version of the GLES engine's ViewLookUp.
class ViewLookUp {
public:
    ViewLookUp(const LensProjection& layer, std::shared_ptr<Workers> workers);

    /// `traced` must remain valid until the next call of setTracedPicture().
    void setTracedPicture(const TracedPicture& traced);

    struct Input {
        const SurfaceRaster& raster;
        const RerenderedPictures& rerendered;
        const RerenderedStore& store;
        Eigen::Vector4d plane;
    };
    /// Writes every pixel of `where`. Up to 7 pixels to the right of `where` in the same rows
    /// become empty; all other pixels stay unchanged.
    void run(const Input& input, const RigidTransform& T_world_camera, const PixelRect& where);
    void clear(const PixelRect& where);

    [[nodiscard]] std::vector<Hole>& holes() { return holes_; }
    [[nodiscard]] Rows<std::uint32_t> colour() { return colour_.rows(); }  ///< RGBA8 premultiplied
    [[nodiscard]] Rows<const float> depth() const { return depth_.rows(); }
    [[nodiscard]] Rows<const std::uint32_t> state() const { return state_.rows(); }

private:
    struct Scratch {
        std::vector<std::uint32_t> left;  // indices of a row's pixels that are not plain
        std::vector<PaintWords> paint;
    };
    void runRow(const Input& input, const ViewLookUpInput& plain, const RestPixels& rest,
                const PixelRect& where, int y, Scratch& scratch);

    LensProjection layer_;
    std::shared_ptr<Workers> workers_;
    const TracedPicture* traced_ = nullptr;
    PointLens tracedLens_;
    AlignedRows<float> rayX_, rayY_, depth_;
    MovingMirrors mirrors_;
    AlignedRows<std::uint32_t> colour_, state_;
    ScratchSlots<Scratch> scratch_;
    std::vector<std::vector<Hole>> rowHoles_;
    std::vector<Hole> holes_;
};

}  // namespace mfar::simd
