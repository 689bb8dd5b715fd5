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
    bool cubic;                      ///< see Quality
    bool upscaledTiles, plainTiles;  ///< see SkipOptions
    /// Filters that enlarge tiles with structure in mode Detail, as far as the still's detail has a
    /// weight below one; no tile is sharpened then. Null: tiles are sharpened as usual.
    const FilterBank* learned = nullptr;
};

struct DetailInput {
    const RgbPlanes& video;
    const TileWork& work;
    // The still's luma or, in mode Blend, its RGBA8 picture. If neither has data, the video is only
    // enlarged.
    StillPairs still{};
    Rows<const std::uint32_t> picture{};
    // Read only if there is a still; one entry per 4x4 video pixels.
    Rows<const WeighedCell> weighed;
    Rows<const LookUpCell> lookUps;
    Rows<const TrustCell> trust;
    /// A second still, shown where its weight is larger than the first still's; only in mode
    /// Detail. Without data, there is no second still.
    struct Second {
        StillPairs still{};
        Rows<const WeighedCell> weighed{};
        Rows<const LookUpCell> lookUps{};
        Rows<const TrustCell> trust{};
    };
    Second second{};
};

/// Turns video, still and flow into the high-resolution picture on the CPU. The result differs from
/// that of the GLES engine's DetailPainter by at most a grey level. There, tiles next to drawn
/// tiles may be sharpened from an older frame; here, they always belong to this frame. Allocates
/// memory only in the constructor.
class DetailStep {
public:
    /// `stillRig`: see StillPreparation::rig(). `output`: size of the whole enlarged video.
    DetailStep(const StereoRig& stillRig, Size output, std::shared_ptr<Workers> workers);

    /// Draws the tiles of `work` into `out`, which is RGBA8 (R in the lowest byte, alpha 255) and
    /// has the output's size. Other tiles keep their pixels.
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
        WarpedRow detail{}, secondDetail{};  // current row
        AlignedRows<std::int16_t> added;     // one row for each still
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
    /// Returns what is added to the video's pixels: the detail of the stills and, where their
    /// weights leave a share, the residual of the learned filters.
    static const std::int16_t* detailOf(Scratch& scratch, const Segment& segment,
                                        const std::int16_t* learned, int y);

    Size video_, output_, tiles_;
    std::shared_ptr<Workers> workers_;
    VideoTaps videoTaps_;
    LearnedTaps learnedTaps_;
    LookUpTaps lookUpTaps_;
    WarpedStillTaps warpedTaps_;
    std::vector<int> columnsAt_, rowsAt_;  // first output pixel of each tile, followed by the
                                           // output's size
    TileClasses classes_;
    std::vector<Show> shows_;  // per tile
    ScratchSlots<Scratch> scratch_;
};

}  // namespace mfar::simd
