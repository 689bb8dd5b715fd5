#pragma once

namespace mfar {

/// Work that a frame skips where the result would not show. All on by default; benchmarks turn one
/// off to measure what it saves and what error it adds. Related settings elsewhere:
/// PipelineOptions::skipUnchanged and depthEverywhere, EpipolarOptions::mostPredicted,
/// KeyframeOptions and DepthOptions.
struct SkipOptions {
    bool upscaledTiles = true;  ///< tiles to which the still adds nothing are only enlarged
    bool smoothTiles = true;    ///< tiles without structure are not matched, but only enlarged
    /// Tiles with nearly constant flow and weight are drawn as one quad.
    bool plainTiles = true;
    bool tileLists = true;      ///< the whole picture is drawn only if most tiles changed
    bool knownFlow = true;      ///< the 2-D flow search starts from the last frame's flow
    bool knownBehind = true;    ///< no depth measurement in tiles known to lie behind an object
    bool objectsAtRest = true;  ///< objects over unchanged tiles are not drawn again
    bool hiddenObjects = true;  ///< objects completely behind real things are not drawn
    bool objectBounds = true;   ///< objects are composited only within their bounds
};

}  // namespace mfar
