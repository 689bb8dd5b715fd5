#pragma once

namespace mfar {

/// Work that a frame leaves out where it does not show. Each is on but to measure what it saves and
/// what error it adds; off, the work is done all the same. Others are settings of their own:
/// PipelineOptions::skipUnchanged and depthEverywhere, EpipolarOptions::mostPredicted,
/// KeyframeOptions and DepthOptions.
struct SkipOptions {
    bool upscaledTiles = true;  ///< tiles to which the still adds nothing are enlarged alone
    bool smoothTiles = true;    ///< tiles without structure are not matched, but enlarged alone
    bool plainTiles = true;     ///< tiles of one smooth flow are drawn with a quad's corners
    bool tileLists = true;      ///< the whole picture is drawn only when most tiles changed
    bool knownFlow = true;      ///< the 2-D flow starts from the last frame's
    bool knownBehind = true;    ///< depth of tiles known to lie behind an object
    bool objectsAtRest = true;  ///< objects over which nothing changed stay as drawn
    bool hiddenObjects = true;  ///< objects wholly behind real things are not drawn
    bool objectBounds = true;   ///< objects are laid over the picture where they are alone
};

}  // namespace mfar
