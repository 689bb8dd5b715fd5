#pragma once

#include "pipeline/slices/view_change.h"

#include <span>

namespace mfar {

/// Notices when the camera rests: objects have hardly moved in the camera's picture for some time.
class RestWatch {
public:
    /// Must be called once per frame.
    void look(const RenderView& now, std::span<const ObjectBall> objects);
    void reset() { looks_ = 0; }
    [[nodiscard]] bool rests() const;

private:
    RenderView at_;
    int looks_ = 0;  // number of looks since the view was at_
};

}  // namespace mfar
