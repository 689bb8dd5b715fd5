#pragma once

#include <array>

namespace mfar::plausible {

/// The allowed range of a number in a calibration or tag map, bounds included. A test compares
/// these ranges with the table in docs/calibration.md.
struct Range {
    const char *what, *unit;
    double least, most;

    /// NaN is outside of every range.
    [[nodiscard]] constexpr bool holds(double value) const {
        return value >= least && value <= most;
    }
};

/// The upper limit is kMaxPictureSide.
inline constexpr Range kSide{"width and height", "px", 1, 16384};
/// The limits correspond to horizontal fields of view of 169 degrees and of 0.6 degrees.
inline constexpr Range kFocal{"focal length", "picture widths", 0.05, 100};
inline constexpr Range kPrincipal{"principal point", "picture widths and heights", -1, 2};
inline constexpr Range kCoefficient{"distortion coefficient", "1", -1000, 1000};
/// For comparison: an equidistant fisheye lens with a field of view of 150 degrees from corner to
/// corner has the factor 0.35.
inline constexpr Range kCorner{
    "factor by which distortion changes the distance of a corner from the principal point", "1",
    0.25, 1.5};
inline constexpr Range kBaseline{"distance of the sensors", "m", 0, 2};
inline constexpr Range kTimeOffset{"time offset of the stills", "s", -10, 10};
/// rate() also accepts 0. It means that the sensor takes pictures on trigger only.
inline constexpr Range kRate{"rate", "Hz", 0.01, 10000};

inline constexpr Range kTagSize{"edge of a tag", "m", 0.001, 100};
inline constexpr Range kTagPosition{"coordinate of a tag", "m", -1000, 1000};

inline constexpr std::array kRanges{kSide,     kFocal,      kPrincipal, kCoefficient, kCorner,
                                    kBaseline, kTimeOffset, kRate,      kTagSize,     kTagPosition};

}  // namespace mfar::plausible
