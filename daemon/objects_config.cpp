#include "daemon/objects_config.h"

#include "daemon/toml_reader.h"
#include "pipeline/models/gltf_model.h"
#include "pipeline/models/showpiece.h"
#include "pipeline/render/scene_check.h"

#include <fmt/format.h>

#include <system_error>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <utility>

namespace mfar {
namespace {

constexpr std::array<std::pair<std::string_view, VirtualShape>, 3> kShapes = {
    {{"box", VirtualShape::Box}, {"sphere", VirtualShape::Sphere}, {"quad", VirtualShape::Quad}}};

std::optional<std::string> lengthFault(std::span<const double> wxyz) {
    constexpr double kTolerance = 0.01;
    double square = 0;
    for (const double part : wxyz)
        square += part * part;
    if (std::abs(std::sqrt(square) - 1) < kTolerance) return std::nullopt;
    return "must be a quaternion [w, x, y, z] of length 1";
}

void readShape(TomlReader& file, const std::string& prefix, VirtualObject& out) {
    out.size.setConstant(0.1);
    file.choice<VirtualShape>(prefix + "shape", out.shape, kShapes);
    file.numbers(prefix + "size", {out.size.data(), 3});
    // If only `colour` is given, it is used for the whole object.
    Eigen::Vector3d first = Eigen::Vector3d::Constant(-1);
    file.numbers(prefix + "colour", {first.data(), 3});
    if (first.x() >= 0) out.colours.fill(first.cast<float>());
    Eigen::Vector3d second = out.colours[1].cast<double>();
    file.numbers(prefix + "second_colour", {second.data(), 3});
    out.colours[1] = second.cast<float>();
    file.integer(prefix + "squares", out.squares);
}

/// Reads model files. Each file is read once, even if several objects show it and name it by
/// different paths.
class ModelReader {
public:
    /// `shapes` is the number of objects without a model.
    ModelReader(std::filesystem::path folder, FileMemory& memory, std::size_t shapes)
        : folder_(std::move(folder)), memory_(memory), parts_(shapes) {}

    std::shared_ptr<const Model> operator()(std::string_view name) {
        std::shared_ptr<const Model>& known = models_[identity(name)];
        if (!known) {
            known = std::make_shared<const Model>(load(name));
            memory_.take(memoryOf(*known));
        }
        countParts(*known);
        return known;
    }

private:
    // The path tracer counts each of these as an object: each simple shape, each node of a model
    // that moves by itself, and the rest of each model.
    void countParts(const Model& model) {
        parts_ += model.paths.size() + 1;
        if (parts_ > kMostSceneObjects)
            throw ModelError(fmt::format(
                "the objects and the moving nodes of their models together are more than {}",
                kMostSceneObjects));
    }

    [[nodiscard]] std::filesystem::path identity(std::string_view name) const {
        std::error_code missing;
        const std::filesystem::path file = folder_ / name;
        std::filesystem::path same = std::filesystem::weakly_canonical(file, missing);
        return missing ? file : same;
    }
    [[nodiscard]] Model load(std::string_view name) const {
        try {
            if (name == "showpiece") return showpiece();
            return loadGltf(folder_ / name, limitsWithin(memory_.left()));
        } catch (const std::bad_alloc&) {
            throw ModelError((folder_ / name).string() +
                             ": needs more memory than the machine has available");
        }
    }

    std::filesystem::path folder_;
    FileMemory& memory_;
    std::size_t parts_;
    std::map<std::filesystem::path, std::shared_ptr<const Model>> models_;
};

void readModel(TomlReader& file, const std::string& prefix, ModelReader& models,
               PlacedObject& out) {
    file.text(prefix + "model", out.modelName,
              [&](std::string_view name) -> std::optional<std::string> {
                  try {
                      out.model = models(name);
                      return std::nullopt;
                  } catch (const ModelError& error) {
                      return error.what();
                  }
              });
    double scale = 1;
    file.number(prefix + "scale", scale);
    out.scale = static_cast<float>(scale);
}

void readTag(TomlReader& file, const std::string& prefix, std::optional<TagKey>& tag) {
    TagKey key{TagFamily::Tag36h11, -1};
    constexpr std::array<std::pair<std::string_view, TagFamily>, 4> kFamilies = {
        {{kTagFamilies[0].name, kTagFamilies[0].family},
         {kTagFamilies[1].name, kTagFamilies[1].family},
         {kTagFamilies[2].name, kTagFamilies[2].family},
         {kTagFamilies[3].name, kTagFamilies[3].family}}};
    file.choice<TagFamily>(prefix + "family", key.family, kFamilies);
    file.integer(prefix + "tag", key.id, info(key.family).count - 1);
    if (key.id >= 0) tag = key;
}

PlacedObject readObject(TomlReader& file, const std::string& prefix, ModelReader& models) {
    PlacedObject out;
    readModel(file, prefix, models, out);
    readShape(file, prefix, out.shape);
    readTag(file, prefix, out.tag);
    RigidTransform& T = out.T_anchor_object;
    file.numbers(prefix + "position", {T.translation.data(), 3});
    std::array<double, 4> wxyz{1, 0, 0, 0};
    file.numbers(prefix + "orientation", wxyz, lengthFault);
    T.rotation = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
    return out;
}

/// Adds a note for each key that has no effect: a shape's key on a model, or `scale` on a shape.
void noteUnused(const TomlReader& file, const std::string& prefix, const PlacedObject& object,
                std::vector<std::string>& notes) {
    const auto note = [&](const char* key, const char* why) {
        if (const std::optional<std::string> place = file.placeOf(prefix + key))
            notes.push_back(*place + "has no effect, because the object is a " + why);
    };
    if (!object.model) return note("scale", "simple shape");
    for (const char* key : {"shape", "size", "colour", "second_colour", "squares"})
        note(key, "model");
}

}  // namespace

void readObjects(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
                 std::vector<PlacedObject>& objects, std::vector<std::string>& notes) {
    const std::vector<std::string> prefixes = file.sections("objects", kMostObjects);
    // The shapes are counted first. So if there are too many objects and moving nodes, the fault
    // names the line of the model with which the limit is exceeded.
    const auto shapes = std::ranges::count_if(
        prefixes, [&](const std::string& prefix) { return !file.placeOf(prefix + "model"); });
    ModelReader models(folder, memory, static_cast<std::size_t>(shapes));
    for (const std::string& prefix : prefixes) {
        objects.push_back(readObject(file, prefix, models));
        noteUnused(file, prefix, objects.back(), notes);
    }
}

std::optional<RigidTransform> worldAnchor(const PlacedObject& object, const TagMap& tags) {
    if (!object.tag) return RigidTransform{};
    const MappedTag* tag = tags.find(*object.tag);
    if (tag == nullptr) return std::nullopt;
    return tag->T_world_tag * standOnTag();
}

std::optional<RigidTransform> worldPlace(const PlacedObject& object, const TagMap& tags) {
    const std::optional<RigidTransform> anchor = worldAnchor(object, tags);
    if (!anchor) return std::nullopt;
    return *anchor * object.T_anchor_object;
}

std::vector<std::string> leftOut(const std::vector<PlacedObject>& objects, const TagMap& tags,
                                 std::string_view shapesAlone) {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const PlacedObject& object = objects[i];
        const std::string who = fmt::format("objects[{}] is not shown: ", i);
        if (!worldPlace(object, tags))
            out.push_back(
                who +
                fmt::format("it stands on tag {} of family {}, and this tag is not in the tag map",
                            object.tag->id, info(object.tag->family).name));
        else if (object.model && !shapesAlone.empty())
            out.push_back(who +
                          fmt::format("{} is a model, but {}", object.modelName, shapesAlone));
    }
    return out;
}

std::vector<std::string> modelNotes(const std::vector<PlacedObject>& objects) {
    std::vector<std::string> out;
    std::set<const Model*> seen;
    for (const PlacedObject& object : objects)
        if (object.model && seen.insert(object.model.get()).second)
            out.insert(out.end(), object.model->notes.begin(), object.model->notes.end());
    return out;
}

std::vector<VirtualObject> placedShapes(const std::vector<PlacedObject>& objects,
                                        const TagMap& tags) {
    std::vector<VirtualObject> out;
    for (const PlacedObject& object : objects) {
        const std::optional<RigidTransform> T = worldPlace(object, tags);
        if (object.model || !T) continue;
        out.push_back(object.shape);
        out.back().T_world_object = *T;
    }
    return out;
}

}  // namespace mfar
