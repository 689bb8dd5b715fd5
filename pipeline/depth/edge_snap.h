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

/// Moves the edges of a depth picture to the edges of the video. Matching is ambiguous near a depth
/// edge, because the compared neighbourhoods contain both sides, and the other picture shows only a
/// part of one side. Therefore, pixels near an edge and pixels without depth get the depth of
/// pixels of similar colour that are farther from the edge. Source: Tomasi and Manduchi 1998
/// (weights); Ma et al., Constant time weighted median filtering for stereo matching, ICCV 2013
/// (depth by similarity of colours).
class EdgeSnap {
public:
    EdgeSnap(Size video, std::shared_ptr<Workers> workers);

    /// `frame` is the video frame of the depths `in`, in any format. Only pixels of `where` are
    /// processed; all other pixels of the result are unknown. Pixels that get the depth of other
    /// pixels are marked as `filled`.
    const InverseDepthField& run(const InverseDepthField& in, const ImageView& frame,
                                 const PixelRect& where);
    [[nodiscard]] const InverseDepthField& field() const { return out_; }
    [[nodiscard]] const PixelRect& where() const { return where_; }

private:
    void findEdges(const InverseDepthField& in, const PixelRect& where);
    void gatherVoters(const InverseDepthField& in, const ImageView& frame, const PixelRect& where);
    void takeRow(const InverseDepthField& in, const PixelRect& where, int y);
    void snapRow(const ImageView& frame, const PixelRect& where, int y);
    void decide(const PixelRect& where, int y, std::span<simd::OpenPixel> pixels);

    Size size_;
    std::shared_ptr<Workers> workers_;
    InverseDepthField out_;
    PixelRect where_;
    // Per pixel: 1 if its depth is taken from pixels of similar colour, else 0.
    std::vector<std::uint8_t> open_;
    // low_, high_: for each pixel, the smallest and the largest inverse depth near it in its row.
    std::vector<float> low_, high_;
    struct {
        AlignedRows<float> inverseDepth, variance, red, green, blue;
    } voters_;
};

}  // namespace mfar
