#pragma once

#include <array>

namespace mfar::plausible {

/// The range of a number in a calibration or tag map. docs/calibration.md shows the same
/// table; a test compares both.
struct Range {
    const char *what, *unit;
    double least, most;

    /// False for NaN.
    [[nodiscard]] constexpr bool holds(double value) const {
        return value >= least && value <= most;
    }
};

/// Textures cannot be larger.
inline constexpr Range kSide{"width and height", "px", 1, 16384};
/// Fields of view from 169 down to half a degree.
inline constexpr Range kFocal{"focal length", "picture widths", 0.05, 100};
inline constexpr Range kPrincipal{"principal point", "picture widths and heights", -1, 2};
inline constexpr Range kCoefficient{"distortion coefficient", "1", -1000, 1000};
/// Barrel distortion at 150 degrees reaches 0.35.
inline constexpr Range kCorner{"radius of a corner with distortion to that without", "1", 0.25,
                               1.5};
inline constexpr Range kBaseline{"distance of the sensors", "m", 0, 2};
inline constexpr Range kTimeOffset{"time offset of the stills", "s", -10, 10};
/// Does not hold for a sensor that takes pictures on trigger only, whose rate is 0.
inline constexpr Range kRate{"rate", "Hz", 0.01, 10000};

inline constexpr Range kTagSize{"edge of a tag", "m", 0.001, 100};
inline constexpr Range kTagPosition{"coordinate of a tag", "m", -1000, 1000};

inline constexpr std::array kRanges{kSide,     kFocal,      kPrincipal, kCoefficient, kCorner,
                                    kBaseline, kTimeOffset, kRate,      kTagSize,     kTagPosition};

}  // namespace mfar::plausible
