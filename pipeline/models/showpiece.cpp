#include "pipeline/models/showpiece.h"

#include "pipeline/models/lathe.h"
#include "pipeline/models/showpiece_paint.h"
#include "pipeline/models/surface_paint.h"
#include "pipeline/models/tangent_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mfar {
namespace {

constexpr int kGlaze = 0, kBrass = 1, kWalnut = 2;

float lengthOf(const LatheProfile& profile) {
    float length = 0;
    for (std::size_t i = 1; i < profile.size(); ++i)
        length += (profile[i] - profile[i - 1]).norm();
    return length;
}

/// Returns the profile's points at the centres of the `count` rows of a texture, from top to
/// bottom.
LatheProfile rowsOf(const LatheProfile& profile, int count) {
    LatheProfile out;
    const float whole = lengthOf(profile);
    std::size_t i = profile.size() - 1;
    float below = whole - (profile[i] - profile[i - 1]).norm();
    for (int row = 0; row < count; ++row) {
        const float at = whole * (1 - (static_cast<float>(row) + 0.5F) / static_cast<float>(count));
        while (at < below && i > 1) {
            --i;
            below -= (profile[i] - profile[i - 1]).norm();
        }
        const Eigen::Vector2f step = profile[i] - profile[i - 1];
        out.push_back(profile[i - 1] + step * ((at - below) / std::max(step.norm(), 1e-9F)));
    }
    return out;
}

LatheProfile ring(float radius, float height, float tube, int count) {
    LatheProfile out;
    for (int i = 0; i <= count; ++i) {
        const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / count;
        out.emplace_back(radius + tube * std::sin(turn), height - tube * std::cos(turn));
    }
    return out;
}

LatheProfile body() {
    return smoothProfile({{0.0195F, 0.0215F},
                          {0.0207F, 0.0265F},
                          {0.0300F, 0.0440F},
                          {0.0405F, 0.0680F},
                          {0.0432F, 0.0815F},
                          {0.0395F, 0.0945F},
                          {0.0275F, 0.1045F},
                          {0.0208F, 0.1090F}},
                         84);
}

void addJar(Mesh& mesh) {
    constexpr float kDepth = 0.035F;
    addTurned(mesh, body(), {.around = 176, .shape = [](float angle, float height) {
                                 return 1 - kDepth * fluteAt(angle, height);
                             }});
    // The lid has the texture of the body's foot, which has no ornament.
    const LatheProfile lid = smoothProfile({{0.0212F, 0.1108F},
                                            {0.0226F, 0.1122F},
                                            {0.0205F, 0.1170F},
                                            {0.0125F, 0.1228F},
                                            {0.0046F, 0.1256F}},
                                           28);
    addTurned(mesh, lid, {.around = 96, .vBottom = 0.995F, .vTop = 0.965F});
}

void addBrass(Mesh& mesh) {
    addTurned(mesh, ring(0.0208F, 0.0222F, 0.0019F, 16), {.around = 96});
    addTurned(mesh, ring(0.0208F, 0.1100F, 0.0014F, 14), {.around = 96});
    const LatheProfile finial = smoothProfile({{0.0048F, 0.1252F},
                                               {0.0030F, 0.1275F},
                                               {0.0026F, 0.1290F},
                                               {0.0050F, 0.1318F},
                                               {0.0057F, 0.1345F},
                                               {0.0038F, 0.1382F},
                                               {0.0013F, 0.1415F},
                                               {0.0F, 0.1450F}},
                                              36);
    addTurned(mesh, finial, {.around = 40});
    constexpr int kBeads = 40;
    for (int i = 0; i < kBeads; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kBeads;
        LatheProfile bead;
        constexpr int kRows = 7;
        for (int row = 0; row <= kRows; ++row) {
            const float turn = std::numbers::pi_v<float> * static_cast<float>(row) / kRows;
            bead.emplace_back(0.00155F * std::sin(turn), 0.0218F - 0.00155F * std::cos(turn));
        }
        bead.front().x() = bead.back().x() = 0;
        addTurned(mesh, bead,
                  {.around = 10, .centre = {0.0252F * std::cos(angle), 0.0252F * std::sin(angle)}});
    }
}

/// Returns the profile of the stand, divided at its sharp edges.
std::vector<LatheProfile> standPieces() {
    return {
        {{0.0F, 0.0F}, {0.0400F, 0.0F}},
        smoothProfile({{0.0400F, 0.0F},
                       {0.0424F, 0.0016F},
                       {0.0431F, 0.0042F},
                       {0.0420F, 0.0068F},
                       {0.0398F, 0.0080F}},
                      16),
        smoothProfile(
            {{0.0386F, 0.0080F}, {0.0352F, 0.0098F}, {0.0330F, 0.0126F}, {0.0324F, 0.0155F}}, 16),
        smoothProfile(
            {{0.0336F, 0.0155F}, {0.0350F, 0.0168F}, {0.0352F, 0.0184F}, {0.0338F, 0.0200F}}, 12),
        {{0.0338F, 0.0200F}, {0.0280F, 0.0204F}, {0.0F, 0.0204F}}};
}

LatheProfile standProfile() {
    LatheProfile whole;
    for (const LatheProfile& piece : standPieces())
        whole.insert(whole.end(), piece.begin(), piece.end());
    return whole;
}

void addStand(Mesh& mesh) {
    const float whole = lengthOf(standProfile());
    float done = 0;
    const Eigen::Vector2f* end = nullptr;
    const std::vector<LatheProfile> pieces = standPieces();
    for (const LatheProfile& piece : pieces) {
        if (end != nullptr) {
            const LatheProfile step = {*end, piece.front()};
            if (lengthOf(step) > 0)
                addTurned(
                    mesh, step,
                    {.vBottom = 1 - done / whole, .vTop = 1 - (done + lengthOf(step)) / whole});
            done += lengthOf(step);
        }
        const float next = done + lengthOf(piece);
        addTurned(mesh, piece, {.vBottom = 1 - done / whole, .vTop = 1 - next / whole});
        done = next;
        end = &piece.back();
    }
}

constexpr float kMeanCircumference = 0.22F;

void paintGlaze(Model& model) {
    constexpr Size kTexels{1536, 768};
    const LatheProfile profile = body(), rows = rowsOf(profile, kTexels.height);
    paint(model, model.materials[kGlaze], {kTexels, kMeanCircumference, lengthOf(profile)},
          [&](float u, float v) {
              return glazeAt(u, rows[static_cast<int>(v * kTexels.height)].y());
          });
}

void paintWalnut(Model& model) {
    constexpr Size kTexels{1024, 384};
    const LatheProfile profile = standProfile(), rows = rowsOf(profile, kTexels.height);
    paint(model, model.materials[kWalnut], {kTexels, kMeanCircumference, lengthOf(profile)},
          [&](float u, float v) {
              const Eigen::Vector2f& p = rows[static_cast<int>(v * kTexels.height)];
              const float angle = u * 2 * std::numbers::pi_v<float>;
              return walnutAt({p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()});
          });
}

}  // namespace

Model showpiece() {
    Model model;
    model.materials.resize(3);
    Material& brass = model.materials[kBrass];
    brass.baseColour = {0.90F, 0.66F, 0.33F, 1};
    brass.roughness = 0.27F;
    paintGlaze(model);
    paintWalnut(model);
    Mesh jar, brassware, stand;
    addJar(jar);
    addTangents(jar);
    addBrass(brassware);
    brassware.material = kBrass;
    addStand(stand);
    addTangents(stand);
    stand.material = kWalnut;
    model.meshes = {std::move(jar), std::move(brassware), std::move(stand)};
    return model;
}

}  // namespace mfar
