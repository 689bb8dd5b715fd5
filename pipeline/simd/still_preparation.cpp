#include "pipeline/simd/still_preparation.h"

#include "base/image_layout.h"
#include "pipeline/superres/still_scale.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace mfar::simd {
namespace {

constexpr int kStillGrain = 16;

}  // namespace

StillPreparation::Scratch::Scratch(Size still)
    : luma(still.width), wide({still.width, 1}), raised({still.width, 2}), rgb({still.width, 3}),
      shown({still.width, 3}) {}

StillPreparation::StillPreparation(const StereoRig& rig, Size output,
                                   std::shared_ptr<Workers> workers)
    : workers_(std::move(workers)), whole_(rig.still.size), rig_(stillFor(output, rig)),
      luma_(whole_),
      neighboursShare_(rig_.still.size == whole_
                           ? static_cast<std::int16_t>(std::lround(kLinearLoss * 32768))
                           : std::int16_t{0}),
      pairs_(rig_.still.size), scratch_(workers_->count(), [&] { return Scratch(whole_); }) {
    const Size reduced = rig_.still.size;
    if (reduced != whole_)
        reduction_.emplace(RowTaps::tent(whole_.height, reduced.height),
                           RowTaps::tent(whole_.width, reduced.width), Luma(reduced));
}

void StillPreparation::inParts(int rows, const std::function<void(int, int, Scratch&)>& body) {
    workers_->forRange(rows, kStillGrain, [&](int first, int last) {
        scratch_.with([&](Scratch& scratch) { body(first, last, scratch); });
    });
}

void StillPreparation::set(const ImageView& still, const StillTone& tone, bool keepsPicture,
                           double noise) {
    takeLuma(still);
    const Rows<const std::uint8_t> grey = luma();
    unmade_ =
        ImageView{grey.data, grey.size, static_cast<std::size_t>(grey.pitch), PixelFormat::Gray8};
    if (keepsPicture) keep(still);
    if (reduction_) reduceLuma();
    makePairs(tone, quietVariance(noise, whole_, rig_.still.size));
    applyTone(tone);
}

void StillPreparation::takeLuma(const ImageView& still) {
    const StillLuma rows(still);
    inParts(whole_.height, [&](int first, int last, Scratch& scratch) {
        for (int y = first; y < last; ++y) {
            rows.row(y, scratch.luma, luma_[y]);
            luma_.repeatBorder(y);
        }
    });
}

void StillPreparation::keep(const ImageView& still) {
    kept_.resize(packedBytes(still.format, still.size));
    ImageView to = packedView(kept_.data(), still.size, still.format);
    to.matrix = still.matrix;
    to.range = still.range;
    std::uint8_t* data = kept_.data();
    for (int i = 0; i < planeCount(still.format); ++i) {
        const PlaneSize plane = planeSize(still.format, still.size, i);
        const PlaneView from = i == 0 ? PlaneView{still.data, still.stride}
                                      : still.chroma[static_cast<std::size_t>(i) - 1];
        workers_->forRange(plane.rows, kStillGrain, [&](int first, int last) {
            for (int y = first; y < last; ++y)
                std::memcpy(data + y * plane.rowBytes, from.data + y * from.stride, plane.rowBytes);
        });
        data += plane.rowBytes * plane.rows;
    }
    unmade_ = to;
}

// Computes row y of a picture that is resampled along columns, and writes it to scratch.wide.
template <class RowAt>
void StillPreparation::weighColumn(const RowTaps& taps, int y, Size from, const RowAt& rowAt,
                                   Scratch& scratch) {
    int number = 0;
    scratch.rows.resize(taps.taps());
    scratch.weights.resize(taps.taps());
    for (int k = 0; k < taps.taps(); ++k) {
        const float weight = taps.weight(k, y);
        if (weight == 0) continue;
        scratch.rows[number] = rowAt(taps.first(y) + k);
        scratch.weights[number++] = weight;
    }
    weighRows(scratch.rows.data(), scratch.weights.data(), number, from.width, scratch.wide[0]);
}

void StillPreparation::reduceLuma() {
    inParts(rig_.still.size.height, [&](int first, int last, Scratch& scratch) {
        for (int y = first; y < last; ++y) {
            weighColumn(
                reduction_->columns, y, whole_, [&](int row) { return luma_[row]; }, scratch);
            resampleRow(scratch.wide[0], reduction_->rows.table(), 0, rig_.still.size.width,
                        reduction_->luma[y]);
            reduction_->luma.repeatBorder(y);
        }
    });
}

void StillPreparation::applyTone(const StillTone& tone) {
    if (tone.isIdentity()) return;
    inParts(whole_.height, [&](int first, int last, Scratch&) {
        for (int y = first; y < last; ++y) {
            tone.apply({luma_[y], static_cast<std::size_t>(whole_.width)});
            luma_.repeatBorder(y);
        }
    });
}

// Returns row y of detailed() without noise and with the tone curve. The result stays valid until a
// row that is more than two rows away is requested.
const std::uint8_t* StillPreparation::shownRow(int y, const StillTone& tone, float quiet,
                                               Scratch& scratch) {
    Luma& luma = detailed();
    if (!(quiet > 0) && tone.isIdentity()) return luma[y];
    const auto [width, height] = rig_.still.size;
    const auto pixels = static_cast<std::size_t>(width);
    const int slot = y % static_cast<int>(scratch.shownRows.size());
    std::uint8_t* to = scratch.shown[slot];
    if (std::exchange(scratch.shownRows[slot], y) == y) return to;
    if (quiet > 0)
        quietRow({luma[std::max(y - 1, 0)], luma[y], luma[std::min(y + 1, height - 1)]}, quiet,
                 pixels, to);
    else
        std::memcpy(to, luma[y], pixels);
    if (!tone.isIdentity()) tone.apply({to, pixels});
    to[-1] = to[0];
    to[width] = to[width - 1];
    return to;
}

void StillPreparation::makePairs(const StillTone& tone, float quiet) {
    const auto [width, height] = rig_.still.size;
    const auto pixels = static_cast<std::size_t>(width);
    inParts(height, [&, height = height](int first, int last, Scratch& scratch) {
        scratch.shownRows.fill(-1);
        const auto raise = [&](int y) {
            const auto row = [&](int at) {
                return shownRow(std::clamp(at, 0, height - 1), tone, quiet, scratch);
            };
            raisedRow({row(y - 1), row(y), row(y + 1)}, neighboursShare_, pixels,
                      scratch.raised[y % 2]);
        };
        raise(first);
        for (int y = first; y < last; ++y) {
            const int next = y + 1;
            if (next < height) raise(next);
            pairRows(scratch.raised[y % 2], scratch.raised[std::min(next, height - 1) % 2], pixels,
                     pairs_[y]);
        }
    });
}

Rows<const std::uint32_t> StillPreparation::picture() {
    if (!unmade_) return std::as_const(picture_).rows();
    if (!planes_) {
        planes_.emplace(whole_);
        picture_ = AlignedRows<std::uint32_t>(rig_.still.size);
    }
    planes_->take(*unmade_);
    unmade_.reset();
    inParts(rig_.still.size.height, [&](int first, int last, Scratch& scratch) {
        const auto width = static_cast<std::size_t>(rig_.still.size.width);
        for (int y = first; y < last; ++y) {
            if (reduction_) {
                reducePictureRow(y, scratch);
                packRow({scratch.rgb[0], scratch.rgb[1], scratch.rgb[2]}, width, picture_[y]);
            } else {
                packRow({planes_->row(0, y), planes_->row(1, y), planes_->row(2, y)}, width,
                        picture_[y]);
            }
        }
    });
    return std::as_const(picture_).rows();
}

void StillPreparation::reducePictureRow(int y, Scratch& scratch) {
    for (int c = 0; c < 3; ++c) {
        weighColumn(
            reduction_->columns, y, whole_, [&](int row) { return planes_->row(c, row); }, scratch);
        resampleRow(scratch.wide[0], reduction_->rows.table(), 0, rig_.still.size.width,
                    scratch.rgb[c]);
    }
}

}  // namespace mfar::simd
