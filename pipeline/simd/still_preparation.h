#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/enlarge/still_tone.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/detail_kernels.h"
#include "pipeline/simd/row_taps.h"
#include "pipeline/simd/scratch_slots.h"
#include "pipeline/simd/still_luma.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace mfar::simd {

/// Prepares the newest still once: its luma at full resolution, and at the resolution that the
/// output needs. CPU version of the GLES engine's StillReference. Memory for pictures is allocated
/// in the constructor, in the first call of picture(), and in set() if its copy of the still needs
/// more memory than all copies before.
class StillPreparation {
public:
    /// `output`: size of the whole enlarged video.
    StillPreparation(const StereoRig& rig, Size output, std::shared_ptr<Workers> workers);

    /// Sets a valid picture of the still camera's size, in any pixel format. `tone` is applied to
    /// the luma, but not to the colours of picture(). `keepsPicture`: true copies the still's
    /// colours for picture(); false makes picture() return the luma as a grey picture. `noise`:
    /// standard deviation of the noise [grey levels] that is removed from pairs().
    void set(const ImageView& still, const StillTone& tone = {}, bool keepsPicture = true,
             double noise = 0);

    /// The rig, but with a still camera of the size of pairs(): it has the same lens, but may have
    /// fewer pixels.
    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    /// Rec. 601 luma of the whole still, with the tone curve.
    [[nodiscard]] Rows<const std::uint8_t> luma() const { return luma_.rows(); }
    /// Luma without noise, with the tone curve, at the size of rig().still. A still that already
    /// had this size is sharpened a little: its finest detail is raised, because later linear
    /// look-ups blur it.
    [[nodiscard]] StillPairs pairs() const { return {pairs_[0], pairs_.pitch(), pairs_.size()}; }
    /// The picture as RGBA8 with R in the lowest byte, at the size of rig().still. 64 readable
    /// bytes follow each row. The first call after set() computes it.
    [[nodiscard]] Rows<const std::uint32_t> picture();

private:
    class Luma {
    public:
        explicit Luma(Size size) : rows_({size.width + 2 * kMargin, size.height}), size_(size) {}
        [[nodiscard]] std::uint8_t* operator[](int y) { return rows_[y] + kMargin; }
        [[nodiscard]] Rows<const std::uint8_t> rows() const {
            return {rows_[0] + kMargin, rows_.pitch(), size_};
        }
        void repeatBorder(int y) {
            std::uint8_t* row = (*this)[y];
            row[-1] = row[0];
            row[size_.width] = row[size_.width - 1];
        }

    private:
        static constexpr int kMargin = 64;
        AlignedRows<std::uint8_t> rows_;
        Size size_;
    };
    struct Scratch {
        explicit Scratch(Size still);
        StillLuma::Scratch luma;
        AlignedRows<float> wide;
        AlignedRows<std::uint8_t> raised, rgb;
        Luma shown;                      // rows of the luma without noise, see shownRow()
        std::array<int, 3> shownRows{};  // numbers of these rows
        std::vector<const std::uint8_t*> rows;
        std::vector<float> weights;
    };
    /// Reduction to fewer pixels without aliasing, see still_reduce.frag.
    struct Reduction {
        RowTaps columns, rows;
        Luma luma;
    };

    void inParts(int rows, const std::function<void(int, int, Scratch&)>& body);
    void takeLuma(const ImageView& still);
    void keep(const ImageView& still);
    void reduceLuma();
    void applyTone(const StillTone& tone);
    void makePairs(const StillTone& tone, float quiet);
    [[nodiscard]] const std::uint8_t* shownRow(int y, const StillTone& tone, float quiet,
                                               Scratch& scratch);
    void reducePictureRow(int y, Scratch& scratch);
    template <class RowAt>
    void weighColumn(const RowTaps& taps, int y, Size from, const RowAt& rowAt, Scratch& scratch);
    [[nodiscard]] Luma& detailed() { return reduction_ ? reduction_->luma : luma_; }

    std::shared_ptr<Workers> workers_;
    Size whole_;
    StereoRig rig_;
    Luma luma_;
    std::optional<Reduction> reduction_;
    std::int16_t neighboursShare_;
    AlignedRows<std::uint16_t> pairs_;
    ScratchSlots<Scratch> scratch_;
    std::vector<std::uint8_t> kept_;
    std::optional<ImageView> unmade_;  // the still, until picture() has converted it to RGBA8
    std::optional<RgbPlanes> planes_;
    AlignedRows<std::uint32_t> picture_;
};

}  // namespace mfar::simd
