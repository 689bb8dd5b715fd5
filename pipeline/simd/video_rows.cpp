#include "pipeline/simd/video_rows.h"

#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/sharpen_kernels.h"

#include <algorithm>
#include <cstring>

namespace mfar::simd {
namespace {

constexpr float kFixed = 64;  // fixed-point units per grey level

}  // namespace

VideoTaps::VideoTaps(Size video, Size output)
    : cubicRows(RowTaps::cubic(video.width, output.width)),
      cubicColumns(RowTaps::cubic(video.height, output.height)),
      linearRows(RowTaps::linear(video.width, output.width)),
      linearColumns(RowTaps::linear(video.height, output.height)),
      trustRows(RowTaps::linear(cellsOf(video).width, video.width, 1.0 / kCell)),
      trustColumns(RowTaps::linear(cellsOf(video).height, video.height, 1.0 / kCell)) {}

VideoRows::VideoRows(Size video, int outputWidth)
    : video_(video), bytes_({video.width + 2 * kMargin, 3 * kKept}), grey_({video.width, 1}),
      strength_({video.width, 1}), wide_({outputWidth, 12}),
      trust_(cellsOf(video).width, video.width) {}

void VideoRows::begin(const RgbPlanes& video, Rows<const TrustCell> trust, const VideoTaps& taps,
                      bool linear, int begin, int end) {
    planes_ = &video;
    taps_ = &taps;
    sharpens_ = trust.data != nullptr;
    const RowTaps& rows = linear ? taps.linearRows : taps.cubicRows;
    table_ = rows.table();
    begin_ = begin;
    end_ = end;
    first_ = rows.first(begin);
    last_ = std::min(rows.first(end - 1) + rows.taps(), video_.width);
    made_.fill(-1);
    loaded_.fill(-1);
    trust_.begin(trust, taps.trustRows, first_, last_);
}

EnlargedRows VideoRows::rows(const std::array<int, 4>& videoRows) {
    EnlargedRows out;
    for (std::size_t k = 0; k < videoRows.size(); ++k) {
        const int slot = videoRows[k] % 4;
        if (made_[slot] != videoRows[k]) make(videoRows[k]);
        for (int c = 0; c < 3; ++c)
            out[c][k] = wide_[3 * slot + c];
    }
    return out;
}

void VideoRows::load(int row) {
    const int slot = row % kKept;
    if (loaded_[slot] == row) return;
    const int from = std::max(first_ - 2, 0), to = std::min(last_ + 2, video_.width);
    for (int c = 0; c < 3; ++c) {
        std::uint8_t* bytes = bytes_[3 * slot + c] + kMargin;
        std::memcpy(bytes + from, planes_->row(c, row) + from, static_cast<std::size_t>(to - from));
        if (from == 0) std::fill_n(bytes - 2, 2, bytes[0]);
        if (to == video_.width) std::fill_n(bytes + to, 2, bytes[to - 1]);
    }
    loaded_[slot] = row;
}

const std::uint8_t* VideoRows::source(int channel, int row) {
    const int at = std::clamp(row, 0, video_.height - 1);
    load(at);
    return bytes_[3 * (at % kKept) + channel] + kMargin;
}

void VideoRows::makeStrength(int row) {
    const auto channels = [](const TrustCell& cell) {
        return std::array{boundedOr0(cell.halfWeight, 0, 2), boundedOr0(cell.signal, 0, 1)};
    };
    const BetweenRows between(taps_->trustColumns, row);
    const auto upper = trust_.row(between.rows[0], channels),
               lower = trust_.row(between.rows[1], channels);
    strengthRow({{upper[0], lower[0]}, {upper[1], lower[1]}, between.t}, first_, last_,
                strength_[0]);
}

void VideoRows::make(int row) {
    if (sharpens_) makeStrength(row);
    const int slot = row % 4;
    for (int c = 0; c < 3; ++c) {
        if (sharpens_) {
            Source rows{};
            for (int k = 0; k < 5; ++k)
                rows[k] = source(c, row + k - 2);
            sharpenRow(rows, strength_[0], first_, last_, grey_[0]);
        } else {
            plainRow(source(c, row), first_, last_, grey_[0]);
        }
        resampleRow(grey_[0], table_, begin_, end_, kFixed, wide_[3 * slot + c]);
    }
    made_[slot] = row;
}

}  // namespace mfar::simd
