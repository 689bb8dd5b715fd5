#pragma once

namespace mfar {

/// Options by which a frame skips work whose result would not be visible. Each option is described
/// as it works when it is true.
/// Benchmarks turn one option off at a time, and measure the time that it saves and the error that
/// it causes. There are more options of this kind: PipelineOptions::skipUnchanged and
/// depthEverywhere, EpipolarOptions::mostPredicted, KeyframeOptions and DepthOptions.
struct SkipOptions {
    bool enlargedTiles = true;  ///< a tile to which the still adds nothing is only enlarged
    bool smoothTiles = true;    ///< a tile without structure is not matched but only enlarged
    /// A tile with a nearly affine flow and a nearly uniform weight is drawn as one rectangle.
    bool plainTiles = true;
    /// Only changed tiles are drawn, unless almost half of all tiles changed.
    bool tileLists = true;
    bool knownFlow = true;    ///< the 2-D search begins at the last frame's flow, so it is shorter
    bool knownBehind = true;  ///< real depth that is known to lie behind objects is not measured
    bool objectsAtRest = true;  ///< objects over unchanged tiles are not drawn again
    bool hiddenObjects = true;  ///< objects and shadows that real things occlude are not drawn
    bool objectBounds = true;   ///< the layer is drawn only in a rectangle around the objects
};

}  // namespace mfar
