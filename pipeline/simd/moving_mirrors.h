#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/simd/mirror_rows.h"
#include "pipeline/warp/traced_picture.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// Computes the light of a traced picture's objects as seen from another position. Mirrored distant
/// light is computed again from each pixel's normal and roughness. So mirror images and highlights
/// move as in the scene, instead of sticking to the surface.
class MovingMirrors {
public:
    /// `rayX`, `rayY`: rays (x, y, 1) through the layer's pixels. If `workers` is null, all work
    /// runs in the caller's thread.
    MovingMirrors(const CameraModel& layer, Rows<const float> rayX, Rows<const float> rayY,
                  std::shared_ptr<Workers> workers);

    /// `traced` must live until the next call of setTracedPicture().
    void setTracedPicture(const TracedPicture& traced);
    /// Returns TracedPicture::light as seen from the position `eye` in the world, valid until the
    /// next call of a member function. Returns the light unchanged if the pixels' gloss or the
    /// mirrored light (TracedPicture::mirrors) is unknown, or if the traced picture has another
    /// camera model than the layer.
    [[nodiscard]] std::span<const LightWords> lightFor(const Eigen::Vector3d& eye);

private:
    template <class T>
    [[nodiscard]] T* firstOf(std::vector<T>& of, int y) const {
        return of.data() + static_cast<std::ptrdiff_t>(y) * layer_.size.width + traced_->bounds.x0;
    }
    [[nodiscard]] MirrorInput inputFor(const Eigen::Vector3d& eye) const;
    [[nodiscard]] MirrorRow rowAt(int y) const;
    void prepareTables();
    template <class Body>
    void forRows(const Body& body) const;

    CameraModel layer_;
    Rows<const float> rayX_, rayY_;
    std::shared_ptr<Workers> workers_;
    const TracedPicture* traced_ = nullptr;
    std::shared_ptr<const MirrorLight> mirrors_;
    std::vector<std::int32_t> tables_, tableOf_;
    std::vector<float> shareOf_, alphaOf_;
    bool moves_ = false;
    Eigen::Vector3d eye_;
    std::vector<std::uint32_t> packed_;
    std::vector<GlossWords> gloss_;
    std::vector<MirrorParts> parts_;
    std::vector<LightWords> light_;
};

}  // namespace mfar::simd
