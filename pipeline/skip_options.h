#pragma once

namespace mfar {

/// Work that a frame skips because it would not be visible. All are on; benchmarks turn one off to
/// measure the time that it saves and the error that it adds. Others are settings of their own:
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
