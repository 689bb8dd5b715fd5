#pragma once

namespace mfar {

/// Work that a frame skips because it would not be visible. All are on; benchmarks turn one off to
/// measure the time that it saves and the error that it adds. Others are settings of their own:
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
