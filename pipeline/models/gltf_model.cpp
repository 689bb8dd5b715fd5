#include "pipeline/models/gltf_model.h"

#include "base/bounded_file.h"
#include "pipeline/models/gltf_document.h"
#include "pipeline/models/gltf_material.h"
#include "pipeline/models/gltf_mesh.h"
#include "pipeline/models/gltf_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace mfar {
namespace {

Eigen::Affine3d upright() {
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    T.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    return T;
}

Eigen::Affine3d transformOf(const GltfDocument& document, const tinygltf::Node& node,
                            const std::string& place) {
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    const auto sizeIs = [](const std::vector<double>& list, std::size_t wanted) {
        return list.empty() || list.size() == wanted;
    };
    if (!sizeIs(node.matrix, 16) || !sizeIs(node.translation, 3) || !sizeIs(node.rotation, 4) ||
        !sizeIs(node.scale, 3))
        document.refuse(place,
                        "matrix must have 16 numbers, translation and scale 3, and rotation 4");
    if (!node.matrix.empty()) {
        const Eigen::Map<const Eigen::Matrix4d> matrix(node.matrix.data());
        T.matrix().topRows<3>() = matrix.topRows<3>();
    } else {
        if (!node.translation.empty()) T.translate(Eigen::Vector3d(node.translation.data()));
        if (!node.rotation.empty()) {
            const Eigen::Quaterniond q(Eigen::Vector4d(node.rotation.data()));
            if (!(q.norm() > 1e-6)) document.refuse(place, "rotation is a quaternion of length 0");
            T.rotate(q.normalized());
        }
        if (!node.scale.empty()) T.scale(Eigen::Vector3d(node.scale.data()));
    }
    if (!T.matrix().allFinite()) document.refuse(place, "the transform is not finite");
    return T;
}

Eigen::Quaterniond rotationOf(const tinygltf::Node& node) {
    if (node.rotation.empty()) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::Vector4d(node.rotation.data())).normalized();
}

bool isConstant(const GltfMotion::Tracks& tracks) {
    return tracks.translation.isConstant() && tracks.rotation.isConstant();
}

/// Returns the transform of a node whose tracks are constant. `local`: the node's own transform.
Eigen::Affine3d poseOf(const GltfMotion::Tracks& tracks, const tinygltf::Node& node,
                       const Eigen::Affine3d& local) {
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    T.translate(tracks.translation.times.empty() ? local.translation()
                                                 : tracks.translation.translationAt(0));
    T.rotate(tracks.rotation.times.empty() ? rotationOf(node) : tracks.rotation.rotationAt(0));
    if (!node.scale.empty()) T.scale(Eigen::Vector3d(node.scale.data()));
    return T;
}

constexpr std::size_t kMostParts = 16;  // also stated in the text of a note in placeOf()

/// Pose of a node in the model. `joints` are the moving nodes among the node and its ancestors, the
/// outermost first. scale * T maps the node's coordinates to the frame of the last joint, or
/// without joints to the model. `scale` is the product of the scales of all nodes above the last
/// joint. It is separate, because the frames of joints have no scale. `part`: see Mesh::part.
struct NodePlace {
    Eigen::Affine3d T = upright();
    std::vector<RigidPath::Joint> joints;
    double scale = 1;
    int part = 0;
};

/// Splits T into a rigid transform, which is returned, and a factor, which is written to `scale`.
/// Returns nothing if T scales the axes unequally or mirrors.
std::optional<RigidTransform> rigidPart(const Eigen::Affine3d& T, double& scale) {
    constexpr double kUnequal = 1e-4;
    const Eigen::Matrix3d& M = T.linear();
    scale = std::cbrt(std::max(M.determinant(), 0.0));
    const Eigen::Matrix3d squares = M.transpose() * M - scale * scale * Eigen::Matrix3d::Identity();
    if (!(scale > 0) || !(squares.cwiseAbs().maxCoeff() < kUnequal * scale * scale)) return {};
    const Eigen::Quaterniond turn(Eigen::Matrix3d(M / scale));
    return RigidTransform{turn.normalized(), T.translation()};
}

class ModelBuilder {
public:
    explicit ModelBuilder(const GltfDocument& document)
        : document_(document), materials_(document), motion_(document),
          onPath_(document.gltf.nodes.size(), false) {}

    Model build() {
        for (const int root : roots())
            addNode(root, {}, 0);
        if (model_.meshes.empty()) document_.refuse("scene", "the scene contains no triangles");
        model_.materials = materials_.takeMaterials();
        model_.textures = materials_.takeTextures();
        model_.notes = motion_.notes();
        return std::move(model_);
    }

private:
    /// Returns the root nodes of the default scene, else of the first scene, else all nodes without
    /// a parent.
    std::vector<int> roots() const {
        const tinygltf::Model& gltf = document_.gltf;
        if (!gltf.scenes.empty())
            return document_.at(gltf.scenes, std::max(gltf.defaultScene, 0), "scene").nodes;
        std::set<int> children;
        for (const tinygltf::Node& node : gltf.nodes)
            children.insert(node.children.begin(), node.children.end());
        std::vector<int> out;
        for (int i = 0; i < static_cast<int>(gltf.nodes.size()); ++i)
            if (!children.contains(i)) out.push_back(i);
        return out;
    }

    // The depth of the recursion is limited, so that the stack cannot overflow.
    void addNode(int index, const NodePlace& parent, int depth) {
        const std::string place = fmt::format("nodes[{}]", index);
        const tinygltf::Node& node = document_.at(document_.gltf.nodes, index, place);
        if (onPath_[index]) document_.refuse(place, "the node is its own ancestor");
        if (depth == document_.limits.nodeDepth)
            document_.refuse(place,
                             fmt::format("the node is nested more than {} levels deep", depth));
        if (++nodesShown_ > document_.limits.elements)
            document_.refuse(
                place, fmt::format("the model has more than {} nodes", document_.limits.elements));
        onPath_[index] = true;
        const NodePlace own = placeOf(index, parent, place);
        if (node.mesh >= 0) addMesh(node.mesh, own, place);
        for (const int child : node.children)
            addNode(child, own, depth + 1);
        onPath_[index] = false;
    }

    NodePlace placeOf(int index, const NodePlace& parent, const std::string& place) {
        const tinygltf::Node& node = document_.gltf.nodes[static_cast<std::size_t>(index)];
        const GltfMotion::Tracks* tracks = motion_.of(index);
        Eigen::Affine3d local = transformOf(document_, node, place);
        const bool moves = tracks != nullptr && !isConstant(*tracks);
        if (tracks != nullptr && !moves) local = poseOf(*tracks, node, local);
        NodePlace out = parent;
        out.T = parent.T * local;
        if (!moves) return out;
        double scale = 1;
        const std::optional<RigidTransform> above = rigidPart(parent.T, scale);
        if (!above || model_.paths.size() == kMostParts) {
            motion_.note(place, above ? "the node does not move: at most 16 nodes can move"
                                      : "the node does not move, because a parent scales it "
                                        "unequally or mirrors it");
            return out;
        }
        out.scale = parent.scale * scale;
        RigidPath::Joint joint;
        joint.T_parent_joint = {above->rotation, parent.scale * above->translation};
        joint.rest.translation = out.scale * local.translation();
        joint.rest.rotation = rotationOf(node);
        joint.translation = tracks->translation.scaled(out.scale);
        joint.rotation = tracks->rotation;
        requireNear(joint, place);
        out.joints.push_back(std::move(joint));
        for (const RigidPath::Joint& each : out.joints)
            for (const MotionTrack* track : {&each.translation, &each.rotation})
                motion_.count(*track, place);
        out.T = Eigen::Affine3d::Identity();
        if (!node.scale.empty()) out.T.scale(Eigen::Vector3d(node.scale.data()));
        model_.paths.push_back({out.joints, motion_.length()});
        out.part = static_cast<int>(model_.paths.size());
        return out;
    }

    void addMesh(int index, const NodePlace& node, const std::string& place) {
        const Eigen::Affine3d T = Eigen::Scaling(node.scale) * node.T;
        const tinygltf::Mesh& mesh = document_.at(document_.gltf.meshes, index, place + ".mesh");
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const std::optional<Mesh>& plain = primitive(index, i, mesh.primitives[i]);
            if (!plain) continue;
            count(vertices_, plain->positions.size(), document_.limits.vertices, "vertices", place);
            count(triangles_, plain->triangles.size(), document_.limits.triangles, "triangles",
                  place);
            model_.meshes.push_back(transformed(*plain, T));
            model_.meshes.back().part = node.part;
            requireNear(model_.meshes.back(), place);
        }
    }

    const std::optional<Mesh>& primitive(int mesh, std::size_t index,
                                         const tinygltf::Primitive& from) {
        const auto [it, isNew] = read_.try_emplace({mesh, index});
        if (!isNew) return it->second;
        const auto [material, mapping] = materials_.use(from.material);
        const Material& m = materials_[material];
        const bool bumpy = m.normalTexture >= 0;
        const bool textured = bumpy || m.baseColourTexture >= 0 ||
                              m.metallicRoughnessTexture >= 0 || m.emissionTexture >= 0;
        it->second =
            readPrimitive(document_, {from, mapping, textured, bumpy,
                                      fmt::format("meshes[{}].primitives[{}]", mesh, index)});
        if (it->second) it->second->material = material;
        if (it->second && it->second->triangles.empty()) it->second.reset();
        return it->second;
    }

    void count(std::size_t& sum, std::size_t more, std::size_t most, const char* what,
               const std::string& place) const {
        if (more > most - sum)
            document_.refuse(place, fmt::format("the model has more than {} {}", most, what));
        sum += more;
    }

    void requireNear(const Mesh& mesh, const std::string& place) const {
        for (const Eigen::Vector3f& p : mesh.positions)
            if (!(p.cwiseAbs().maxCoeff() <= document_.limits.farthest))
                document_.refuse(place, fmt::format("a vertex is farther than {} m from the origin",
                                                    document_.limits.farthest));
    }

    void requireNear(const RigidPath::Joint& joint, const std::string& place) const {
        const double most = document_.limits.farthest;
        const auto isNear = [most](const auto& p) { return p.cwiseAbs().maxCoeff() <= most; };
        if (!isNear(joint.T_parent_joint.translation) || !isNear(joint.rest.translation) ||
            !std::ranges::all_of(joint.translation.values, isNear))
            document_.refuse(place,
                             fmt::format("the node moves farther than {} m from its parent", most));
    }

    const GltfDocument& document_;
    GltfMaterials materials_;
    GltfMotion motion_;
    std::map<std::pair<int, std::size_t>, std::optional<Mesh>> read_;
    std::vector<bool> onPath_;
    std::size_t nodesShown_ = 0, vertices_ = 0, triangles_ = 0;
    Model model_;
};

}  // namespace

Model parseGltf(std::span<const std::uint8_t> bytes, const std::string& name,
                const std::filesystem::path& folder, const ModelLimits& limits) {
    const GltfDocument document = readDocument(bytes, name, folder, limits);
    return ModelBuilder(document).build();
}

Model loadGltf(const std::filesystem::path& file, const ModelLimits& limits) {
    std::vector<std::uint8_t> bytes;
    try {
        bytes = boundedFile(file, limits.bytes);
    } catch (const std::runtime_error& error) {
        throw ModelError(fmt::format("{}: {}", file.string(), error.what()));
    }
    const std::filesystem::path folder = file.parent_path();
    return parseGltf(bytes, file.string(), folder.empty() ? "." : folder, limits);
}

}  // namespace mfar
