#pragma once

#include "daemon/objects_config.h"
#include "pipeline/pipeline.h"
#include "pipeline/scene/virtual_options.h"

#include <string_view>
#include <vector>

namespace mfar {

/// Virtual objects, their light and the real surface under them, as the pipeline is to show them.
/// Lives on the GL thread.
class VirtualWorld {
public:
    VirtualWorld(const VirtualOptions& options, const StereoRig& rig, Pipeline& pipeline);

    /// Shows these, placed by the tag map, without those that are leftOut().
    void set(const std::vector<PlacedObject>& objects, const LightOptions& light,
             const TagMap& tags);
    /// Whether `options` show previews, which are drawn with OpenGL ES, whatever engine does the
    /// steps.
    [[nodiscard]] static bool drawsPreviews(const VirtualOptions& options);
    /// Why models are not shown; empty when they are.
    [[nodiscard]] std::string_view shapesAlone() const;

private:
    [[nodiscard]] TracedLayerOptions layerOptions() const;

    VirtualOptions options_;
    Size fullSize_;  // of the still's resolution
    Pipeline& pipeline_;
    bool traced_;
    float exposure_ = 1;
};

/// Options of the traced layer but for its size, which the caller sets.
[[nodiscard]] TracedLayerOptions tracedLayerOptions(const VirtualOptions& options, float exposure);

/// A scene of these objects, placed by the tag map, in this light. Light that the camera is to
/// tell is a dim studio's until it does.
[[nodiscard]] Scene sceneOf(const std::vector<PlacedObject>& objects, const LightOptions& light,
                            const TagMap& tags);

}  // namespace mfar
