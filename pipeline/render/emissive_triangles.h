#pragma once

#include "pipeline/render/share_table.h"
#include "pipeline/render/traced_scene.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// The triangles of a scene's objects that emit light. A triangle is selected with a probability
/// proportional to its power (area times luminance of its mean emission). All points on it are
/// equally probable. Backs of single-sided triangles do not emit.
class EmissiveTriangles {
public:
    EmissiveTriangles() = default;
    /// The scene must outlive this object.
    explicit EmissiveTriangles(const TracedScene& scene);
    /// Copies `other` for the same scene with objects in other poses. Areas and emission are kept,
    /// so this takes little time.
    EmissiveTriangles(const EmissiveTriangles& other, const TracedScene& posed);

    /// True if no triangle emits light.
    [[nodiscard]] bool dark() const { return table_.empty(); }

    /// A point on an emissive triangle as seen from another point.
    struct Sample {
        Ray ray;            ///< towards `point`, direction of unit length; ends a little behind it
        RayHit point;       ///< the sampled point, as the ray's hit
        float density = 0;  ///< probability density of the direction [1/sr]; 0: no point was found
    };
    /// Samples a point. `u` decides both the triangle and the point on it, so that well distributed
    /// numbers give well distributed points on a lamp of few triangles. `fine` adds bits to
    /// u.x, whose own bits are too few for a large number of triangles. All numbers are in [0, 1).
    /// Must not be called if dark().
    [[nodiscard]] Sample sample(const Eigen::Vector3f& from, const Eigen::Vector2f& u,
                                float fine) const;
    /// Probability density [1/sr] with which sample() gives the direction of `ray` and a point of
    /// the hit triangle. `ray` must have a direction of unit length and `hit` must be its hit. Does
    /// not check that the hit side of the triangle emits light.
    [[nodiscard]] float density(const Ray& ray, const RayHit& hit) const;

private:
    struct Triangle {
        std::uint32_t mesh, index;
    };
    struct Weighed;
    [[nodiscard]] float density(const Triangle& triangle, const Eigen::Vector3f& direction,
                                float distance) const;

    const TracedScene* scene_ = nullptr;
    std::vector<Triangle> triangles_;
    ShareTable table_;
    // Probability density by area [1/m^2] of the triangles of each mesh. Empty for a mesh without
    // emission.
    std::vector<std::vector<float>> densities_;
};

}  // namespace mfar
