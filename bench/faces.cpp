#include "bench/faces.h"

#include "scene/linear.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace clucida::bench {
namespace {

using scene::Vec3;

template <typename T>
const T& item(const scene::Compiled& compiled, LayoutBuffer buffer, std::size_t index)
{
    return reinterpret_cast<const T*>(compiled.buffers.bytes[buffer].data())[index];
}

Vec3 vec(const float* v)
{
    return {v[0], v[1], v[2]};
}

/// The primitive's function at p, relative to the object's centre.
double value(const scene::Compiled& compiled, u32 member, Vec3 p)
{
    const u32 index = member >> MEMBER_SHIFT;
    switch (member & MEMBER_KIND) {
    case MEMBER_PLANE: {
        const auto& plane = item<LayoutPlane>(compiled, BUFFER_PLANES, index);
        return dot(vec(plane.n), p) - plane.h;
    }
    case MEMBER_SPHERE: {
        const auto& ball = item<LayoutSphere>(compiled, BUFFER_SPHERES, index);
        const Vec3 x = p - vec(ball.c);
        return dot(x, x) - double{ball.r} * ball.r;
    }
    case MEMBER_TORUS: {
        const auto& ring = item<LayoutTorus>(compiled, BUFFER_TORI, index >> 1);
        const Vec3 x = p - vec(ring.c), axis = unit(vec(ring.axis));
        const double along = dot(x, axis), major = double{ring.major} * ring.major;
        const double sum = dot(x, x) + major - double{ring.minor} * ring.minor;
        return sum * sum - 4 * major * (dot(x, x) - along * along);
    }
    default: {
        const auto& q = item<LayoutQuadric>(compiled, BUFFER_QUADRICS, index);
        const Vec3 v = p - vec(q.c);
        const Vec3 x{dot(vec(q.m), v), dot(vec(q.m + 3), v), dot(vec(q.m + 6), v)};
        return q.s[0] * x.x * x.x + q.s[1] * x.y * x.y + q.s[2] * x.z * x.z - 2 * q.g * x.z + q.w;
    }
    }
}

using Sample = std::vector<double>;

/// Values at the same points, scaled to length 1, without the sign.
Sample sample(const std::function<double(Vec3)>& f, const std::vector<Vec3>& points)
{
    Sample out;
    double squares = 0;
    for (const Vec3& p : points) {
        out.push_back(f(p));
        squares += out.back() * out.back();
    }
    for (double& v : out) v /= std::sqrt(squares);
    return out;
}

/// Squared distance of two samples whose sign does not matter.
double apart(const Sample& a, const Sample& b)
{
    double plus = 0, minus = 0;
    for (std::size_t i = 0; i < a.size(); i++) {
        plus += (a[i] - b[i]) * (a[i] - b[i]);
        minus += (a[i] + b[i]) * (a[i] + b[i]);
    }
    return std::min(plus, minus);
}

/// Points about the object, as far out as it is large.
std::vector<Vec3> points_about(const LayoutObject& object, Vec3 center)
{
    const double size = std::isfinite(object.radius) ? object.radius : std::isfinite(object.near) ? object.near : 1;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> within(-1, 1);
    std::vector<Vec3> out(24);
    for (Vec3& p : out) p = center + Vec3{within(random), within(random), within(random)} * std::max(size, 1e-6);
    return out;
}

u32 nearest(const Sample& sample, const std::vector<Sample>& among)
{
    std::size_t best = 0;
    for (std::size_t i = 1; i < among.size(); i++)
        if (apart(sample, among[i]) < apart(sample, among[best])) best = i;
    return static_cast<u32>(best);
}

FaceNames::OfObject match(const scene::Compiled& compiled, const LayoutObject& object, Vec3 eye,
                          const std::vector<oracle::Face>& faces)
{
    constexpr double same = 1e-20; // squared: a face written twice, up to the rounding of double
    const Vec3 center = vec(object.center) + eye;
    const std::vector<Vec3> points = points_about(object, center);
    std::vector<Sample> samples;
    FaceNames::OfObject out;
    for (const oracle::Face& face : faces) {
        samples.push_back(sample(face.value, points));
        u32 first = 0;
        while (apart(samples[first], samples.back()) > same) first++;
        out.of_oracle.push_back(first);
    }
    for (u32 g = 0; g < object.group_count; g++) {
        const auto& group = item<LayoutGroup>(compiled, BUFFER_GROUPS, object.group_begin + g);
        for (u32 m = 0; m < group.count; m++) {
            u32 member = item<u32>(compiled, BUFFER_MEMBERS, group.begin + m) & ~MEMBER_INVERSE;
            if ((member & MEMBER_KIND) == MEMBER_TORUS) member &= ~MEMBER_PART;
            if (out.of_kernel.contains(member)) continue;
            const auto f = [&, member](Vec3 p) { return value(compiled, member, p - center); };
            out.of_kernel[member] = out.of_oracle[nearest(sample(f, points), samples)];
        }
    }
    return out;
}

} // namespace

std::vector<oracle::Event> FaceNames::kernel(std::span<const LayoutEvent> events) const
{
    std::vector<oracle::Event> out;
    out.reserve(events.size());
    for (const LayoutEvent& e : events) {
        const u32 face = e.object == EVENT_NONE ? EVENT_NONE : objects.at(e.object).of_kernel.at(e.face);
        out.push_back({e.hop, e.object, face, e.what, e.lights});
    }
    return out;
}

std::vector<oracle::Event> FaceNames::oracle(std::span<const oracle::Event> events) const
{
    std::vector<oracle::Event> out(events.begin(), events.end());
    for (oracle::Event& e : out)
        if (e.object != EVENT_NONE) e.face = objects.at(e.object).of_oracle.at(e.face);
    return out;
}

FaceNames match_faces(const scene::Scene& scene, const scene::Compiled& compiled)
{
    const std::vector<std::vector<oracle::Face>> faces = oracle::faces(scene);
    FaceNames out;
    for (std::size_t id = 0; id < faces.size(); id++)
        out.objects.push_back(
            match(compiled, item<LayoutObject>(compiled, BUFFER_OBJECTS, id), scene::eye_of(scene), faces[id]));
    return out;
}

} // namespace clucida::bench
