#include "daemon/pose_config.h"

#include "base/calibration/plausible_ranges.h"
#include "daemon/exit_code.h"
#include "daemon/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace mfar {
namespace {

constexpr std::array<std::pair<std::string_view, PoseOrigin>, 3> kOrigins = {
    {{"tags", PoseOrigin::Tags}, {"recorded", PoseOrigin::Recorded}, {"none", PoseOrigin::None}}};

std::optional<std::string> familyFault(std::string_view family) {
    if (tagFamilyNamed(family)) return std::nullopt;
    std::string known;
    for (const TagFamilyInfo& one : kTagFamilies)
        known.append(known.empty() ? "\"" : ", \"").append(one.name).append("\"");
    return "must be one of " + known;
}

std::optional<std::string> decimationFault(double value) {
    if (value == 1.5 || value == std::round(value)) return std::nullopt;
    return "must be 1.5 or a whole number";
}

}  // namespace

void readPose(TomlReader& file, PoseConfig& pose) {
    file.choice<PoseOrigin>("pose.source", pose.source, kOrigins);
    std::string tags;
    file.text("pose.tags", tags);
    pose.tags = tags;
    std::vector<std::string> families;
    file.texts("pose.families", families, familyFault);
    if (!families.empty()) pose.families.clear();
    for (const std::string& name : families) {
        const TagFamily family = tagFamilyNamed(name).value();
        if (std::find(pose.families.begin(), pose.families.end(), family) == pose.families.end())
            pose.families.push_back(family);
    }
    file.number("pose.tag_size", pose.tagSize);
    file.number("pose.decimation", pose.decimation, decimationFault);
    file.integer("pose.threads", pose.threads);
    file.integer("pose.full_search_interval", pose.fullSearchInterval);
    file.integer("pose.bridge_frames", pose.bridgeFrames);
}

std::optional<PoseOrigin> poseOrigin(std::string_view word) {
    for (const auto& [name, origin] : kOrigins)
        if (name == word) return origin;
    return std::nullopt;
}

TagMap readTagMap(const std::filesystem::path& file, TagFamily ofRosMap) {
    std::error_code ignored;
    const bool there = std::filesystem::exists(file, ignored);
    return orFail<TagMapError>(there ? ExitCode::BadData : ExitCode::NoInput,
                               [&] { return loadTagMap(file, ofRosMap); });
}

TagMap configuredTags(const PoseConfig& pose) {
    // The map is read even with recorded poses, because objects on tags need it.
    if (pose.source == PoseOrigin::None || pose.tags.empty()) return {};
    if (isRosTagMap(pose.tags) && pose.families.size() != 1)
        throw Failure(ExitCode::BadData,
                      fmt::format("{}: the file does not name the family of its tags, so families "
                                  "in [pose] must name exactly one family",
                                  pose.tags.string()));
    return readTagMap(pose.tags, pose.families.front());
}

TrackerOptions trackerOptions(const PoseConfig& pose, TagMap map, double rateHz) {
    TrackerOptions out;
    out.map = std::move(map);
    out.families = pose.families;
    out.tagSize = pose.tagSize;
    out.decimation = pose.decimation;
    out.threads = pose.threads;
    out.fullSearchInterval = pose.fullSearchInterval;
    PoseFilterOptions& filter = out.pose.filter;
    filter.bridgeFrames = pose.bridgeFrames;
    // The tracker limits predictions by a number of frames and by a time. Only the number of frames
    // is meant to matter, so the time limit must be long enough for that number. Half a frame
    // interval is added, because stills are exposed between two frames.
    if (rateHz > 0) {
        const std::chrono::duration<double> frames((pose.bridgeFrames + 0.5) / rateHz);
        filter.bridge =
            std::max(filter.bridge, std::chrono::duration_cast<std::chrono::nanoseconds>(frames));
    }
    return out;
}

}  // namespace mfar
