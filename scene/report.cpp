#include "scene/report.h"

#include <algorithm>
#include <span>

namespace clucida::scene {
namespace {

template <typename T>
std::span<const T> items(const Buffers& buffers, LayoutBuffer buffer)
{
    const auto& bytes = buffers.bytes[buffer];
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

/// Without what says how a group uses it: the same primitive has the same reference.
u32 primitive_of(u32 member)
{
    const u32 use = (member & MEMBER_KIND) == MEMBER_TORUS ? MEMBER_INVERSE | MEMBER_PART : MEMBER_INVERSE;
    return member & ~use;
}

void count(ObjectReport& report, u32 primitive)
{
    switch (primitive & MEMBER_KIND) {
    case MEMBER_PLANE: ++report.planes; break;
    case MEMBER_SPHERE: ++report.spheres; break;
    case MEMBER_QUADRIC: ++report.quadrics; break;
    default: ++report.tori;
    }
}

} // namespace

std::vector<ObjectReport> report_objects(const Scene& scene, const Buffers& buffers)
{
    const auto objects = items<LayoutObject>(buffers, BUFFER_OBJECTS);
    const auto groups = items<LayoutGroup>(buffers, BUFFER_GROUPS);
    const auto members = items<u32>(buffers, BUFFER_MEMBERS);
    std::vector<ObjectReport> out;
    out.reserve(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const LayoutObject& object = objects[i];
        ObjectReport report;
        report.name = scene.objects[i].name;
        report.groups = object.group_count;
        report.program = object.program_count;
        report.radius = object.radius;

        std::vector<u32> primitives;
        std::size_t blocks = 0;
        for (const LayoutGroup& group : groups.subspan(object.group_begin, object.group_count)) {
            for (const u32 member : members.subspan(group.begin, group.count))
                primitives.push_back(primitive_of(member));
            blocks += group.block_count;
        }
        report.bytes = sizeof(LayoutObject) + report.groups * sizeof(LayoutGroup) + blocks * sizeof(LayoutPlaneBlock) +
                       (primitives.size() + report.program) * sizeof(u32);
        std::ranges::sort(primitives);
        primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
        for (const u32 primitive : primitives) count(report, primitive);
        report.bytes += report.planes * sizeof(LayoutPlane) + report.spheres * sizeof(LayoutSphere) +
                        report.quadrics * sizeof(LayoutQuadric) + report.tori * sizeof(LayoutTorus);
        out.push_back(std::move(report));
    }
    return out;
}

} // namespace clucida::scene
