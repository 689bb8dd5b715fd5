#pragma once

#include "base/geometry.h"
#include "base/gl/buffer.h"
#include "base/gl/pass.h"
#include "base/gl/texture.h"
#include "hal/virtual/synthetic_light.h"
#include "hal/virtual/synthetic_params.h"
#include "hal/virtual/synthetic_scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::synthetic {

struct SensorLook {
    Eigen::Vector3f gain{1, 1, 1};
    float gamma = 2.2F;
    float blurSigma = 0;
    /// Noise variance of a linear value x (1 = white): shotNoise * x + readNoise.
    float shotNoise = 0;
    float readNoise = 0;
};

/// GL resources that all views of a world share: textures, light map, materials and programs. The
/// GL context must be current whenever this object is used or destroyed. Throws GlError.
class WorldGl {
public:
    WorldGl(const World& world, std::uint64_t seed);
    WorldGl(const WorldGl&) = delete;
    WorldGl& operator=(const WorldGl&) = delete;
    ~WorldGl();

private:
    friend class SensorView;

    void uploadLayers(std::uint64_t seed);
    void uploadMaterials();

    World world_;
    LightMap light_;
    std::array<int, static_cast<std::size_t>(Layer::Count)> slots_{};
    GLuint layers_ = 0;
    gpu::Texture lightMap_;
    gpu::Buffer materials_;
    gpu::DrawPass<params::SyntheticWorld> worldPass_;
    gpu::DrawPass<params::SyntheticSensor> sensorPass_;
};

/// Renders the pictures of one sensor, in the GL context of the WorldGl. A picture is rendered in
/// steps, so that other work need not wait for a large picture. A step renders at most as many
/// pixels as a video frame has.
class SensorView {
public:
    SensorView(WorldGl& world, const CameraModel& camera, const SensorLook& look);

    /// Begins a picture at time t [s]. If `noiseSeed` is 0, the picture has no noise.
    void begin(const RigidTransform& T_world_camera, double t, std::uint64_t noiseSeed);
    bool step();
    [[nodiscard]] bool complete() const { return row_ == camera_.size.height; }
    /// Writes the complete picture as RGBA8, row 0 first, rows without padding.
    void read(std::uint8_t* out);

    [[nodiscard]] Size size() const { return camera_.size; }

private:
    struct Rect {  ///< in normalised ray coordinates
        double left, top, right, bottom;
    };

    void findTiles();
    void uploadSolids(const RigidTransform& T_camera_world, double t);
    void uploadTiles(const std::vector<Rect>& bounds);

    WorldGl& world_;
    CameraModel camera_;
    SensorLook look_;
    params::SyntheticWorld params_{};
    std::uint64_t noiseSeed_ = 0;
    int row_ = 0;
    int tilesX_ = 0, tilesY_ = 0;
    std::vector<Rect> tileRays_;
    gpu::Buffer solids_, surfaces_, tiles_;
    gpu::Texture radiance_, picture_;
    gpu::Framebuffer radianceTarget_, pictureTarget_;
};

}  // namespace mfar::synthetic
