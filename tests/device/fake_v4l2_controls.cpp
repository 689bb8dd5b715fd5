#include "tests/device/fake_v4l2.h"

#include <algorithm>
#include <cerrno>

namespace mfar::test {

int FakeV4l2::knobs(unsigned long request, void* argument) {
    if (request == VIDIOC_QUERY_EXT_CTRL) {
        auto& query = *static_cast<v4l2_query_ext_ctrl*>(argument);
        const std::uint32_t after =
            query.id & ~(V4L2_CTRL_FLAG_NEXT_CTRL | V4L2_CTRL_FLAG_NEXT_COMPOUND);
        for (const FakeControl& c : controls) {
            if (c.id <= after) continue;
            query = {};
            query.id = c.id;
            query.type = c.type;
            putText(query.name, sizeof query.name, c.name);
            query.minimum = c.minimum;
            query.maximum = c.maximum;
            query.step = static_cast<std::uint64_t>(c.step);
            query.default_value = c.value;
            query.flags = c.flags;
            return 0;
        }
        return EINVAL;
    }
    if (request == VIDIOC_QUERYMENU) {
        auto& query = *static_cast<v4l2_querymenu*>(argument);
        for (const FakeControl& c : controls)
            if (c.id == query.id && query.index < c.menu.size() && !c.menu[query.index].empty()) {
                putText(query.name, sizeof query.name, c.menu[query.index]);
                return 0;
            }
        return EINVAL;
    }
    return value(request, *static_cast<v4l2_ext_controls*>(argument)->controls);
}

int FakeV4l2::value(unsigned long request, v4l2_ext_control& one) {
    for (FakeControl& c : controls) {
        if (c.id != one.id) continue;
        const bool wide = c.type == V4L2_CTRL_TYPE_INTEGER64;
        if (c.isUnreadable && request != VIDIOC_S_EXT_CTRLS) return EIO;
        if (request == VIDIOC_S_EXT_CTRLS) {
            if ((c.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0) return EACCES;
            if (c.refusals > 0) {
                --c.refusals;
                return c.error;
            }
            const std::int64_t asked = wide ? std::int64_t{one.value64} : one.value;
            c.value = c.minimum + (asked - c.minimum) / std::max<std::int64_t>(c.step, 1) * c.step;
        }
        if (wide)
            one.value64 = c.value;
        else
            one.value = static_cast<std::int32_t>(c.value);
        return 0;
    }
    return EINVAL;
}

}  // namespace mfar::test
