#pragma once

#include "pipeline/simd/detail_step.h"
#include "tests/engine/simd/detail_case.h"
#include "tests/oracle/learned.h"
#include "tests/oracle/still.h"
#include "tests/oracle/superres.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace mfar::simd {

using twin::Grey;

inline constexpr std::uint32_t kBefore = 0x12345678;
inline constexpr DetailOptions kDetail{SuperResMode::Detail, true, true, true};

struct Drawn {
    Drawn(const DetailCase& frame, Size output, const DetailOptions& options, bool usesStill = true,
          int threads = 2)
        : still(frame.rig, output, std::make_shared<Workers>(threads)),
          step(still.rig(), output, std::make_shared<Workers>(threads)), out(output) {
        still.set(frame.stillView());
        for (int y = 0; y < output.height; ++y)
            std::fill_n(out[y], output.width, kBefore);
        summary = step.draw(frame.input(usesStill ? &still : nullptr), options, out.rows());
    }
    [[nodiscard]] int channel(int x, int y, int c) const {
        return static_cast<int>(out[y][x] >> (8 * c) & 255);
    }

    StillPreparation still;
    DetailStep step;
    AlignedRows<std::uint32_t> out;
    TileSummary summary;
};

class Wanted {
public:
    Wanted(const DetailCase& frame, Size output, const DetailOptions& options, bool usesStill)
        : frame_(frame), output_(output), options_(options) {
        const bool linear = !options.cubic && options.mode == SuperResMode::Off;
        for (int c = 0; c < 3; ++c) {
            Grey plane = twin::greyOf(frame.rig.video.size, [&](int x, int y) {
                return double(frame.video.row(c, y)[x]);
            });
            const bool learned = options.learned != nullptr;
            if (usesStill && options.mode == SuperResMode::Detail && !learned) {
                plane = twin::sharpened(plane, [&](int x, int y) { return strength(x, y); });
                for (double& value : plane.values)
                    value = std::clamp(value, 0.0, 255.0);
            }
            video_[c] = twin::enlarged(plane, output, linear);
        }
        if (options.learned != nullptr) addLearned();
        const auto field = [&](auto member) {
            return twin::greyOf(frame.cells, [&](int x, int y) {
                return double(frame.lookUps[y * frame.cells.width + x].*member);
            });
        };
        lookUp_ = {field(&LookUpCell::x), field(&LookUpCell::y), field(&LookUpCell::weight),
                   twin::greyOf(frame.cells, [&](int x, int y) {
                       return double(frame.lookUps[y * frame.cells.width + x].confidence());
                   })};
        codes_ = field(&LookUpCell::confidenceAndJumps);
    }

    [[nodiscard]] double enlarged(int x, int y, int c) const {
        return std::clamp(video_[c].at(x, y), 0.0, 255.0);
    }
    [[nodiscard]] double blended(int x, int y, int c, const Grey& still) const {
        return std::lerp(enlarged(x, y, c), there(x, y, still), lookUpAt(x, y, 3));
    }
    /// After this call, withStill() subtracts the mean of the still itself, as the shaders do.
    /// Without this call, it subtracts the mean of the warped still.
    void seeStill() {
        ofWarped_ = false;
        detail_ = {};
    }
    /// The video with the detail of a still's luma added, see lumaPlane(). The first call is slow.
    [[nodiscard]] double withStill(int x, int y, int c, const Grey& still) {
        if (detail_.values.empty()) {
            const Grey warped =
                twin::greyOf(output_, [&](int i, int j) { return there(i, j, still); });
            detail_ = twin::enlarged(guided(ofLight(warped, still)), output_);
            for (std::size_t i = 0; i < detail_.values.size(); ++i)
                detail_.values[i] = warped.values[i] - detail_.values[i];
        }
        const double weight = lookUpAt(x, y, 2);
        double up = video_[c].at(x, y);
        if (options_.learned != nullptr)  // the residual shrinks where the still adds detail
            up -= std::min(weight, 1.0) * residual_.at(x, y);
        return std::clamp(up + weight * detail_.at(x, y), 0.0, 255.0);
    }

private:
    [[nodiscard]] double lookUpAt(double x, double y, int channel) const {
        const Size video = frame_.rig.video.size;
        const double column = (x + 0.5) * video.width / output_.width / 4 - 0.5,
                     row = (y + 0.5) * video.height / output_.height / 4 - 0.5;
        return twin::lookedUp(lookUp_[channel], codes_, column, row);
    }
    [[nodiscard]] double there(double x, double y, const Grey& still) const {
        const double px = (x + 0.5) * still.size.width / output_.width + lookUpAt(x, y, 0) - 0.5,
                     py = (y + 0.5) * still.size.height / output_.height + lookUpAt(x, y, 1) - 0.5;
        return still.bilinear(std::clamp(px, -1.0, double(still.size.width)),
                              std::clamp(py, -1.0, double(still.size.height)));
    }
    [[nodiscard]] Guidance guidance() const {
        return options_.learned != nullptr ? options_.learned->guidance() : Guidance{};
    }
    /// Returns the mean of the still over each video pixel; see params::kSeen.
    [[nodiscard]] Grey ofLight(const Grey& warped, const Grey& still) const {
        const Size video = frame_.rig.video.size;
        const auto meanOf = [&](const auto& valueOf) {
            if (ofWarped_)
                return twin::seenOf(
                    twin::greyOf(output_, [&](int x, int y) { return valueOf(warped.at(x, y)); }),
                    video);
            return twin::seen(video, [&](double x, double y) {
                return valueOf(there(x * output_.width / video.width - 0.5,
                                     y * output_.height / video.height - 0.5, still));
            });
        };
        const Grey mean = meanOf([](double value) { return value; }),
                   squares = meanOf([](double value) { return value * value; });
        return twin::greyOf(video, [&](int x, int y) {
            return std::lerp(mean.at(x, y), std::sqrt(std::max(squares.at(x, y), 0.0)),
                             double(guidance().light));
        });
    }
    /// Returns seen - guidance.still * d(seen) + guidance.video * d(luma of the video). d(p) is the
    /// difference of a pixel of p from the mean of the 5x5 pixels around it. Only pixels whose cell
    /// has a weight above 0 change and count in the mean.
    [[nodiscard]] Grey guided(const Grey& seen) const {
        const Guidance guidance = this->guidance();
        if (!guidance.any()) return seen;
        const auto [width, height] = seen.size;
        const auto trusted = [&](int x, int y) {
            return frame_.lookUps[(y / 4) * frame_.cells.width + x / 4].weight > 0;
        };
        const auto off = [&](int x, int y) {
            const auto at = [&](int c) { return double(frame_.video.row(c, y)[x]); };
            return guidance.still * seen.at(x, y) -
                   guidance.video * (0.299 * at(0) + 0.587 * at(1) + 0.114 * at(2));
        };
        return twin::greyOf(seen.size, [&, width = width, height = height](int x, int y) {
            if (!trusted(x, y)) return seen.at(x, y);
            double sum = 0;
            int count = 0;
            for (int k = 0; k < 25; ++k) {
                const int i = std::clamp(x + k % 5 - 2, 0, width - 1),
                          j = std::clamp(y + k / 5 - 2, 0, height - 1);
                if (!trusted(i, j)) continue;
                sum += off(i, j);
                ++count;
            }
            return seen.at(x, y) - (off(x, y) - sum / count);
        });
    }
    void addLearned() {
        const Grey luma = twin::greyOf(frame_.rig.video.size, [&](int x, int y) {
            const auto at = [&](int c) { return double(frame_.video.row(c, y)[x]); };
            return std::round(8 * (0.299 * at(0) + 0.587 * at(1) + 0.114 * at(2))) / 8;
        });
        residual_ = twin::learnedResidual(luma, output_, *options_.learned);
        for (Grey& plane : video_)
            for (std::size_t i = 0; i < plane.values.size(); ++i)
                plane.values[i] += residual_.values[i];
    }
    [[nodiscard]] double strength(int x, int y) const {
        const auto field = [&](auto member) {
            return twin::greyOf({2, 2}, [&](int i, int j) {
                const int cx = std::clamp((x - 2 + 4 * i) >> 2, 0, frame_.cells.width - 1),
                          cy = std::clamp((y - 2 + 4 * j) >> 2, 0, frame_.cells.height - 1);
                return double(frame_.trust[cy * frame_.cells.width + cx].*member);
            });
        };
        const double fx = ((x - 2) & 3) / 4.0 + 0.125, fy = ((y - 2) & 3) / 4.0 + 0.125;
        return (1 - std::min(2 * field(&TrustCell::halfWeight).bilinear(fx, fy), 1.0)) *
               field(&TrustCell::signal).bilinear(fx, fy);
    }

    const DetailCase& frame_;
    Size output_;
    DetailOptions options_;
    bool ofWarped_ = true;
    std::array<Grey, 3> video_;
    Grey residual_, detail_;
    std::array<Grey, 4> lookUp_;
    Grey codes_;
};

inline Grey lumaPlane(const StillPreparation& still) {
    const StillPairs pairs = still.pairs();
    return twin::greyOf(
        pairs.size, [&](int x, int y) { return double(pairs.data[y * pairs.pitch + x] & 255); });
}

struct Sizes {
    Size video, still, output;
};
inline const std::vector<Sizes> kSizes{
    {{160, 120}, {400, 300}, {576, 432}}, {{53, 37}, {200, 140}, {191, 133}},
    {{16, 16}, {70, 65}, {57, 58}},       {{64, 48}, {200, 150}, {64, 48}},
    {{100, 60}, {90, 54}, {61, 37}},      {{35, 18}, {64, 33}, {1300, 700}}};

inline int tileAt(int pixel, int video, int output) {
    return static_cast<int>((pixel + 0.5) * video / output) / kTileSize;
}

/// The same filter for each class, so that the result does not depend on a pixel's class, which
/// rounding may change. The filter is symmetric: mirroring it, as some classes do, has no effect.
inline std::vector<FilterBank::Filter> evenFilters() {
    FilterBank::Filter filter;
    for (int tap = 0; tap < enlarge::kTaps; ++tap)
        for (int phase = 0; phase < enlarge::kPhases; ++phase) {
            const auto [x, y] = enlarge::kTapAt[tap];
            const int column = phase % 4, row = phase / 4;
            const double d = std::hypot(x - (column - 1.5) / 4, y - (row - 1.5) / 4);
            filter[enlarge::filterIndex(tap, phase)] =
                static_cast<std::int16_t>(std::lround(-2500 * std::cos(2 * d) * std::exp(-d)));
        }
    return std::vector(enlarge::kUnique, filter);
}
inline const FilterBank& evenBank() {
    static const FilterBank bank(evenFilters());
    return bank;
}
inline const FilterBank& guidedBank() {
    static const FilterBank bank(evenFilters(), {0.7F, 0.5F, 0.9F});
    return bank;
}

}  // namespace mfar::simd
