#include "pipeline/gles/edge_refiner.h"
#include "pipeline/gles/gles_steps.h"
#include "pipeline/gles/model_silhouette.h"
#include "pipeline/gles/rerendered_textures.h"
#include "pipeline/gles/texture_layer.h"
#include "pipeline/gles/view_look_up.h"
#include "pipeline/scene/scene_parts.h"
#include "pipeline/warp/warp_step.h"

#include <optional>
#include <utility>

namespace mfar::gles {
namespace {

class GlesWarp final : public WarpStep {
public:
    GlesWarp(const CameraModel& layer, const WarpOptions& options, Transfers* transfers)
        : lens_(layer), options_(options), silhouette_(layer), lookUp_(lens_), filler_(layer.size),
          rerendered_(layer.size, fadeFrames(options)), rerenderedTextures_(layer.size),
          stateCopy_(lookUp_.state()), state_({}, transfers), warped_(transfers),
          rendered_(transfers) {
        if (rerenders(options.filling) && options.sharpenShare > 0)
            refiner_.emplace(layer.size, options.sharpenShare, options.mostRequested,
                             fadeFrames(options));
    }

    void setScene(const Scene& scene) override {
        silhouette_.setScene(scene);
        if (moves(scene)) lookUp_.prepareMotion();
        rerendered_.clear();
    }
    void setPoses(std::span<const RigidTransform> T_world_objects) override {
        silhouette_.setPoses(T_world_objects);
    }
    PixelRect bounds(const RigidTransform& T_world_camera) const override {
        return silhouette_.bounds(T_world_camera);
    }
    void setTracedPicture(const TracedPicture& traced) override {
        textures_.upload(traced);
        lookUp_.setTracedPicture(traced, textures_);
        traced_ = &traced;
    }
    LayerPicture& traced() override {
        return rendered_.show(textures_.picture(), textures_.depth(), traced_->bounds);
    }

    LayerPicture& run(const Frame& frame) override {
        const PixelRect& where = frame.bounds;
        if (!(around(drawn_, where) == where)) lookUp_.clear(drawn_);
        drawn_ = where;
        lookUp(frame);
        filler_.fill(lookUp_.colour(), lookUp_.state(), frame.lists);
        rerendered_.age();
        if (refiner_) refiner_->show(lookUp_.colour());
        state_.writtenOnDevice(stateCopy_, lookUp_.state().size());
        return warped_.show(lookUp_.colour(), lookUp_.depth(), where);
    }

    std::optional<WarpHoles> takeHoles() override { return filler_.poll(); }
    bool holesPending() const override { return filler_.isPending(); }
    void dropHoles() override { filler_.drop(); }
    void addRerendered(const HoleAnswer& answer) override {
        rerendered_.add(answer, [this](const RerenderedPictures::StoredRows& rows) {
            rerenderedTextures_.store(rows);
        });
    }

    void listEdges() override {
        if (refiner_) refiner_->list(lookUp_.colour(), lookUp_.state(), drawn_);
    }
    std::optional<std::vector<std::uint32_t>> takeEdges() override {
        return refiner_ ? refiner_->poll() : std::nullopt;
    }
    void answerEdges(const HoleAnswer& answer) override {
        if (refiner_) refiner_->answer(answer);
    }
    void dropEdges() override {
        if (refiner_) refiner_->drop();
    }

    const Field<std::uint32_t>& state() const override { return state_; }

private:
    static int fadeFrames(const WarpOptions& options) {
        return options.filling == HoleFilling::Both ? options.fadeFrames : 0;
    }

    void lookUp(const Frame& frame) {
        silhouette_.draw(frame.T_world_camera, frame.bounds);
        const ViewLookUp::Input input{silhouette_, textures_, *traced_, rerendered_,
                                      rerenderedTextures_};
        filler_.begin(frame.bounds, options_.filling);
        lookUp_.run(input, frame.T_world_camera, frame.bounds, filler_);
    }

    LensProjection lens_;
    WarpOptions options_;
    ModelSilhouette silhouette_;
    TracedTextures textures_;
    ViewLookUp lookUp_;
    HoleFiller filler_;
    RerenderedPictures rerendered_;
    RerenderedTextures rerenderedTextures_;
    std::optional<EdgeRefiner> refiner_;
    const TracedPicture* traced_ = nullptr;
    PixelRect drawn_;  // outside this rectangle, the pictures of lookUp_ are empty
    TextureCopy stateCopy_;
    Field<std::uint32_t> state_;
    TextureLayer warped_, rendered_;
};

}  // namespace

std::unique_ptr<WarpStep> makeWarpStep(const StepSetup& setup, const CameraModel& layer,
                                       const WarpOptions& options) {
    return std::make_unique<GlesWarp>(layer, options, setup.transfers);
}

}  // namespace mfar::gles
