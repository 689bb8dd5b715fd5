#pragma once

#include "base/calibration/plausible_ranges.h"

#include <array>
#include <string_view>

namespace mfar::range {

/// The range of a number in the configuration. systemd/mfard.toml shows the same ranges; a test
/// compares both with what the parser accepts.
struct ConfigRange {
    std::string_view section, name;
    std::string_view unit;  ///< empty: none, or the text beside it says it
    double least, most;
    bool isWhole = false;
    int count = 1;            ///< numbers in the list; 1: it is no list
    bool hasLength1 = false;  ///< the list is a vector of that length
};

// Both cameras have these.
inline constexpr ConfigRange kWidth{"cameras.video", "width", "px", 16, 8192, true};
inline constexpr ConfigRange kHeight{"cameras.video", "height", "px", 16, 8192, true};
inline constexpr ConfigRange kCameraRate{"cameras.video", "rate_hz", "Hz", 0, 1000};

inline constexpr ConfigRange kPulse{"cameras.trigger", "pulse_ms", "ms", 0.001, 10000};
inline constexpr ConfigRange kDelay{"cameras.trigger", "delay_ms", "ms", -1000, 10000};
inline constexpr ConfigRange kJitter{"cameras.trigger", "jitter_ms", "ms", 0.001, 1000};
inline constexpr ConfigRange kArrival{"cameras.trigger", "arrival_ms", "ms", 1, 60000};

inline constexpr ConfigRange kStillRate{"trigger", "rate_hz", "", 0.01, 60};
inline constexpr ConfigRange kExplained{"trigger", "explained_below", "", 0, 1};
inline constexpr ConfigRange kMaxAge{"trigger", "max_age_s", "s", 0.1, 86400};
inline constexpr ConfigRange kMinInterval{"trigger", "min_interval_s", "s", 0, 3600};
inline constexpr ConfigRange kTimeout{"trigger", "timeout_s", "s", 0.05, 60};

inline constexpr ConfigRange kTagSize{"pose", "tag_size", "m", plausible::kTagSize.least,
                                      plausible::kTagSize.most};
inline constexpr ConfigRange kDecimation{"pose", "decimation", "", 1, 8};
inline constexpr ConfigRange kDetectors{"pose", "threads", "", 1, 64, true};
inline constexpr ConfigRange kFullSearch{"pose", "full_search_interval", "", 1, 1'000'000, true};
inline constexpr ConfigRange kBridge{"pose", "bridge_frames", "", 0, 300, true};

inline constexpr ConfigRange kDeadline{"governor", "deadline_ms", "ms", 0, 10000};
inline constexpr ConfigRange kLeastFree{"record", "least_free_mb", "MB", 0, 1e9};
inline constexpr ConfigRange kMostRecorded{"record", "most_mb", "MB", 0, 1e9};
inline constexpr ConfigRange kMemory{"limits", "memory_mb", "MB", 0, 1048576};
inline constexpr ConfigRange kStatusInterval{"status", "interval_s", "s", 0.1, 3600};

inline constexpr ConfigRange kTracing{"virtual", "budget_ms", "ms", 0.1, 1000};
inline constexpr ConfigRange kSamples{"virtual", "samples", "", 1, 65536, true};
inline constexpr ConfigRange kResolution{"virtual", "resolution", "", 0.05, 1};
inline constexpr ConfigRange kTracers{"virtual", "threads", "", 1, 64, true};
inline constexpr ConfigRange kTurn{"virtual", "turn_deg", "degrees", 0.1, 90};
inline constexpr ConfigRange kExposure{"light", "exposure", "", 0.001, 1000};

inline constexpr ConfigRange kSunDirection{"light.sun", "direction", "", -1000, 1000, false, 3};
inline constexpr ConfigRange kSunIrradiance{"light.sun", "irradiance", "", 0, 10000, false, 3};
inline constexpr ConfigRange kSunRadius{"light.sun", "radius_deg", "degrees", 0.05, 45};

inline constexpr ConfigRange kScale{"objects", "scale", "", 0.0001, 10000};
inline constexpr ConfigRange kPosition{"objects", "position", "m", -1000, 1000, false, 3};
inline constexpr ConfigRange kOrientation{"objects", "orientation", "", -1, 1, false, 4, true};
inline constexpr ConfigRange kObjectSize{"objects", "size", "m", 0.001, 100, false, 3};
inline constexpr ConfigRange kColour{"objects", "colour", "", 0, 1, false, 3};
inline constexpr ConfigRange kSecondColour{"objects", "second_colour", "", 0, 1, false, 3};
inline constexpr ConfigRange kSquares{"objects", "squares", "", 1, 256, true};

inline constexpr std::array kAll{
    kWidth,        kHeight,       kCameraRate, kPulse,          kDelay,        kJitter,
    kArrival,      kStillRate,    kExplained,  kMaxAge,         kMinInterval,  kTimeout,
    kTagSize,      kDecimation,   kDetectors,  kFullSearch,     kBridge,       kDeadline,
    kLeastFree,    kMostRecorded, kMemory,     kStatusInterval, kTracing,      kSamples,
    kResolution,   kTracers,      kTurn,       kExposure,       kSunDirection, kSunIrradiance,
    kSunRadius,    kScale,        kPosition,   kOrientation,    kObjectSize,   kColour,
    kSecondColour, kSquares};

}  // namespace mfar::range
