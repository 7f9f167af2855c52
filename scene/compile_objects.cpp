#include "scene/compile_objects.h"

#include "scene/bounds.h"
#include "scene/error.h"
#include "scene/normal_form.h"
#include "scene/store.h"

#include <algorithm>
#include <array>
#include <span>

namespace clucida::scene {
namespace {

/// A block costs about as much as so many planes one by one.
constexpr std::ptrdiff_t least_block = 3;
/// Bounds are widened by this for the rounding of float.
constexpr double bound_margin = 1e-5;
/// Of a box, as a part of its distance from the eye: 16 roundings, of which a ray's start takes 8.
constexpr double rounding_margin = 1e-6;
/// A bound of more than so many times the parts' size does not make the object's centre.
constexpr double most_parts = 8;

/// Where an unbounded solid's own frame has its origin.
Vec3 anchor(const Form& form, Vec3 eye)
{
    if (form.kind != Form::Kind::group) return anchor(form.parts[0], eye);
    const Member& member = form.group.members[0];
    if (const auto* plane = std::get_if<HalfSpace>(&member)) return eye - plane->n * (dot(plane->n, eye) - plane->h);
    if (const auto* ball = std::get_if<Ball>(&member)) return ball->c;
    if (const auto* ring = std::get_if<Ring>(&member)) return ring->c;
    return std::get<Quadric>(member).c;
}

/// How large an unbounded solid's parts are, with their distance from the centre: of a curved part its radius, of a
/// plane how far from the eye it passes.
double size_of_parts(const Form& form, Vec3 center, Vec3 eye)
{
    double size = 0;
    for (const Form& part : form.parts) size = std::max(size, size_of_parts(part, center, eye));
    for (const Member& member : form.group.members) {
        if (const auto* plane = std::get_if<HalfSpace>(&member)) {
            size = std::max(size, std::fabs(dot(plane->n, eye) - plane->h));
        } else if (const auto* ball = std::get_if<Ball>(&member)) {
            size = std::max(size, length(ball->c - center) + ball->r);
        } else if (const auto* q = std::get_if<Quadric>(&member)) {
            double finest = 0;
            for (const Vec3& row : q->m.rows) finest = std::max(finest, length(row));
            const bool any_size = q->g == 0 && q->w == 0; // a cone looks the same from near and far
            size = std::max(size, length(q->c - center) + (any_size ? 0 : 1 / finest));
        } else if (const auto* ring = std::get_if<Ring>(&member)) {
            size = std::max(size, length(ring->c - center) + ring->major + ring->minor);
        }
    }
    return size;
}

/// A cylinder's frame may stand anywhere on its axis: nearest to the centre it is stored the most exactly.
Vec3 frame_origin(const Quadric& q, Vec3 center)
{
    if (q.s.z != 0 || q.g != 0) return q.c;
    const Vec3 axis = unit(cross(q.m.rows[0], q.m.rows[1]));
    return q.c + axis * dot(axis, center - q.c);
}

/// No less than the greatest of the matrix's singular values: |m|_2^2 <= |m|_1 |m|_inf.
double norm_bound(const Mat3& m)
{
    double rows = 0, columns = 0;
    for (int i = 0; i < 3; i++) {
        double row = 0, column = 0;
        for (int j = 0; j < 3; j++) {
            row += std::fabs(component(m.rows[static_cast<std::size_t>(i)], j));
            column += std::fabs(component(m.rows[static_cast<std::size_t>(j)], i));
        }
        rows = std::max(rows, row);
        columns = std::max(columns, column);
    }
    return std::sqrt(rows * columns);
}

/// Whether two members are the same primitive, parts of one torus included.
bool same_primitive(const Member& a, const Member& b)
{
    const auto* x = std::get_if<Ring>(&a);
    const auto* y = std::get_if<Ring>(&b);
    if (x == nullptr || y == nullptr) return a == b;
    return x->c == y->c && x->axis == y->axis && x->major == y->major && x->minor == y->minor;
}

/// Whether the bound's centre serves as the object's. A paraboloid that a plane cuts off only far away is bounded, but
/// numbers relative to the middle of that would lose what is seen of it from here.
bool is_compact(const Form& form, const BoundingSphere& bound, Vec3 eye)
{
    return bound.radius < unbounded && bound.radius <= most_parts * size_of_parts(form, anchor(form, eye), eye);
}

/// Writes one object's form behind those that are there already.
class ObjectWriter {
public:
    /// reach: the radius of the object's bound.
    ObjectWriter(ObjectBuffers& buffers, Vec3 center, double reach) : out(buffers), center(center), reach(reach) {}

    void write(const Form& form, LayoutObject& object)
    {
        object.group_begin = static_cast<u32>(out.groups.size());
        object.program_begin = static_cast<u32>(out.programs.size());
        if (form.kind == Form::Kind::group) {
            add_group(form.group);
        } else if (form.kind == Form::Kind::all && is_flat(form)) {
            for (const Form& part : form.parts) add_group(part.group);
        } else {
            add_program(form);
            object.form = is_flat(form) ? FORM_ANY : FORM_PROGRAM;
        }
        object.group_count = static_cast<u32>(out.groups.size()) - object.group_begin;
        object.program_count = static_cast<u32>(out.programs.size()) - object.program_begin;
        object.sole = sole_member(object);
        object.grain = static_cast<float>(grain);
    }

private:
    static bool is_flat(const Form& form)
    {
        return std::ranges::all_of(form.parts, [](const Form& p) { return p.kind == Form::Kind::group; });
    }

    /// In a scene of many objects each buffer that is looked into is a line fetched from memory, one after the other.
    u32 sole_member(const LayoutObject& object) const
    {
        if (object.group_count != 1 || object.program_count != 0) return MEMBER_NONE;
        const LayoutGroup& group = out.groups[object.group_begin];
        return group.count == 1 && group.inverse == 0 ? out.members[group.begin] : MEMBER_NONE;
    }

    u32 add_group(const Group& group)
    {
        LayoutGroup g{};
        g.begin = static_cast<u32>(out.members.size());
        g.count = static_cast<u32>(group.members.size());
        g.block_begin = static_cast<u32>(out.blocks.size());
        g.inverse = group.inverse ? 1 : 0;
        // Cheap members first, planes last if there are enough for a block: spheres, planes, quadrics, tori.
        const auto planes_of_group =
            std::ranges::count_if(group.members, [](const Member& m) { return std::holds_alternative<HalfSpace>(m); });
        const bool in_blocks = planes_of_group >= least_block;
        const std::array<std::size_t, 4> order =
            in_blocks ? std::array<std::size_t, 4>{1, 2, 3, 0} : std::array<std::size_t, 4>{1, 0, 2, 3};
        for (const std::size_t kind : order)
            for (const Member& member : group.members)
                if (member.index() == kind) out.members.push_back(reference(member));
        pair_planes(std::span(out.members).subspan(g.begin));
        g.single = g.count - (in_blocks ? static_cast<u32>(planes_of_group) : 0);
        for (u32 i = g.single; i < g.count; i += PLANE_BLOCK)
            add_block(std::span(out.members).subspan(g.begin + i, std::min<u32>(PLANE_BLOCK, g.count - i)));
        g.block_count = static_cast<u32>(out.blocks.size()) - g.block_begin;
        out.groups.push_back(g);
        return groups_of_this++;
    }

    /// Opposite planes side by side, and before all other planes: packets take two at once (kernels/packets/spans.h).
    void pair_planes(std::span<u32> members) const
    {
        const auto is_plane = [](u32 m) { return (m & MEMBER_KIND) == MEMBER_PLANE; };
        const auto opposite = [&](u32 a, u32 b) {
            const LayoutPlane &p = out.planes[a >> MEMBER_SHIFT], &q = out.planes[b >> MEMBER_SHIFT];
            return p.n[0] == -q.n[0] && p.n[1] == -q.n[1] && p.n[2] == -q.n[2];
        };
        auto next = std::ranges::find_if(members, is_plane);
        const auto end = std::find_if_not(next, members.end(), is_plane);
        for (auto first = next; first != end; ++first) {
            const auto second = std::find_if(first + 1, end, [&](u32 m) { return opposite(*first, m); });
            if (second == end) continue;
            std::rotate(next, first, first + 1);
            std::rotate(next + 1, second, second + 1);
            next += 2;
            first = next - 1;
        }
    }

    void add_block(std::span<const u32> members)
    {
        LayoutPlaneBlock block{};
        for (std::size_t lane = 0; lane < PLANE_BLOCK; lane++) {
            block.h[lane] = 1e30F; // n stays 0: all of space
            block.plane[lane] = PLANE_NONE;
            if (lane >= members.size()) continue;
            const u32 index = members[lane] >> MEMBER_SHIFT;
            const LayoutPlane& plane = out.planes[index];
            for (std::size_t axis = 0; axis < 3; axis++) block.n[axis][lane] = plane.n[axis];
            block.h[lane] = plane.h;
            block.plane[lane] = index;
        }
        out.blocks.push_back(block);
    }

    /// Reverse Polish order, the deepest part first, so that the stack of bits stays as low as the logarithm.
    void add_program(const Form& form)
    {
        if (form.kind == Form::Kind::group) {
            const u32 group = add_group(form.group);
            out.programs.push_back(OP_GROUP | group << OP_SHIFT);
            return;
        }
        std::vector<const Form*> parts;
        for (const Form& part : form.parts) parts.push_back(&part);
        std::ranges::stable_sort(parts, [](const Form* a, const Form* b) { return depth(*a) > depth(*b); });
        const u32 op = form.kind == Form::Kind::all ? OP_AND : OP_OR;
        for (std::size_t i = 0; i < parts.size(); i++) {
            add_program(*parts[i]);
            if (i > 0) out.programs.push_back(op | 2u << OP_SHIFT);
        }
    }

    /// How many bits the form's program stacks up.
    static unsigned depth(const Form& form)
    {
        if (form.kind == Form::Kind::group) return 1;
        std::vector<unsigned> depths;
        for (const Form& part : form.parts) depths.push_back(depth(part));
        std::ranges::sort(depths, std::greater{});
        return std::max(depths[0], depths.size() > 1 ? depths[1] + 1 : 0);
    }

    /// A member that the object has already keeps its reference, so that a ray knows it when it leaves it.
    u32 reference(const Member& member)
    {
        const auto* ring = std::get_if<Ring>(&member);
        const u32 part = ring != nullptr && ring->part != 0 ? MEMBER_PART : 0;
        for (const auto& [known, known_reference] : known_members)
            if (same_primitive(*known, member)) return known_reference | part;
        const u32 r = std::visit([&](const auto& m) { return store_member(m); }, member);
        known_members.emplace_back(&member, r);
        return r | part;
    }

    u32 store_member(const HalfSpace& plane)
    {
        LayoutPlane p{};
        store(p.n, plane.n);
        p.h = static_cast<float>(plane.h - dot(plane.n, center));
        out.planes.push_back(p);
        grain = std::max(grain, std::min(std::fabs(double{p.h}), reach));
        out.features |= feature_plane;
        return MEMBER_PLANE | static_cast<u32>(out.planes.size() - 1) << MEMBER_SHIFT;
    }

    u32 store_member(const Ball& ball)
    {
        LayoutSphere s{};
        store(s.c, ball.c - center);
        s.r = static_cast<float>(ball.r);
        out.spheres.push_back(s);
        grain = std::max(grain, length(ball.c - center) + ball.r);
        out.features |= feature_sphere;
        return MEMBER_SPHERE | static_cast<u32>(out.spheres.size() - 1) << MEMBER_SHIFT;
    }

    u32 store_member(const Quadric& quadric)
    {
        LayoutQuadric q{};
        const Vec3 origin = frame_origin(quadric, center);
        store(q.c, origin - center);
        for (std::size_t i = 0; i < 3; i++) store(q.m + 3 * i, quadric.m.rows[i]);
        store(q.s, quadric.s);
        q.g = static_cast<float>(quadric.g);
        q.w = static_cast<float>(quadric.w);
        q.norm = static_cast<float>(norm_bound(quadric.m));
        out.quadrics.push_back(q);
        grain = std::max(grain, length(origin - center));
        out.features |= feature_quadric;
        return MEMBER_QUADRIC | static_cast<u32>(out.quadrics.size() - 1) << MEMBER_SHIFT;
    }

    u32 store_member(const Ring& ring)
    {
        LayoutTorus t{};
        store(t.c, ring.c - center);
        store(t.axis, ring.axis);
        t.major = static_cast<float>(ring.major);
        t.minor = static_cast<float>(ring.minor);
        out.tori.push_back(t);
        grain = std::max(grain, length(ring.c - center) + ring.major + ring.minor);
        out.features |= feature_torus;
        return MEMBER_TORUS | static_cast<u32>(out.tori.size() - 1) << (MEMBER_SHIFT + 1);
    }

    ObjectBuffers& out;
    Vec3 center;
    double reach, grain = 0;
    u32 groups_of_this = 0;
    std::vector<std::pair<const Member*, u32>> known_members;
};

/// The box relative to the eye, wide enough for what rounding does to rays that start on the object or pass by.
FloatBox stored_box(const Box& box, Vec3 eye)
{
    FloatBox out;
    const Vec3 low = box.low - eye, high = box.high - eye;
    const double margin = bound_margin * length(high - low) + rounding_margin * std::max(length(low), length(high));
    for (int axis = 0; axis < 3; axis++) {
        const double a = component(low, axis), b = component(high, axis);
        out.low[axis] = static_cast<float>(std::isfinite(a) ? a - margin : a);
        out.high[axis] = static_cast<float>(std::isfinite(b) ? b + margin : b);
    }
    return out;
}

/// No point lies in more of the intervals than are open at once anywhere.
std::size_t most_open(std::vector<double> lows, std::vector<double> highs)
{
    std::ranges::sort(lows);
    std::ranges::sort(highs);
    std::size_t most = 0, ended = 0;
    for (std::size_t begun = 0; begun < lows.size(); begun++) {
        while (highs[ended] < lows[begun]) ended++;
        most = std::max(most, begun + 1 - ended);
    }
    return most;
}

std::size_t most_overlapping(const std::vector<LayoutObject>& objects)
{
    std::size_t most = objects.size();
    for (int axis = 0; axis < 3; axis++) {
        std::vector<double> lows, highs;
        lows.reserve(objects.size());
        highs.reserve(objects.size());
        for (const LayoutObject& o : objects) {
            lows.push_back(static_cast<double>(o.center[axis]) - o.radius);
            highs.push_back(static_cast<double>(o.center[axis]) + o.radius);
        }
        most = std::min(most, most_open(std::move(lows), std::move(highs)));
    }
    return std::max<std::size_t>(most, 1);
}

void check_sizes(const Object& object, const ObjectBuffers& out)
{
    const auto& last = out.objects.back();
    if (last.group_count > most_groups_of_object)
        throw Error(object.at, "this solid joins " + std::to_string(last.group_count) + " parts; expected at most " +
                                   std::to_string(most_groups_of_object) + ": make it several objects");
}

} // namespace

ObjectBuffers compile_objects(const Scene& scene, Vec3 eye, double start_radius)
{
    ObjectBuffers out;
    out.objects.reserve(scene.objects.size());
    out.boxes.reserve(scene.objects.size());
    out.groups.reserve(scene.objects.size()); // one each at least, as of members
    out.members.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        if (expanded_members(*object.solid, most_members_of_object + 1) > most_members_of_object)
            throw Error(object.at,
                        "this solid has too many members; expected at most " + std::to_string(most_members_of_object));
        const Form form = normal_form(*object.solid);
        const auto [bound, box] = bounds_of(form);
        const bool compact = is_compact(form, bound, eye);
        // The centre is what float keeps of it: all else in the object is relative to that.
        const Vec3 center = rounded((compact ? bound.center : anchor(form, eye)) - eye) + eye;

        LayoutObject layout{};
        store(layout.center, center - eye);
        const double radius = (bound.radius + length(bound.center - center)) * (1 + bound_margin);
        layout.radius = static_cast<float>(radius);
        layout.near = static_cast<float>(compact ? 1.5 * radius : 1.1 * size_of_parts(form, center, eye));
        layout.optics = static_cast<u32>(object.optics);
        layout.texture = object.texture ? static_cast<u32>(*object.texture) : TEXTURE_NONE;
        ObjectWriter(out, center, radius).write(form, layout);
        if (layout.program_count > 0) out.features |= feature_program;
        if (layout.program_count > 0 || layout.group_count > 1) out.features |= feature_groups;
        out.most_groups = std::max<std::size_t>(out.most_groups, layout.group_count);
        const double margin = start_radius + 1e-5 * (start_radius + length(eye - center));
        if (length(eye - center) <= radius + margin && holds(form, eye, margin).value_or(true)) out.starts++;
        out.objects.push_back(layout);
        out.boxes.push_back(stored_box(box, eye));
        check_sizes(object, out);
    }
    out.most_overlapping = most_overlapping(out.objects);
    return out;
}

} // namespace clucida::scene
