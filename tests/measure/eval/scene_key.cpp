#include "tests/measure/eval/scene_key.h"

#include <cstddef>

namespace mfar::eval {
namespace {

class Fnv1a {
public:
    /// T must have no padding, because the bytes of padding are not defined.
    template <class T>
    void add(const T* values, std::size_t count) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
        for (std::size_t i = 0; i < count * sizeof(T); ++i)
            sum_ = (sum_ ^ bytes[i]) * 1099511628211U;
    }
    template <class T>
    void add(const std::vector<T>& values) {
        addNumbers(values.size());
        add(values.data(), values.size());
    }
    template <class... T>
    void addNumbers(const T&... numbers) {
        (add(&numbers, 1), ...);
    }

    [[nodiscard]] std::uint64_t sum() const { return sum_; }

private:
    std::uint64_t sum_ = 14695981039346656037U;
};

void addPose(Fnv1a& hash, const RigidTransform& pose) {
    hash.add(pose.rotation.coeffs().data(), 4);
    hash.add(pose.translation.data(), 3);
}

void addTrack(Fnv1a& hash, const MotionTrack& track) {
    hash.addNumbers(track.between);
    hash.add(track.times);
    hash.add(track.values);
}

void addPath(Fnv1a& hash, const RigidPath& path) {
    hash.addNumbers(path.length, path.joints.size());
    for (const RigidPath::Joint& joint : path.joints) {
        addPose(hash, joint.T_parent_joint);
        addPose(hash, joint.rest);
        addTrack(hash, joint.translation);
        addTrack(hash, joint.rotation);
    }
}

void addMesh(Fnv1a& hash, const Mesh& mesh) {
    hash.add(mesh.positions);
    hash.add(mesh.normals);
    hash.add(mesh.uvs);
    hash.add(mesh.tangents);
    hash.add(mesh.triangles);
    hash.addNumbers(mesh.material, mesh.part);
}

void addMaterial(Fnv1a& hash, const Material& m) {
    hash.add(m.baseColour.data(), 4);
    hash.add(m.emission.data(), 3);
    hash.addNumbers(m.metallic, m.roughness, m.normalScale, m.alphaCutoff, m.doubleSided,
                    m.baseColourTexture, m.metallicRoughnessTexture, m.normalTexture,
                    m.emissionTexture);
}

void addModel(Fnv1a& hash, const Model& model) {
    hash.addNumbers(model.meshes.size(), model.paths.size(), model.materials.size(),
                    model.textures.size());
    for (const Mesh& mesh : model.meshes)
        addMesh(hash, mesh);
    for (const RigidPath& path : model.paths)
        addPath(hash, path);
    for (const Material& material : model.materials)
        addMaterial(hash, material);
    for (const SurfaceTexture& texture : model.textures) {
        hash.addNumbers(texture.size.width, texture.size.height, texture.srgb);
        hash.add(texture.texels);
    }
}

void addObjects(Fnv1a& hash, const std::vector<SceneObject>& objects) {
    hash.addNumbers(objects.size());
    const Model* last = nullptr;
    for (const SceneObject& object : objects) {
        // The parts of a model are consecutive objects with the same model.
        const bool isNew = object.model.get() != last;
        hash.addNumbers(isNew, object.scale, object.part, object.path != nullptr);
        if (isNew) addModel(hash, *object.model);
        last = object.model.get();
        addPose(hash, object.T_world_object);
        addPose(hash, object.T_world_ground);
        if (object.path) addPath(hash, *object.path);
    }
}

void addLighting(Fnv1a& hash, const Lighting& lighting) {
    hash.addNumbers(lighting.environment != nullptr, lighting.sun.has_value());
    if (lighting.environment) {
        hash.addNumbers(lighting.environment->size.width, lighting.environment->size.height);
        hash.add(lighting.environment->radiance);
    }
    if (lighting.sun) {
        hash.add(lighting.sun->towards.data(), 3);
        hash.add(lighting.sun->irradiance.data(), 3);
        hash.addNumbers(lighting.sun->angularRadius);
    }
}

}  // namespace

std::uint64_t sceneKey(const Scene& scene) {
    Fnv1a hash;
    addObjects(hash, scene.objects);
    addLighting(hash, scene.lighting);
    hash.add(scene.catcher.positions);
    hash.add(scene.catcher.triangles);
    hash.add(scene.catcher.albedo.data(), 3);
    return hash.sum();
}

}  // namespace mfar::eval
