#include "pipeline/models/gltf_mesh.h"

#include "pipeline/models/gltf_accessor.h"
#include "pipeline/models/tangent_frames.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace mfar {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Shorter vectors have no usable direction and get a default direction.
constexpr float kShortestUnit = 1e-6F;

std::optional<int> attribute(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto it = primitive.attributes.find(name);
    if (it == primitive.attributes.end()) return std::nullopt;
    return it->second;
}

template <int N>
std::vector<Eigen::Vector<float, N>>
vectorsOf(const GltfDocument& document, const PrimitiveSource& source, const std::string& name) {
    const std::optional<int> accessor = attribute(source.primitive, name);
    if (!accessor) return {};
    const std::vector<float> values = accessorFloats(
        document, *accessor, N, document.limits.vertices, source.place + ".attributes." + name);
    std::vector<Eigen::Vector<float, N>> out(values.size() / N);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = Eigen::Map<const Eigen::Vector<float, N>>(&values[i * N]);
    return out;
}

std::vector<Triangle> trianglesOf(int mode, const std::vector<std::uint32_t>& indices) {
    std::vector<Triangle> out;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const Triangle t{indices[a], indices[b], indices[c]};
        // Skips triangles with two equal corners. Files use them to connect triangle strips.
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.push_back(t);
    };
    const std::size_t count = indices.size();
    if (mode == TINYGLTF_MODE_TRIANGLES)
        for (std::size_t i = 0; i + 2 < count; i += 3)
            add(i, i + 1, i + 2);
    else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        for (std::size_t i = 0; i + 2 < count; ++i)
            add(i, i + 1 + i % 2, i + 2 - i % 2);
    else
        for (std::size_t i = 1; i + 1 < count; ++i)
            add(i, i + 1, 0);
    return out;
}

std::vector<Triangle> readTriangles(const GltfDocument& document, const PrimitiveSource& source,
                                    std::size_t vertices) {
    std::vector<std::uint32_t> indices;
    const std::string place = source.place + ".indices";
    if (source.primitive.indices >= 0) {
        indices = accessorIndices(document, source.primitive.indices, 3 * document.limits.triangles,
                                  place);
        for (const std::uint32_t index : indices)
            if (index >= vertices)
                document.refuse(place,
                                fmt::format("index {} is out of range; there are {} vertices",
                                            index, vertices));
    } else {
        indices.resize(vertices);
        std::iota(indices.begin(), indices.end(), 0U);
    }
    const bool whole = source.primitive.mode != TINYGLTF_MODE_TRIANGLES || indices.size() % 3 == 0;
    if (!whole)
        document.refuse(place, fmt::format("triangles need a multiple of 3 indices, but found {}",
                                           indices.size()));
    return trianglesOf(source.primitive.mode, indices);
}

void requireSameCount(const GltfDocument& document, const PrimitiveSource& source,
                      std::size_t count, std::size_t wanted, const char* name) {
    if (count != 0 && count != wanted)
        document.refuse(source.place,
                        fmt::format("found {} {} for {} vertices", count, name, wanted));
}

void normalize(std::vector<Eigen::Vector3f>& normals) {
    for (Eigen::Vector3f& n : normals)
        n = n.norm() > kShortestUnit ? Eigen::Vector3f(n.normalized()) : Eigen::Vector3f::UnitZ();
}

void normalize(std::vector<Eigen::Vector4f>& tangents,
               const std::vector<Eigen::Vector3f>& normals) {
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        Eigen::Vector3f t = tangents[i].head<3>();
        if (!(t.norm() > kShortestUnit))
            t = normals.empty() ? Eigen::Vector3f::UnitX() : anyOrthogonal(normals[i]);
        tangents[i] << t.normalized(), (tangents[i].w() < 0 ? -1.0F : 1.0F);
    }
}

void readCoordinates(const GltfDocument& document, const PrimitiveSource& source, Mesh& mesh) {
    if (!source.textured) return;
    constexpr float kFarthestUv = 1e6F;
    mesh.uvs = vectorsOf<2>(document, source, fmt::format("TEXCOORD_{}", source.mapping.set));
    requireSameCount(document, source, mesh.uvs.size(), mesh.positions.size(),
                     "texture coordinates");
    for (Eigen::Vector2f& uv : mesh.uvs) {
        uv = source.mapping(uv);
        if (!(uv.cwiseAbs().maxCoeff() < kFarthestUv))
            document.refuse(source.place, "texture coordinates must be between -1e6 and 1e6");
    }
    // Without texture coordinates, a texture shows its value at (0, 0), the mean of its corner
    // texels.
    if (mesh.uvs.empty()) mesh.uvs.assign(mesh.positions.size(), Eigen::Vector2f::Zero());
}

void readFrames(const GltfDocument& document, const PrimitiveSource& source, Mesh& mesh) {
    mesh.normals = vectorsOf<3>(document, source, "NORMAL");
    requireSameCount(document, source, mesh.normals.size(), mesh.positions.size(), "normals");
    normalize(mesh.normals);
    if (!source.bumpy) return;
    // Tangents without normals must be ignored (glTF 2.0, 3.7.2.1).
    if (!mesh.normals.empty()) mesh.tangents = vectorsOf<4>(document, source, "TANGENT");
    requireSameCount(document, source, mesh.tangents.size(), mesh.positions.size(), "tangents");
    normalize(mesh.tangents, mesh.normals);
    if (mesh.tangents.empty()) addTangents(mesh);
}

}  // namespace

std::optional<Mesh> readPrimitive(const GltfDocument& document, const PrimitiveSource& source) {
    const int mode = source.primitive.mode;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN)
        document.refuse(source.place, fmt::format("mode must be from 0 to 6, not {}", mode));
    if (mode < TINYGLTF_MODE_TRIANGLES) return std::nullopt;
    Mesh mesh;
    mesh.positions = vectorsOf<3>(document, source, "POSITION");
    if (mesh.positions.empty()) return std::nullopt;
    mesh.triangles = readTriangles(document, source, mesh.positions.size());
    if (mesh.triangles.size() > document.limits.triangles)
        document.refuse(source.place, fmt::format("the model has more than {} triangles",
                                                  document.limits.triangles));
    readCoordinates(document, source, mesh);
    readFrames(document, source, mesh);
    return mesh;
}

Mesh transformed(const Mesh& mesh, const Eigen::Affine3d& T_model_mesh) {
    Mesh out = mesh;
    const Eigen::Matrix3d linear = T_model_mesh.linear();
    const bool mirrors = linear.determinant() < 0;
    for (Eigen::Vector3f& p : out.positions)
        p = (T_model_mesh * p.cast<double>()).cast<float>();
    // Normals are transformed with the cofactor matrix, because it exists even if the inverse does
    // not.
    Eigen::Matrix3d cofactors;
    for (int i = 0; i < 3; ++i)
        cofactors.col(i) = linear.col((i + 1) % 3).cross(linear.col((i + 2) % 3));
    if (mirrors) cofactors = -cofactors;
    // The entries of the matrix are products of two scales. With a scale of micrometres, they would
    // make the normals shorter than kShortestUnit.
    const double scale = cofactors.cwiseAbs().maxCoeff();
    if (scale > 0) cofactors /= scale;
    for (Eigen::Vector3f& n : out.normals)
        n = (cofactors * n.cast<double>()).cast<float>();
    normalize(out.normals);
    const double length = linear.cwiseAbs().maxCoeff();
    for (Eigen::Vector4f& t : out.tangents)
        t << (linear * t.head<3>().cast<double>() / (length > 0 ? length : 1)).cast<float>(),
            mirrors ? -t.w() : t.w();
    normalize(out.tangents, out.normals);
    if (mirrors)
        for (Triangle& t : out.triangles)
            std::swap(t[1], t[2]);
    return out;
}

}  // namespace mfar
