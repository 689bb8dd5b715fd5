#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/simd/edge_rows.h"

#include <memory>
#include <span>
#include <vector>

namespace mfar {

/// Puts the edges of a depth field onto those of the picture. Matching cannot tell on which side of
/// a depth edge the pixels beside it lie: its windows reach across, and one side is hidden in the
/// other picture. Pixels near an edge, and unknown ones, are given the surface of those farther
/// away from it that look like them. Source: Tomasi and Manduchi 1998 (weights); Ma et al.,
/// Constant time weighted median filtering for stereo matching, ICCV 2013 (depth by the likeness of
/// colours).
class EdgeSnap {
public:
    EdgeSnap(Size video, std::shared_ptr<Workers> workers);

    /// `frame`: the picture that `in` belongs to, of any format. Works on the pixels of `where`
    /// alone; nothing is known elsewhere afterwards. What was given by likeness is marked as
    /// filled.
    const InverseDepthField& run(const InverseDepthField& in, const ImageView& frame,
                                 const PixelRect& where);
    /// Of the last run.
    [[nodiscard]] const InverseDepthField& field() const { return out_; }
    /// Where it worked.
    [[nodiscard]] const PixelRect& where() const { return where_; }

private:
    void findEdges(const InverseDepthField& in, const PixelRect& where);
    void gatherVoters(const InverseDepthField& in, const ImageView& frame, const PixelRect& where);
    /// As it is, where it is sound.
    void takeRow(const InverseDepthField& in, const PixelRect& where, int y);
    void snapRow(const ImageView& frame, const PixelRect& where, int y);
    void decide(const PixelRect& where, int y, std::span<simd::OpenPixel> pixels);

    Size size_;
    std::shared_ptr<Workers> workers_;
    InverseDepthField out_;
    PixelRect where_;
    std::vector<std::uint8_t> open_;  // 1: to be decided by likeness
    std::vector<float> low_, high_;   // rho along a row
    /// simd::Voters' memory.
    struct {
        AlignedRows<float> rho, variance, red, green, blue;
    } voters_;
};

}  // namespace mfar
