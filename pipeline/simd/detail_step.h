#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/quality.h"
#include "pipeline/simd/detail_kernels.h"
#include "pipeline/simd/learned_rows.h"
#include "pipeline/simd/look_up_rows.h"
#include "pipeline/simd/scratch_slots.h"
#include "pipeline/simd/tile_classes.h"
#include "pipeline/simd/video_rows.h"
#include "pipeline/simd/warped_still.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace mfar::simd {

struct DetailOptions {
    SuperResMode mode;
    bool cubic;                      ///< true: cubic enlargement, see Quality
    bool upscaledTiles, plainTiles;  ///< whether work is skipped in these tiles, see SkipOptions
    /// Learned filters. In mode Detail, they enlarge the matched tiles; where the still's detail
    /// has a weight, their contribution is multiplied by one minus this weight. No tile is
    /// sharpened then. Null: no learned filters, and tiles are sharpened.
    const FilterBank* learned = nullptr;
};

struct DetailInput {
    const RgbPlanes& video;
    const TileWork& work;
    // The still's luma or, in mode Blend, its RGBA8 picture. If neither has data, the video is only
    // enlarged.
    StillPairs still{};
    Rows<const std::uint32_t> picture{};
    // These fields are read only if there is a still. They have one entry per 4x4 video pixels.
    Rows<const WeighedCell> weighed;
    Rows<const LookUpCell> lookUps;
    Rows<const TrustCell> trust;
    /// A second still. It is shown where its weight is larger than the weight of the first still;
    /// only in mode Detail. If `still` has no data, there is no second still.
    struct Second {
        StillPairs still{};
        Rows<const WeighedCell> weighed{};
        Rows<const LookUpCell> lookUps{};
        Rows<const TrustCell> trust{};
    };
    Second second{};
};

/// Turns video, still and flow into the high-resolution picture on the CPU. The result differs from
/// the result of the GLES engine's DetailPainter by at most a grey level, apart from one case: near
/// the border of a drawn tile, sharpening also reads the tile beside it, which the GLES engine may
/// have sharpened from an older frame; here, it is always sharpened from this frame. Allocates
/// memory only in the constructor.
class DetailStep {
public:
    /// `stillRig`: see StillPreparation::rig(). `output`: size of the whole enlarged video.
    DetailStep(const StereoRig& stillRig, Size output, std::shared_ptr<Workers> workers);

    /// Draws the tiles that `work` says are drawn into `out`, a picture in RGBA8 (R in the lowest
    /// byte, alpha 255) of the output's size. Other tiles keep their pixels.
    TileSummary draw(const DetailInput& in, const DetailOptions& options, Rows<std::uint32_t> out);
    /// Class of each tile in the last draw(), row-major.
    [[nodiscard]] const std::vector<TileClass>& classes() const { return classes_.classes(); }

private:
    enum class Show : std::uint8_t { Nothing, Video, Detail, BothStills };
    /// Pixels of a row that are drawn in the same way.
    struct Segment {
        int begin, end;
        Show show;
        bool learned;
    };
    struct Frame;
    struct Scratch {
        Scratch(const DetailStep& step);
        VideoRows video;
        LookUpRowCache lookUps;  // for mode Blend
        WarpedStill warped, second;
        LearnedRows learned;
        WarpedRow detail{}, secondDetail{};  // the current row of both stills
        AlignedRows<std::int16_t> added;     // one row of added detail for each still
        std::vector<Segment> segments;
        PixelSpans learnedSpans, detailSpans, secondSpans;
    };

    [[nodiscard]] Show showOf(const Frame& frame, int column, int row) const;
    void choose(const Frame& frame);
    void drawPart(const Frame& frame, Scratch& scratch, int first, int last) const;
    void drawTileRow(const Frame& frame, Scratch& scratch, int row, int first, int last) const;
    void drawStrip(const Frame& frame, Scratch& scratch, const PixelRect& strip) const;
    void cut(const Frame& frame, int row, int begin, int end, Scratch& scratch) const;
    void drawRow(const Frame& frame, Scratch& scratch, int y) const;
    /// Returns what is added to the pixels of the enlarged video: the detail of the stills and,
    /// where the weight of this detail is below one, also the residual of the learned filters.
    static const std::int16_t* detailOf(Scratch& scratch, const Segment& segment,
                                        const std::int16_t* learned, int y);

    Size video_, output_, tiles_;
    std::shared_ptr<Workers> workers_;
    VideoTaps videoTaps_;
    LearnedTaps learnedTaps_;
    LookUpTaps lookUpTaps_;
    WarpedStillTaps warpedTaps_;
    std::vector<int> columnsAt_, rowsAt_;  // first output column and row of each tile; the last
                                           // entry is the output's width or height
    TileClasses classes_;
    std::vector<Show> shows_;  // per tile
    ScratchSlots<Scratch> scratch_;
};

}  // namespace mfar::simd
