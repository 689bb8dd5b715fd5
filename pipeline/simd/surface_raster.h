#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/simd/paint_textures.h"
#include "pipeline/simd/surface_rows.h"
#include "pipeline/warp/silhouette_models.h"

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// Rasterises the visible surfaces of the virtual scene: the objects and, behind them, the shadow
/// catcher. The grid has twice the layer's resolution, so a pixel of the layer has four quarters.
/// Lens distortion is applied to the triangles' corners. draw() determines the surfaces, and
/// paintRow() their colours without light. CPU version of the GLES engine's ModelSilhouette.
class SurfaceRaster {
public:
    /// `layer`: the camera at the layer's resolution. If `workers` is null, all work runs in the
    /// caller's thread.
    SurfaceRaster(const CameraModel& layer, std::shared_ptr<Workers> workers);

    void setScene(const Scene& scene);
    void setPoses(std::span<const RigidTransform> T_world_objects) {
        models_.setPoses(T_world_objects);
    }
    [[nodiscard]] const SilhouetteModels& models() const { return models_; }

    /// Draws within `where` [layer px]. Pixels elsewhere become invalid.
    void draw(const RigidTransform& T_world_camera, const PixelRect& where);
    /// Surfaces at twice the layer's size: z and number, packed as in warp_surface.glsl, or 0
    /// without a surface. Objects hide the shadow catcher, even if the catcher is nearer.
    [[nodiscard]] Rows<const std::uint32_t> surface() const { return words_.rows(); }
    /// Writes the paint (see paint_rows.h) of the layer's pixels [x0, x1) in row `y`, which must be
    /// within the rectangle of the last draw(). Up to 7 entries of `out` after the last pixel are
    /// overwritten. Several threads may call this at the same time.
    void paintRow(int y, int x0, int x1, PaintWords* out) const;

private:
    /// A part of a model. `corners`: rows of x, y and z in the model's coordinates, before
    /// SilhouetteModels::Object::scale is applied.
    struct Part {
        explicit Part(const SilhouetteModels::Part& from);
        const SilhouetteModels::Part* source;
        AlignedRows<float> corners;
    };
    using Shape = SilhouetteModels::Shape;
    using Parts = std::vector<std::shared_ptr<const Part>>;
    struct Placed {
        const SilhouetteModels::Object* object;
        std::uint32_t word;
        std::shared_ptr<const Part> part;
        AlignedRows<float> seen;  // projected corners: x and y [grid px], z [m]
        PointTransform view{};
        bool isInView = false;
        std::uint32_t firstTriangle = 0;
    };
    struct Chunk {
        Placed* placed;
        int first, count;
    };
    struct Batch {
        const Placed* placed;
        std::size_t first, last;
        std::vector<RasterTriangle> triangles;
        std::vector<MaskedTriangle> masked;
    };

    void place(const SilhouetteModels::Object& object, std::uint32_t word, const Parts& parts);
    void makeReady(Batch& batch);
    void addSeen(Batch& batch, std::size_t triangle);
    void addClipped(Batch& batch, std::size_t triangle);
    bool addTriangle(Batch& batch, const RasterCorner (&corners)[3], std::uint32_t index) const;
    void setPaint(const Placed& placed, const RasterCorner (&corners)[3], std::uint32_t index);
    void drawBand(const RasterBand& band) const;

    SilhouetteModels models_;
    PointLens lens_;
    std::shared_ptr<Workers> workers_;
    std::map<std::shared_ptr<const Shape>, Parts> parts_;
    std::deque<Placed> placed_;
    std::vector<Chunk> chunks_;
    std::vector<Batch> batches_;
    PixelRect grid_;
    AlignedRows<std::uint32_t> words_, indices_;
    PaintTextures paint_;
    std::vector<PaintTriangle> paintTriangles_;
};

[[nodiscard]] PointLens pointLensOf(const LensProjection& lens);
[[nodiscard]] PointTransform pointTransformOf(const RigidTransform& T, double scale = 1);

}  // namespace mfar::simd
