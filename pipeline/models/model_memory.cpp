#include "pipeline/models/gltf_model.h"

#include <algorithm>

namespace mfar {
namespace {

// Files, JSON, textures, meshes and animations can each use a fifth of the memory for reading a
// model.
constexpr std::size_t kParts = 5;
// Memory assumed for one JSON value [bytes]. It is enough for the value in the tree of
// nlohmann::json, and later for the same value in tinygltf's tree.
constexpr std::size_t kBytesPerJsonValue = 500;
constexpr std::size_t kBytesPerTexel = 4;
constexpr std::size_t kBytesPerVertex =
    2 * (2 * sizeof(Eigen::Vector3f) + sizeof(Eigen::Vector2f) + sizeof(Eigen::Vector4f));
// With CubicSpline, a keyframe has three values.
constexpr std::size_t kBytesPerKeyframe = sizeof(double) + 3 * sizeof(Eigen::Vector4d);
constexpr std::size_t kBytesPerTriangle = 2 * sizeof(std::array<std::uint32_t, 3>);

template <class T>
std::size_t bytesOf(const std::vector<T>& list) {
    return list.size() * sizeof(T);
}

}  // namespace

ModelLimits limitsWithin(std::size_t bytes) {
    const std::size_t part = bytes / kParts;
    ModelLimits out;
    out.bytes = std::min(out.bytes, part / 2);  // half, because tinygltf copies the buffers
    out.jsonValues = std::min(out.jsonValues, part / kBytesPerJsonValue);
    out.texels = std::min(out.texels, part / kBytesPerTexel);
    out.vertices = std::min(out.vertices, part / 2 / kBytesPerVertex);
    out.triangles = std::min(out.triangles, part / 2 / kBytesPerTriangle);
    out.keyframes = std::min(out.keyframes, part / 2 / kBytesPerKeyframe);
    return out;
}

std::size_t memoryOf(const Model& model) {
    std::size_t out = bytesOf(model.materials);
    for (const Mesh& mesh : model.meshes)
        out += bytesOf(mesh.positions) + bytesOf(mesh.normals) + bytesOf(mesh.uvs) +
               bytesOf(mesh.tangents) + bytesOf(mesh.triangles);
    for (const RigidPath& path : model.paths)
        for (const RigidPath::Joint& joint : path.joints)
            for (const MotionTrack* track : {&joint.translation, &joint.rotation})
                out += bytesOf(track->times) + bytesOf(track->values);
    for (const SurfaceTexture& texture : model.textures)
        out += bytesOf(texture.texels);
    return out;
}

}  // namespace mfar
