#include "base/toml_bounds.h"
#include "base/toml_fault.h"
#include "pipeline/track/tag_map.h"
#include "pipeline/track/tag_map_faults.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>

namespace mfar {
namespace {

class Reader {
public:
    Reader(std::string_view text, const std::string& file) : file_(file) {
        if (const auto excess = tomlExcess(text))
            tagMapFault(file, static_cast<int>(excess->line), excess->what);
        try {
            root_ = toml::parse(text, file);
        } catch (const toml::parse_error& error) {
            tagMapFault(file, static_cast<int>(error.source().begin.line),
                        tomlFault(error.description()));
        }
    }

    TagMap read() {
        refuseUnknown(root_, {"family", "tags"});
        const toml::node* list = root_.get("tags");
        if (list == nullptr) tagMapFault(file_, 0, "the map has no [[tags]]");
        if (!list->is_array()) fail(*list, "tags must be a list [[tags]]");
        std::vector<MappedTag> tags;
        for (const toml::node& node : *list->as_array()) {
            if (!node.is_table()) fail(node, "a tag must be a section [[tags]]");
            const toml::table& tag = *node.as_table();
            const RawTag raw = readTag(tag);
            if (const auto wrong = wrongWith(raw, seen_)) fail(get(tag, wrong->key), wrong->what);
            tags.push_back(mapped(raw));
        }
        if (tags.empty()) fail(*list, "the map has no tag");
        return TagMap(tags);
    }

private:
    [[noreturn]] void fail(const toml::node& at, const std::string& what) const {
        tagMapFault(file_, static_cast<int>(at.source().begin.line), what);
    }

    void refuseUnknown(const toml::table& table,
                       std::initializer_list<std::string_view> known) const {
        for (const auto& [key, value] : table)
            if (std::find(known.begin(), known.end(), key.str()) == known.end())
                tagMapFault(file_, static_cast<int>(key.source().begin.line),
                            fmt::format("unknown key {}; expected one of {}", key.str(),
                                        fmt::join(known, ", ")));
    }

    [[nodiscard]] const toml::node& get(const toml::table& table, std::string_view key) const {
        const toml::node* node = table.get(key);
        if (node == nullptr) fail(table, fmt::format("a tag has no key {}", key));
        return *node;
    }

    [[nodiscard]] double number(const toml::node& node, std::string_view key) const {
        // toml++ does not return an integer above 2^53 as double.
        const auto whole = node.value_exact<std::int64_t>();
        const auto value = whole ? static_cast<double>(*whole) : node.value_exact<double>();
        if (!value || !std::isfinite(*value))
            fail(node, fmt::format("{} must be a finite number", key));
        return *value;
    }

    template <int N>
    [[nodiscard]] Eigen::Matrix<double, N, 1> numbers(const toml::table& table,
                                                      std::string_view key) const {
        const toml::node& node = get(table, key);
        const toml::array* list = node.as_array();
        if (list == nullptr || list->size() != N)
            fail(node, fmt::format("{} must be a list of {} numbers", key, N));
        Eigen::Matrix<double, N, 1> out;
        for (int i = 0; i < N; ++i)
            out(i) = number(*list->get(static_cast<std::size_t>(i)), key);
        return out;
    }

    [[nodiscard]] TagFamily family(const toml::table& tag) const {
        const toml::node* node = tag.get("family");
        if (node == nullptr) node = root_.get("family");
        if (node == nullptr) fail(tag, "neither this tag nor the file has the key \"family\"");
        const auto name = node->value<std::string>();
        const auto out = name ? tagFamilyNamed(*name) : std::nullopt;
        if (!out)
            fail(*node, "family must be one of \"tag36h11\", \"tag25h9\", \"tag16h5\", "
                        "\"tagStandard41h12\"");
        return *out;
    }

    [[nodiscard]] RawTag readTag(const toml::table& tag) const {
        refuseUnknown(tag, {"id", "size", "position", "orientation", "family"});
        RawTag out;
        out.family = family(tag);
        const toml::node& id = get(tag, "id");
        if (!id.is_integer()) fail(id, "id must be a whole number");
        out.id = id.value<std::int64_t>().value();
        out.size = number(get(tag, "size"), "size");
        out.position = numbers<3>(tag, "position");
        out.wxyz = numbers<4>(tag, "orientation");
        return out;
    }

    const std::string& file_;
    toml::table root_;
    std::set<TagKey> seen_;
};

}  // namespace

TagMap tagMapFromToml(std::string_view text, const std::string& file) {
    return Reader(text, file).read();
}

std::string tomlOf(const TagMap& map) {
    std::string out =
        "# Tags and their poses in the world: position [m], orientation (quaternion w, "
        "x, y, z).\n"
        "# Tag coordinates: origin in the middle, x right, y down, z into the surface. "
        "size: edge of\n"
        "# the square between the corners [m].\n";
    for (const auto& [key, tag] : map.tags()) {
        const Eigen::Vector3d& p = tag.T_world_tag.translation;
        const Eigen::Quaterniond& q = tag.T_world_tag.rotation;
        fmt::format_to(std::back_inserter(out),
                       "\n[[tags]]\nfamily = \"{}\"\nid = {}\nsize = {}\n"
                       "position = [{:.9f}, {:.9f}, {:.9f}]\n"
                       "orientation = [{:.9f}, {:.9f}, {:.9f}, {:.9f}]\n",
                       info(key.family).name, key.id, tag.size, p.x(), p.y(), p.z(), q.w(), q.x(),
                       q.y(), q.z());
    }
    return out;
}

}  // namespace mfar
