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

/// `cubic`: see Quality. `enlargedTiles`, `plainTiles`: see SkipOptions.
struct DetailOptions {
    SuperResMode mode;
    bool cubic;
    bool enlargedTiles, plainTiles;
    /// Learned filters that enlarge the matched tiles in mode Detail, see detailRow(). If null, the
    /// video is sharpened instead in mode Detail, provided that DetailInput::still has data.
    const FilterBank* learned = nullptr;
};

struct DetailInput {
    const RgbPlanes& video;
    const TileWork& work;
    // Mode Blend uses `picture` (RGBA8), mode Detail uses `still` (luma), and mode Off uses
    // neither. If the one that is used has no data, the video is only enlarged.
    StillPairs still{};
    Rows<const std::uint32_t> picture{};
    // These fields have one entry per 4x4 video pixels. They are read only if the picture that the
    // mode uses (`still` or `picture`) has data.
    Rows<const WeighedCell> weighed;
    Rows<const LookUpCell> lookUps;
    Rows<const TrustCell> trust;
    /// A second still, which is shown where its weight exceeds the first still's weight by more
    /// than params::kSecondFrom. It is used only in mode Detail, and only if both stills have data.
    struct Second {
        StillPairs still{};
        Rows<const WeighedCell> weighed{};
        Rows<const LookUpCell> lookUps{};
        Rows<const TrustCell> trust{};
    };
    Second second{};
};

/// Draws the high-resolution picture from video, still and flow on the CPU. Memory is allocated
/// only in the constructor.
///
/// Each pixel differs from the result of the GLES engine's DetailPainter by at most a grey level.
/// Exceptions are pixels near the border of a drawn tile, which also depend on sharpened pixels of
/// the neighbouring tile. The GLES engine can use sharpened pixels of an older frame there; this
/// class always uses those of the current frame.
class DetailStep {
public:
    /// `stillRig`: see StillPreparation::rig(). `output`: size of the whole enlarged video.
    DetailStep(const StereoRig& stillRig, Size output, std::shared_ptr<Workers> workers);

    /// Draws the tiles for which TileWork::draws() is true; `out` keeps its pixels in the other
    /// tiles. `out` must be an RGBA8 picture of the output's size. R is in the lowest byte; drawn
    /// pixels get alpha 255.
    TileSummary draw(const DetailInput& in, const DetailOptions& options, Rows<std::uint32_t> out);
    [[nodiscard]] const std::vector<TileClass>& classes() const { return classes_.classes(); }

private:
    enum class Show : std::uint8_t { Nothing, Video, Detail, BothStills };
    struct Segment {
        int begin, end;
        Show show;
        bool learned;
    };
    struct Frame;
    struct Scratch {
        Scratch(const DetailStep& step);
        VideoRows video;
        LookUpRowCache lookUps;
        WarpedStill warped, second;
        LearnedRows learned;
        WarpedRow detail{}, secondDetail{};
        AlignedRows<std::int16_t> added;
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
    static const std::int16_t* detailOf(Scratch& scratch, const Segment& segment,
                                        const std::int16_t* learned, int y);

    Size video_, output_, tiles_;
    std::shared_ptr<Workers> workers_;
    VideoTaps videoTaps_;
    LearnedTaps learnedTaps_;
    LookUpTaps lookUpTaps_;
    WarpedStillTaps warpedTaps_;
    // First output column and row of each tile. The last entry is the output's width or height.
    std::vector<int> columnsAt_, rowsAt_;
    TileClasses classes_;
    std::vector<Show> shows_;
    ScratchSlots<Scratch> scratch_;
};

}  // namespace mfar::simd
