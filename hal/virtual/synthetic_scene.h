#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The world of the synthetic board: a few convex solids with procedural materials. World frame =
/// tag-map frame, metres, z up; times in seconds since the world's epoch. Everything is a pure
/// function of scene, seed and time.
namespace mfar::synthetic {

enum class Scene { Office, Shelf, Outdoor, Flat, Moving, Still, Calibration };
enum class Path { Handheld, Pan, Orbit, Forward, Rotate, Rest, Survey };

/// Conversion to and from the command line's name. Unknown names give an empty result.
[[nodiscard]] std::string_view name(Scene scene);
[[nodiscard]] std::string_view name(Path path);
[[nodiscard]] std::optional<Scene> sceneNamed(std::string_view name);
[[nodiscard]] std::optional<Path> pathNamed(std::string_view name);

/// Procedural texture layers, see synthetic_textures.h.
enum class Layer : std::uint8_t {
    Paper,    ///< page of running text
    Article,  ///< page with two columns, a heading and a diagram
    Cover,    ///< book cover: printed title on linen
    Spine,    ///< spine of a book: lettering that runs downwards
    Label,    ///< bottle label
    Edges,    ///< stacked sheets seen from the side
    Wood,
    Plaster,
    Weave,
    Bark,
    Foliage,
    Brick,
    Gravel,
    Forest,     ///< distant tree line under a sky
    Enamel,     ///< smooth surface with fine specks
    Clouds,     ///< low-frequency variation that hides the other layers' repetition
    Tags,       ///< 2 x 2 AprilTags 36h11, see kTagIds
    AprilGrid,  ///< calibration target, see kGridTags
    Count
};

struct Material {
    Layer layer = Layer::Enamel;
    Eigen::Vector2d repeats{4, 4};     ///< texture repeats per metre; negative mirrors
    Eigen::Vector2d offset{0.5, 0.5};  ///< texture coordinate at the middle of the face
    Eigen::Vector3d tint{1, 1, 1};     ///< linear reflectance, multiplies the texture
    double variation = 0.15;           ///< strength of the low-frequency variation, 0..1
    double gloss = 0;                  ///< strength of the highlight, 0..1
};

enum class Shape : std::uint8_t { Box, Cylinder, Ellipsoid };

/// A convex solid centred on its own origin. A cylinder's axis is z.
struct Primitive {
    Shape shape = Shape::Box;
    RigidTransform T_world_prim;     ///< at time 0
    Eigen::Vector3d half;            ///< half extents [m]
    std::array<int, 3> materials{};  ///< for the +-x, +-y and +-z faces; cylinder side: x
    int lightTexels = 12;            ///< light map resolution of one face
    bool moves = false;              ///< follows World::moverPose
};

/// A tag of family 36h11 in the world. Tag frame as in libapriltag: origin in the centre, x right,
/// y down, z into the surface, seen from the front.
struct Tag {
    int id = 0;
    double size = 0;  ///< edge of the black square [m]
    RigidTransform T_world_tag;
    bool moves = false;
};

/// First intersection of a ray. `distance` is in units of the ray's direction.
struct Hit {
    double distance = 0;
    int primitive = 0;
    int axis = 0;  ///< axis of the hit face; ellipsoid: dominant axis
    bool positive = false;
    Eigen::Vector3d local;  ///< point in the primitive's frame [m]
};

/// A directed light of finite angular size plus the sky's ambient light.
struct Lighting {
    Eigen::Vector3d towards{0.3, -0.3, 0.9};  ///< unit, towards the light
    double spread = 0.1;                      ///< radius of the light [tan of angle]
    Eigen::Vector3d key{1, 1, 1};             ///< linear colour
    Eigen::Vector3d ambient{0.4, 0.4, 0.4};
    Eigen::Vector3d background{0.6, 0.7, 0.85};  ///< radiance where no solid is hit
};

struct World {
    std::vector<Material> materials;
    std::vector<Primitive> primitives;
    std::vector<Tag> tags;
    Lighting light;
    Eigen::Vector3d eye;     ///< nominal camera position
    Eigen::Vector3d target;  ///< nominal look-at point
    /// Centre of the moving object at time 0.
    Eigen::Vector3d moverPivot = Eigen::Vector3d::Zero();
    /// Radius of the moving object [m]; 0: no moving object.
    double moverRadius = 0;

    /// Pose of a primitive at time t.
    [[nodiscard]] RigidTransform primitivePose(int index, double t) const;
    /// Motion of the moving object at time t, to be multiplied in front of T_world_prim.
    [[nodiscard]] RigidTransform moverPose(double t) const;
};

/// Upper limit of a world's primitives; the renderer's tables have this size.
inline constexpr int kMaxPrimitives = 128;
/// Tags on the Tags layer, row by row.
inline constexpr std::array<int, 4> kTagIds{0, 1, 2, 3};

/// The target of scene Calibration as Kalibr describes it: 6 x 6 tags of family 36h11, id 0 at the
/// bottom left, ids rising to the right and then upwards, a black square at every corner.
inline constexpr int kGridTags = 6;            ///< tags per side
inline constexpr double kGridTagSize = 0.064;  ///< edge of a black square with its tag [m]
inline constexpr double kGridSpacing = 0.25;   ///< gap between tags / kGridTagSize

[[nodiscard]] World makeWorld(Scene scene, std::uint64_t seed);

/// Pose of the video camera at time t.
[[nodiscard]] RigidTransform cameraPose(const World& world, Path path, std::uint64_t seed,
                                        double t);

/// The board's sensors: 640x480 video, 2304x1728 still, 14 mm apart.
[[nodiscard]] StereoRig boardRig();

}  // namespace mfar::synthetic
