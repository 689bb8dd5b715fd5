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

/// Aligns the edges of a depth field with those of the picture. Matching cannot decide on which
/// side of a depth edge a pixel near the edge lies: the windows that are compared reach across the
/// edge, and a part of one side is occluded in the other picture. So a pixel near an edge, or of
/// unknown depth, gets the depth of pixels of similar colour that are farther from the edge.
/// Source: Tomasi and Manduchi 1998 (weights); Ma et al., Constant time weighted median filtering
/// for stereo matching, ICCV 2013 (depth by similarity of colours).
class EdgeSnap {
public:
    EdgeSnap(Size video, std::shared_ptr<Workers> workers);

    /// `frame`: the video frame that the depth field `in` belongs to, in any format. Processes only
    /// the pixels of `where`; all other pixels of the result are unknown. Pixels that get the depth
    /// of other pixels are marked as `filled`.
    const InverseDepthField& run(const InverseDepthField& in, const ImageView& frame,
                                 const PixelRect& where);
    /// The result of the last run.
    [[nodiscard]] const InverseDepthField& field() const { return out_; }
    /// The argument `where` of the last run.
    [[nodiscard]] const PixelRect& where() const { return where_; }

private:
    void findEdges(const InverseDepthField& in, const PixelRect& where);
    void gatherVoters(const InverseDepthField& in, const ImageView& frame, const PixelRect& where);
    /// Copies the valid depths of row y unchanged; other pixels of the row become unknown.
    void takeRow(const InverseDepthField& in, const PixelRect& where, int y);
    void snapRow(const ImageView& frame, const PixelRect& where, int y);
    void decide(const PixelRect& where, int y, std::span<simd::OpenPixel> pixels);

    Size size_;
    std::shared_ptr<Workers> workers_;
    InverseDepthField out_;
    PixelRect where_;
    std::vector<std::uint8_t> open_;  // per pixel: 1 if colours decide its depth
    std::vector<float> low_, high_;   // per pixel: range of the inverse depths around it along its
                                      // row
    /// Memory that simd::Voters refers to.
    struct {
        AlignedRows<float> inverseDepth, variance, red, green, blue;
    } voters_;
};

}  // namespace mfar
