#include "pipeline/traced_layer.h"

#include <stdexcept>

// Replaces traced_layer.cpp in builds without path tracer. (They have no Embree, the library that
// traces rays.)
namespace mfar {

struct TracedLayer::State {};

bool TracedLayer::isAvailable() {
    return false;
}

TracedLayer::TracedLayer(const CameraModel&, Engine&, const TracedLayerOptions&) {
    throw std::runtime_error(
        "this build has no path tracer, so virtual objects can be shown only as a preview");
}
TracedLayer::~TracedLayer() = default;

// These functions are never called, because the constructor always throws.
void TracedLayer::setScene(std::shared_ptr<const Scene>) {}
void TracedLayer::update(const RigidTransform&, Timestamp) {}
bool TracedLayer::isStale() const {
    return false;
}
LayerPicture& TracedLayer::render(const RigidTransform&) {
    static LayerPicture nothing;
    return nothing;
}
bool TracedLayer::rests() const {
    return true;
}
TracedLayerCounters TracedLayer::counters() const {
    return {};
}
std::optional<std::string> TracedLayer::takeError() {
    return {};
}

}  // namespace mfar
