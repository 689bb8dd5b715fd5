#pragma once

#include "pipeline/composite/virtual_object.h"
#include "pipeline/scene/scene.h"
#include "pipeline/slices/slices.h"
#include "pipeline/track/tag_family.h"
#include "pipeline/warp/warp_options.h"

#include <memory>
#include <optional>
#include <string>

namespace mfar {

/// One thing to be shown, as it was configured.
struct PlacedObject {
    /// What it is. Null: the simple shape.
    std::shared_ptr<const Model> model;
    std::string modelName;  ///< "showpiece" or a file, for messages; empty for a shape
    VirtualObject shape;    ///< its T_world_object is not used
    float scale = 1;        ///< of a model, above 0
    RigidTransform T_anchor_object;
    /// What it stands on. Nothing: the world of the tag map. A tag: its middle, x to the right and
    /// y up in its print, z out of it.
    std::optional<TagKey> tag;
};

enum class LightSource : unsigned char {
    Studio,  ///< studioEnvironment()
    Sky,     ///< skyEnvironment()
    File,    ///< a latitude-longitude picture
    Camera,  ///< estimated from the video, LightEstimator
};

struct LightOptions {
    LightSource source = LightSource::Studio;
    std::shared_ptr<const Environment> environment;  ///< of a file; null for other sources
    std::string file;                                ///< for messages
    /// Light beside the environment; the camera's own estimate of one gives way to it.
    std::optional<Sun> sun;
    float exposure = 1;  ///< radiance 1 / exposure is white; above 0
};

enum class VirtualRendering : unsigned char { PathTraced, Preview };

/// How the virtual layer is made.
struct VirtualOptions {
    VirtualRendering rendering = VirtualRendering::PathTraced;
    double budgetMs = 8;  ///< of the path tracer in each frame [ms]
    Slicing slicing = Slicing::Time;
    int samples = 64;          ///< a pixel of a finished picture
    double resolution = 0.28;  ///< side of a path-traced picture, as a share of the still's
    HoleFilling holes = HoleFilling::Both;
    int threads = 1;     ///< of the path tracer
    bool filter = true;  ///< smooths the noise of pictures with few samples
    double turnDeg = 4;  ///< view angle after which a new picture is made at the latest [degrees]

    bool operator==(const VirtualOptions&) const = default;
};

}  // namespace mfar
