#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The world that the simulated cameras see: a few convex solids with procedural materials. The
/// world frame is the frame of the tag map, in metres, with z up. Times are in seconds since the
/// world's epoch. The world depends only on scene, seed and time.
namespace mfar::synthetic {

enum class Scene { Office, Shelf, Outdoor, Flat, Moving, Still, Calibration };
enum class Path { Handheld, Pan, Orbit, Forward, Rotate, Rest, Survey };

/// Converts a scene or camera path to its name on the command line, and back. Returns nothing for
/// an unknown name.
[[nodiscard]] std::string_view name(Scene scene);
[[nodiscard]] std::string_view name(Path path);
[[nodiscard]] std::optional<Scene> sceneNamed(std::string_view name);
[[nodiscard]] std::optional<Path> pathNamed(std::string_view name);

enum class Layer : std::uint8_t {
    Paper,
    Article,
    Cover,
    Spine,
    Label,
    Edges,
    Wood,
    Plaster,
    Weave,
    Bark,
    Foliage,
    Brick,
    Gravel,
    Forest,
    Enamel,
    Clouds,     ///< low-frequency variation that hides the repeats of other layers
    Tags,       ///< 2 x 2 AprilTags 36h11, see kTagIds
    AprilGrid,  ///< a calibration target, see kGridTags
    Count
};

/// The look of a solid's face: the texture `layer`, multiplied by `tint`. `repeats` states how
/// often the texture repeats per metre; negative values mirror it. `offset` is the texture
/// coordinate at the face's centre. `variation` and `gloss` are from 0 to 1.
struct Material {
    Layer layer = Layer::Enamel;
    Eigen::Vector2d repeats{4, 4};
    Eigen::Vector2d offset{0.5, 0.5};
    Eigen::Vector3d tint{1, 1, 1};
    double variation = 0.15;
    double gloss = 0;
};

enum class Shape : std::uint8_t { Box, Cylinder, Ellipsoid };

/// A convex solid. Its centre is the origin of its frame. The axis of a cylinder is z. `half` is
/// half of the extent along each axis [m]. T_world_prim is its pose; if `moves` is set,
/// World::moverPose() is applied to that pose.
struct Primitive {
    Shape shape = Shape::Box;
    RigidTransform T_world_prim;
    Eigen::Vector3d half;
    /// Indices of the materials of the +-x, +-y and +-z faces. A cylinder's side uses the first.
    std::array<int, 3> materials{};
    int lightTexels = 12;  ///< side of a face in the light map [texels]
    bool moves = false;
};

/// A tag of family 36h11 in the world. Its frame is that of libapriltag: the origin is the tag's
/// centre; seen from the front, x is right, y is down and z points into the surface. `size` is the
/// side of the black square [m].
struct Tag {
    int id = 0;
    double size = 0;
    RigidTransform T_world_tag;
    bool moves = false;
};

/// The first intersection of a ray with a solid. `distance` is in multiples of the length of
/// Ray::direction. `local` is the point in the primitive's frame [m].
struct Hit {
    double distance = 0;
    int primitive = 0;
    int axis = 0;  ///< axis of the face that was hit; ellipsoid: the nearest axis
    bool positive = false;
    Eigen::Vector3d local;
};

/// A directed key light of finite angular size, and the ambient light of the sky. `towards` is the
/// unit vector to the key light. `background` is the radiance where a ray hits no solid.
struct Lighting {
    Eigen::Vector3d towards{0.3, -0.3, 0.9};
    double spread = 0.1;  ///< tangent of the key light's angular radius
    Eigen::Vector3d key{1, 1, 1};
    Eigen::Vector3d ambient{0.4, 0.4, 0.4};
    Eigen::Vector3d background{0.6, 0.7, 0.85};
};

/// `eye` is the camera's position on Path::Rest, `target` the point that it looks at from there
/// [m].
struct World {
    std::vector<Material> materials;
    std::vector<Primitive> primitives;
    std::vector<Tag> tags;
    Lighting light;
    Eigen::Vector3d eye;
    Eigen::Vector3d target;
    /// Centre of the moving object before moverPose() is applied, and its radius [m]. Radius 0:
    /// there is no moving object.
    Eigen::Vector3d moverPivot = Eigen::Vector3d::Zero();
    double moverRadius = 0;

    [[nodiscard]] RigidTransform primitivePose(int index, double t) const;
    /// Returns the motion of the moving object at time t [s]. The object's primitives then have the
    /// pose moverPose(t) * T_world_prim.
    [[nodiscard]] RigidTransform moverPose(double t) const;
};

/// Largest number of primitives in a world. The renderer's tables have this size.
inline constexpr int kMaxPrimitives = 128;
inline constexpr std::array<int, 4> kTagIds{0, 1, 2, 3};

/// The target of scene Calibration, as Kalibr describes it: 6 x 6 tags of family 36h11 with a black
/// square at each corner of a tag. The tag with id 0 is at the bottom left. Ids increase to the
/// right, then upwards.
inline constexpr int kGridTags = 6;
inline constexpr double kGridTagSize = 0.064;  ///< side of a tag's black border [m]
inline constexpr double kGridSpacing = 0.25;   ///< gap between tags, divided by kGridTagSize

[[nodiscard]] World makeWorld(Scene scene, std::uint64_t seed);

[[nodiscard]] RigidTransform cameraPose(const World& world, Path path, std::uint64_t seed,
                                        double t);

/// The cameras of the simulated board: video of 640x480 and stills of 2304x1728 pixels, 14 mm
/// apart.
[[nodiscard]] StereoRig boardRig();
/// Returns boardRig() with other picture sizes and the same fields of view.
[[nodiscard]] StereoRig boardRig(Size video, Size still);

}  // namespace mfar::synthetic
