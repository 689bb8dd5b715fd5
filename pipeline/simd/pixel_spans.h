#pragma once

#include <algorithm>
#include <vector>

namespace mfar::simd {

struct PixelSpan {
    int begin, end;
    bool operator==(const PixelSpan&) const = default;
};

/// Spans of pixels of a row in ascending order. They neither touch nor overlap.
using PixelSpans = std::vector<PixelSpan>;

/// Appends `added`, which must not begin before the last span. Merges both spans if they touch or
/// overlap.
inline void append(PixelSpans& spans, const PixelSpan& added) {
    if (!spans.empty() && added.begin <= spans.back().end)
        spans.back().end = std::max(spans.back().end, added.end);
    else
        spans.push_back(added);
}

[[nodiscard]] inline bool contains(const PixelSpans& spans, const PixelSpans& pixels) {
    return std::ranges::all_of(pixels, [&](const PixelSpan& some) {
        return std::ranges::any_of(spans, [&](const PixelSpan& span) {
            return span.begin <= some.begin && some.end <= span.end;
        });
    });
}

}  // namespace mfar::simd
