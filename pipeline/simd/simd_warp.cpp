#include "pipeline/simd/simd_warp.h"

#include "pipeline/simd/edge_sharpener.h"
#include "pipeline/simd/hole_pyramid.h"
#include "pipeline/simd/surface_raster.h"
#include "pipeline/simd/view_look_up.h"

#include <cstring>
#include <optional>
#include <utility>

namespace mfar::simd {
namespace {

template <class T>
AlignedRows<T> copied(Size size, const void* from) {
    AlignedRows<T> out(size);
    for (int y = 0; y < size.height; ++y)
        std::memcpy(out[y],
                    static_cast<const T*>(from) + static_cast<std::ptrdiff_t>(y) * size.width,
                    sizeof(T) * static_cast<std::size_t>(size.width));
    return out;
}

class SimdWarp final : public WarpStep {
public:
    SimdWarp(const CameraModel& layer, const WarpOptions& options, std::shared_ptr<Workers> workers,
             Transfers* transfers)
        : options_(options), raster_(layer, workers), lookUp_(LensProjection(layer), workers),
          pyramid_(layer.size, std::move(workers)), rerendered_(layer.size, fadeFrames(options)),
          store_(layer.size), state_({}, transfers), warped_(emptyLayer(transfers)),
          rendered_(emptyLayer(transfers)) {
        if (rerenders(options.filling) && options.sharpenShare > 0)
            sharpener_.emplace(layer.size, options.sharpenShare, options.mostRequested,
                               fadeFrames(options));
    }

    void setScene(const Scene& scene) override {
        raster_.setScene(scene);
        rerendered_.clear();
    }
    void setPoses(std::span<const RigidTransform> T_world_objects) override {
        raster_.setPoses(T_world_objects);
    }
    PixelRect bounds(const RigidTransform& T_world_camera) const override {
        return raster_.models().bounds(T_world_camera);
    }
    void setTracedPicture(const TracedPicture& traced) override {
        traced_ = &traced;
        lookUp_.setTracedPicture(traced);
        // Colours and depths are copied into padded rows. Steps that read a layer need the padding.
        picture_ = copied<std::uint32_t>(traced.camera.size, traced.picture.data());
        depth_ = copied<float>(traced.camera.size, traced.depth.data());
    }
    LayerPicture& traced() override {
        rendered_.colour.writtenOnHost(picture_.rows());
        rendered_.depth.writtenOnHost(depth_.rows());
        rendered_.bounds = traced_->bounds;
        return rendered_;
    }

    LayerPicture& run(const Frame& frame) override {
        const PixelRect& where = frame.bounds;
        if (!(around(drawn_, where) == where)) lookUp_.clear(drawn_);
        drawn_ = where;
        raster_.draw(frame.T_world_camera, where);
        const ViewLookUp::Input input{raster_, rerendered_, store_, raster_.models().plane()};
        lookUp_.run(input, frame.T_world_camera, where);
        pyramid_.fill({lookUp_.colour(), lookUp_.state(), where}, lookUp_.holes(),
                      options_.filling);
        if (frame.lists) listHoles();
        rerendered_.age();
        if (sharpener_) sharpener_->show(lookUp_.colour());
        state_.writtenOnHost(lookUp_.state());
        warped_.colour.writtenOnHost(lookUp_.colour());
        warped_.depth.writtenOnHost(lookUp_.depth());
        warped_.bounds = where;
        return warped_;
    }

    std::optional<WarpHoles> takeHoles() override { return std::exchange(listed_, std::nullopt); }
    bool holesPending() const override { return listed_.has_value(); }
    void dropHoles() override { listed_.reset(); }
    void addRerendered(const HoleAnswer& answer) override {
        rerendered_.add(answer,
                        [this](const RerenderedPictures::StoredRows& rows) { store_.store(rows); });
    }

    void listEdges() override {
        if (sharpener_) sharpener_->list(lookUp_.colour(), lookUp_.state(), drawn_);
    }
    std::optional<std::vector<std::uint32_t>> takeEdges() override {
        return sharpener_ ? sharpener_->take() : std::nullopt;
    }
    void answerEdges(const HoleAnswer& answer) override {
        if (sharpener_) sharpener_->answer(answer);
    }
    void dropEdges() override {
        if (sharpener_) sharpener_->drop();
    }

    const Field<std::uint32_t>& state() const override { return state_; }

private:
    static int fadeFrames(const WarpOptions& options) {
        return options.filling == HoleFilling::Both ? options.fadeFrames : 0;
    }
    static LayerPicture emptyLayer(Transfers* transfers) {
        return {Field<std::uint32_t>({}, transfers), Field<float>({}, transfers), {}};
    }
    void listHoles() {
        WarpHoles& out = listed_.emplace();
        for (const Hole& hole : lookUp_.holes()) {
            if (hole.isEdge)
                ++out.cracks;
            else if (hole.isOpen)
                out.open.push_back(hole.pixel);
        }
    }

    WarpOptions options_;
    SurfaceRaster raster_;
    ViewLookUp lookUp_;
    HolePyramid pyramid_;
    RerenderedPictures rerendered_;
    RerenderedStore store_;
    std::optional<EdgeSharpener> sharpener_;
    const TracedPicture* traced_ = nullptr;
    AlignedRows<std::uint32_t> picture_;
    AlignedRows<float> depth_;
    std::optional<WarpHoles> listed_;
    PixelRect drawn_;  // outside this rectangle, the pictures of lookUp_ are empty
    Field<std::uint32_t> state_;
    LayerPicture warped_, rendered_;
};

}  // namespace

std::unique_ptr<WarpStep> makeWarpStep(const CameraModel& layer, const WarpOptions& options,
                                       std::shared_ptr<Workers> workers, Transfers* transfers) {
    return std::make_unique<SimdWarp>(layer, options, std::move(workers), transfers);
}

}  // namespace mfar::simd
