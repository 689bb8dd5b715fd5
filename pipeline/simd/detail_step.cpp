#include "pipeline/simd/detail_step.h"

#include "pipeline/plan/tile_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar::simd {
namespace {

constexpr int kGrain = 32;
// If a whole frame is drawn, it is split into strips of about this width [px], so that intermediate
// rows stay in the first-level cache. A strip's width is a multiple of kStripStep.
constexpr int kStripWidth = 576;
constexpr int kStripStep = 64;

/// Returns, for each tile along one axis, the first output pixel whose centre lies in the tile.
/// One more entry contains the output's size.
std::vector<int> tileStarts(int tiles, int video, int output) {
    std::vector<int> out;
    for (int i = 0; i <= tiles; ++i)
        out.push_back(outputPixelsBefore(i, video, output));
    return out;
}

int tileAt(const std::vector<int>& starts, int pixel) {
    return static_cast<int>(std::ranges::upper_bound(starts, pixel) - starts.begin()) - 1;
}

}  // namespace

struct DetailStep::Frame {
    const DetailInput& in;
    DetailOptions options;
    Rows<std::uint32_t> out;
    // `warps`: true if the still's detail is added to the video. `blends`: true if the still's
    // picture is blended over the video; `warps` is then false. `linear`: true if the video is
    // enlarged linearly, false if by Keys' cubic.
    bool warps, blends, linear;
    const FilterBank* bank;
    BlendPicture picture;
    const DetailStep& step;
};

DetailStep::Scratch::Scratch(const DetailStep& step)
    : video(step.video_, step.output_.width), lookUps(step.lookUpTaps_.cells, step.output_.width),
      warped(step.video_, step.output_, step.warpedTaps_),
      second(step.video_, step.output_, step.warpedTaps_), learned(step.video_, step.output_.width),
      added({step.output_.width, 2}) {
    segments.reserve(step.tiles_.width);
    learnedSpans.reserve(step.tiles_.width);
    detailSpans.reserve(step.tiles_.width);
    secondSpans.reserve(step.tiles_.width);
}

DetailStep::DetailStep(const StereoRig& stillRig, Size output, std::shared_ptr<Workers> workers)
    : video_(stillRig.video.size), output_(output), tiles_(tilesOf(video_)),
      workers_(std::move(workers)), videoTaps_(video_, output), learnedTaps_(video_, output),
      lookUpTaps_(stillRig, output), warpedTaps_(video_, output),
      columnsAt_(tileStarts(tiles_.width, video_.width, output.width)),
      rowsAt_(tileStarts(tiles_.height, video_.height, output.height)), classes_(video_),
      shows_(static_cast<std::size_t>(tiles_.width) * tiles_.height),
      scratch_(workers_->count(), [this] { return Scratch(*this); }) {}

DetailStep::Show DetailStep::showOf(const Frame& frame, int column, int row) const {
    const TileWork& work = frame.in.work;
    const TileWork::Tile& tile = work.at(column, row);
    if (!work.drawsWhole() && tile.changed == 0) return Show::Nothing;
    if (!frame.warps && !frame.blends) return Show::Video;
    if (classes_.showsSecond(column, row)) return Show::BothStills;
    const bool enlarged = classes_.at(column, row) == TileClass::Enlarged;
    if (work.draw != TileWork::Draw::Whole) return enlarged ? Show::Video : Show::Detail;
    const PixelRect& in = work.detailTiles;
    if (!(column >= in.x0 && column < in.x1 && row >= in.y0 && row < in.y1)) return Show::Video;
    // The class Enlarged does not imply that the still has no weight in the tile: unmatched tiles
    // have this class too. At the border between a matched and an unmatched tile, weights are
    // interpolated between the cells of both tiles, so they are above 0 in the unmatched tile, too.
    const bool weightless =
        enlarged && tile.matched != 0 && frame.options.mode == SuperResMode::Detail;
    return weightless ? Show::Video : Show::Detail;
}

void DetailStep::choose(const Frame& frame) {
    for (int row = 0; row < tiles_.height; ++row)
        for (int column = 0; column < tiles_.width; ++column)
            shows_[static_cast<std::size_t>(row) * tiles_.width + column] =
                showOf(frame, column, row);
}

TileSummary DetailStep::draw(const DetailInput& in, const DetailOptions& options,
                             Rows<std::uint32_t> out) {
    const bool blends = options.mode == SuperResMode::Blend;
    const bool usesStill = options.mode != SuperResMode::Off &&
                           (blends ? in.picture.data != nullptr : in.still.data != nullptr);
    using Match = TileClasses::Match;
    const bool usesSecond = usesStill && !blends && in.second.still.data != nullptr;
    const TileSummary summary =
        classes_.classify(in.work, usesStill ? Match{in.weighed, in.trust} : Match{},
                          usesSecond ? Match{in.second.weighed, in.second.trust} : Match{},
                          {options.enlargedTiles, options.plainTiles}, *workers_);
    if (!in.work.drawsWhole() && in.work.changed == 0) return summary;
    Frame frame{in,
                options,
                out,
                usesStill && !blends,
                usesStill && blends,
                !options.cubic && options.mode == SuperResMode::Off,
                options.mode == SuperResMode::Detail ? options.learned : nullptr,
                {},
                *this};
    if (frame.blends) frame.picture = {in.picture.data, in.picture.pitch, in.picture.size};
    choose(frame);
    // The lambda captures only a pointer and a reference, so that std::function stores it without
    // allocating memory.
    workers_->forRange(output_.height, kGrain, [this, &frame](int first, int last) {
        scratch_.with([&](Scratch& scratch) { drawPart(frame, scratch, first, last); });
    });
    return summary;
}

void DetailStep::drawPart(const Frame& frame, Scratch& scratch, int first, int last) const {
    if (frame.in.work.drawsWhole()) {
        const int strips = std::max(1, (output_.width + kStripWidth / 2) / kStripWidth);
        const int even = (output_.width + strips - 1) / strips;
        const int width = (even + kStripStep - 1) / kStripStep * kStripStep;
        for (int x = 0; x < output_.width; x += width)
            drawStrip(frame, scratch, {x, first, std::min(x + width, output_.width), last});
        return;
    }
    for (int row = tileAt(rowsAt_, first); row < tiles_.height && rowsAt_[row] < last; ++row)
        drawTileRow(frame, scratch, row, std::max(first, rowsAt_[row]),
                    std::min(last, rowsAt_[row + 1]));
}

void DetailStep::drawTileRow(const Frame& frame, Scratch& scratch, int row, int first,
                             int last) const {
    const Show* shows = &shows_[static_cast<std::size_t>(row) * tiles_.width];
    for (int begin = 0; begin < tiles_.width;) {
        int end = begin;
        while (end < tiles_.width && shows[end] != Show::Nothing)
            ++end;
        if (end > begin && columnsAt_[begin] < columnsAt_[end])
            drawStrip(frame, scratch, {columnsAt_[begin], first, columnsAt_[end], last});
        begin = end + 1;
    }
}

void DetailStep::cut(const Frame& frame, int row, int begin, int end, Scratch& scratch) const {
    std::vector<Segment>& segments = scratch.segments;
    segments.clear();
    scratch.learnedSpans.clear();
    scratch.detailSpans.clear();
    scratch.secondSpans.clear();
    for (int column = tileAt(columnsAt_, begin); column < tiles_.width; ++column) {
        const int from = std::max(begin, columnsAt_[column]),
                  to = std::min(end, columnsAt_[column + 1]);
        if (from >= to) continue;
        const Show show = shows_[static_cast<std::size_t>(row) * tiles_.width + column];
        const bool learned = frame.bank != nullptr && frame.in.work.at(column, row).matched != 0 &&
                             !(show == Show::Detail && classes_.showsStillAlone(column, row));
        if (!segments.empty() && segments.back().show == show && segments.back().learned == learned)
            segments.back().end = to;
        else
            segments.push_back({from, to, show, learned});
        if (learned) append(scratch.learnedSpans, {from, to});
        if (show == Show::Detail || show == Show::BothStills)
            append(scratch.detailSpans, {from, to});
        if (show == Show::BothStills) append(scratch.secondSpans, {from, to});
    }
    if (frame.bank != nullptr) scratch.learned.cover(scratch.learnedSpans);
    if (frame.warps) scratch.warped.cover(scratch.detailSpans);
    if (!scratch.secondSpans.empty()) scratch.second.cover(scratch.secondSpans);
}

void DetailStep::drawStrip(const Frame& frame, Scratch& s, const PixelRect& strip) const {
    const bool sharpens = frame.warps && frame.bank == nullptr;
    s.video.begin(frame.in.video, sharpens ? frame.in.trust : Rows<const TrustCell>{}, videoTaps_,
                  frame.linear, strip.x0, strip.x1);
    if (frame.blends) s.lookUps.begin(frame.in.lookUps, lookUpTaps_, true, strip.x0, strip.x1);
    const WarpedStill::Guide guide{frame.in.video,
                                   frame.bank != nullptr ? frame.bank->guidance() : Guidance{}};
    if (frame.warps)
        s.warped.begin(frame.in.still, frame.in.lookUps, lookUpTaps_, warpedTaps_,
                       {strip.x0, strip.x1}, guide);
    if (frame.warps && frame.in.second.still.data != nullptr)
        s.second.begin(frame.in.second.still, frame.in.second.lookUps, lookUpTaps_, warpedTaps_,
                       {strip.x0, strip.x1}, guide);
    if (frame.bank != nullptr)
        s.learned.begin(frame.in.video, learnedTaps_, *frame.bank, {strip.x0, strip.x1});
    int row = -1;
    for (int y = strip.y0; y < strip.y1; ++y) {
        if (row < 0 || y >= rowsAt_[row + 1]) {
            row = tileAt(rowsAt_, y);
            cut(frame, row, strip.x0, strip.x1, s);
        }
        drawRow(frame, s, y);
    }
}

void DetailStep::drawRow(const Frame& frame, Scratch& s, int y) const {
    const RowTaps& columns = frame.linear ? videoTaps_.linearColumns : videoTaps_.cubicColumns;
    const ColumnTaps& taps = columns.column(y);
    const EnlargedRows rows = s.video.rows(taps.rows);
    std::uint32_t* to = frame.out[y];
    const std::int16_t* learnedRow = s.learnedSpans.empty() ? nullptr : s.learned.row(y);
    if (frame.warps && !s.detailSpans.empty()) s.detail = s.warped.row(y);
    if (!s.secondSpans.empty()) s.secondDetail = s.second.row(y);
    for (const Segment& segment : s.segments) {
        const auto& [begin, end, show, learned] = segment;
        const bool detail = show == Show::Detail || show == Show::BothStills;
        const std::int16_t* added = learned ? learnedRow : nullptr;
        if (detail && frame.warps) added = detailOf(s, segment, added, y);
        composeRow(rows, taps.weights, added, begin, end, to);
        if (detail && frame.blends) blendRow(frame.picture, s.lookUps.row(y), begin, end, to);
    }
}

const std::int16_t* DetailStep::detailOf(Scratch& s, const Segment& segment,
                                         const std::int16_t* learned, int y) {
    const LookUpRows lookUps = s.warped.lookUps(y);
    detailRow(s.detail, lookUps, learned, segment.begin, segment.end, s.added[0]);
    if (segment.show != Show::BothStills) return s.added[0];
    const LookUpRows second = s.second.lookUps(y);
    detailRow(s.secondDetail, second, learned, segment.begin, segment.end, s.added[1]);
    fadeRow(s.added[1], second, lookUps, segment.begin, segment.end, s.added[0]);
    return s.added[0];
}

}  // namespace mfar::simd
