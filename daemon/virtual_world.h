#pragma once

#include "daemon/objects_config.h"
#include "pipeline/pipeline.h"
#include "pipeline/scene/virtual_options.h"

#include <string_view>
#include <vector>

namespace mfar {

/// Passes the virtual objects and their light to the pipeline. Only the GL thread may use it.
class VirtualWorld {
public:
    VirtualWorld(const VirtualOptions& options, const StereoRig& rig, Pipeline& pipeline);

    /// Shows these objects at their poses in the tag map. Objects that leftOut() lists are not
    /// shown.
    void set(const std::vector<PlacedObject>& objects, const LightOptions& light,
             const TagMap& tags);
    /// Returns whether previews of virtual objects are shown. They are drawn with OpenGL ES, even
    /// if all steps run on the SIMD engine.
    [[nodiscard]] static bool drawsPreviews(const VirtualOptions& options);
    /// Returns why only simple shapes and no models are shown. Returns an empty text if models are
    /// shown.
    [[nodiscard]] std::string_view shapesAlone() const;

private:
    [[nodiscard]] TracedLayerOptions layerOptions() const;

    VirtualOptions options_;
    Size fullSize_;  // size of the output if it has the still's resolution
    Pipeline& pipeline_;
    bool traced_;
    float exposure_ = 1;
};

/// Returns the options of the traced layer. The caller must still set the size.
[[nodiscard]] TracedLayerOptions tracedLayerOptions(const VirtualOptions& options, float exposure);

/// Returns a scene with these objects at their poses in the tag map, in this light. If the light is
/// to be estimated from the camera, the scene has the light of a studio at first.
[[nodiscard]] Scene sceneOf(const std::vector<PlacedObject>& objects, const LightOptions& light,
                            const TagMap& tags);

}  // namespace mfar
