// From solids to groups, programs and bounds: the same set of points, held in a sphere.
#include "native_scene.h"

#include "scene/bounds.h"
#include "scene/error.h"
#include "scene/normal_form.h"

#include <functional>

namespace clucida::test {
namespace {

using scene::dot;
using scene::length;

/// A random tree of spheres, planes, cuboids and cylinders, and membership by their definitions.
struct Tree {
    SolidPtr solid;
    std::function<bool(Vec3)> holds;
};

Tree random_leaf(Random& random)
{
    const Vec3 c = random_in_box(random, 1), n = scene::unit(random_in_box(random, 1));
    const double r = uniform(random, .4, 1.2);
    switch (random() % 6) {
    case 0: return {plane(c, n * r), [=](Vec3 p) { return dot(p - c, n) < 0; }};
    case 1:
        return {cuboid(c, {r, 1, 2 * r}), [=](Vec3 p) {
                    return std::fabs(p.x - c.x) < r / 2 && std::fabs(p.y - c.y) < .5 && std::fabs(p.z - c.z) < r;
                }};
    case 2: return {solid(scene::Cylinder{c, n * r}), [=](Vec3 p) { return length(scene::cross(p - c, n)) < r; }};
    case 3:
        return {solid(scene::Cone{c, n * r}),
                [=](Vec3 p) { return length(scene::cross(p - c, n)) < std::fabs(dot(p - c, n)) / r; }};
    case 4:
        return {solid(scene::Paraboloid{c, n * r}), [=](Vec3 p) {
                    const double z = dot(p - c, n), across = length(scene::cross(p - c, n));
                    return across * across < 4 * r * z;
                }};
    default: return {sphere(c, r), [=](Vec3 p) { return length(p - c) < r; }};
    }
}

Tree transformed(Random& random, const Tree& a)
{
    const Vec3 by = random_in_box(random, 1);
    switch (random() % 3) {
    case 0: return {solid(scene::Transformed{scene::Move{by}, a.solid}), [=](Vec3 p) { return a.holds(p - by); }};
    case 1: {
        const Vec3 s{.5 + std::fabs(by.x), -.5 - std::fabs(by.y), .75};
        return {solid(scene::Transformed{scene::Scale{s}, a.solid}), [=](Vec3 p) {
                    return a.holds({p.x / s.x, p.y / s.y, p.z / s.z});
                }};
    }
    default: // right-handed about z by 90 degrees: x to y
        return {solid(scene::Transformed{scene::Rotate{{0, 0, 2}, 90}, a.solid}), [=](Vec3 p) {
                    return a.holds({p.y, -p.x, p.z});
                }};
    }
}

Tree random_tree(Random& random, int depth)
{
    if (depth == 0) return random_leaf(random);
    const Tree a = random_tree(random, depth - 1);
    const auto kind = random() % 6;
    if (kind == 0) return {complement(a.solid), [=](Vec3 p) { return !a.holds(p); }};
    if (kind == 1) return transformed(random, a);
    const Tree b = random_tree(random, static_cast<int>(random() % static_cast<unsigned>(depth)));
    if (kind < 4)
        return {solid(scene::Intersection{{a.solid, b.solid}}), [=](Vec3 p) { return a.holds(p) && b.holds(p); }};
    if (kind == 4) return {solid(scene::Union{{a.solid, b.solid}}), [=](Vec3 p) { return a.holds(p) || b.holds(p); }};
    return {solid(scene::Difference{a.solid, b.solid}), [=](Vec3 p) { return a.holds(p) && !b.holds(p); }};
}

TEST(CompileSolids, TheNormalFormHoldsThePointsThatTheTreeHolds)
{
    Random random(1);
    unsigned unsure = 0, held = 0;
    for (int i = 0; i < 2000; i++) {
        const Tree tree = random_tree(random, 1 + i % 5);
        const scene::Form form = scene::normal_form(*tree.solid);
        for (int k = 0; k < 100; k++) {
            const Vec3 p = random_in_box(random, 2.5);
            const std::optional<bool> inside = scene::holds(form, p, 1e-9);
            if (inside)
                ASSERT_EQ(*inside, tree.holds(p)) << "tree " << i;
            else
                unsure++;
            held += tree.holds(p) ? 1 : 0;
        }
    }
    EXPECT_LT(unsure, 20U);
    EXPECT_GT(held, 50000U);
}

TEST(CompileSolids, AMarginMakesPointsNearABoundaryUnsure)
{
    const scene::Form form = scene::normal_form(*sphere({0, 0, 0}, 1));
    EXPECT_EQ(scene::holds(form, {.5, 0, 0}, .25), true);
    EXPECT_EQ(scene::holds(form, {1.5, 0, 0}, .25), false);
    EXPECT_EQ(scene::holds(form, {.99, 0, 0}, .25), std::nullopt);
    EXPECT_EQ(scene::holds(form, {1.01, 0, 0}, .25), std::nullopt);
}

TEST(CompileSolids, BoundsHoldTheirSolids)
{
    Random random(2);
    unsigned bounded = 0, held = 0;
    for (int i = 0; i < 3000; i++) {
        const Tree tree = random_tree(random, 1 + i % 4);
        const scene::BoundingSphere bound = scene::bounding_sphere(scene::normal_form(*tree.solid));
        if (!(bound.radius < scene::unbounded)) continue;
        bounded++;
        for (int k = 0; k < 300; k++) {
            const Vec3 p = bound.center + random_in_box(random, 1.25 * bound.radius);
            if (!tree.holds(p)) continue;
            held++;
            ASSERT_LE(length(p - bound.center), bound.radius * (1 + 1e-9)) << "tree " << i;
        }
    }
    EXPECT_GT(bounded, 1000U);
    EXPECT_GT(held, 10000U);
}

double radius_of(const SolidPtr& s)
{
    return scene::bounding_sphere(scene::normal_form(*s)).radius;
}

SolidPtr both(std::vector<SolidPtr> of)
{
    return solid(scene::Intersection{std::move(of)});
}

TEST(CompileSolids, SolidsThatEndHaveAFiniteBound)
{
    const SolidPtr slab = both({plane({0, 0, 1}, {0, 0, 1}), plane({0, 0, -1}, {0, 0, -1})});
    const SolidPtr above = plane({0, 0, 2}, {.1, 0, 1});
    EXPECT_LT(radius_of(sphere({9, 9, 9}, 1)), 1.001);
    EXPECT_LT(radius_of(cuboid({9, 9, 9}, {2, 2, 2})), 1.001 * std::sqrt(3));
    EXPECT_LT(radius_of(solid(scene::Cuboid{{9, 9, 9}, {1, 2, 3}, {0, 1, 0}, {2, 2, 2}})), 2 * std::sqrt(3));
    EXPECT_LT(radius_of(both({solid(scene::Cylinder{{0, 0, 0}, {0, 0, .5}}), slab})), 2 * std::hypot(1, .5));
    EXPECT_LT(radius_of(both({solid(scene::Cylinder{{0, 0, 0}, {.1, 0, .5}}), slab})), 4);
    EXPECT_LT(radius_of(both({solid(scene::Cone{{0, 0, 0}, {0, 0, 2}}), slab})), 2 * std::hypot(1, .5));
    EXPECT_LT(radius_of(both({solid(scene::Paraboloid{{0, 0, 0}, {0, 0, .25}}), above})), 10);
    EXPECT_LT(radius_of(both({solid(scene::Hyperboloid{{0, 0, 0}, {0, 0, 1}, 1}), slab})), 2 * std::hypot(1, 1.5));
    EXPECT_LT(radius_of(solid(scene::Transformed{scene::Scale{{1, 2, 3}}, sphere({0, 0, 0}, 1)})), 2 * std::sqrt(14));
    // A tetrahedron, and what is cut from, joined to and turned about bounded ones.
    EXPECT_LT(radius_of(both({plane({0, 0, 0}, {-1, 0, 0}), plane({0, 0, 0}, {0, -1, 0}), plane({0, 0, 0}, {0, 0, -1}),
                              plane({1, 0, 0}, {1, 1, 1})})),
              2);
    const SolidPtr ball = sphere({0, 0, 0}, 1);
    EXPECT_LT(radius_of(solid(scene::Difference{ball, slab})), 1.001);
    EXPECT_LT(radius_of(solid(scene::Union{{ball, sphere({4, 0, 0}, 1)}})), 2 * 3);
    EXPECT_LT(radius_of(both({ball, complement(both({slab, solid(scene::Cone{{0, 0, 0}, {0, 0, 2}})}))})), 1.001);
    EXPECT_LT(radius_of(solid(scene::Transformed{scene::Rotate{{1, 2, 3}, 50}, cuboid({0, 0, 0}, {2, 2, 2})})),
              2 * std::sqrt(3));
}

TEST(CompileSolids, SolidsWithoutEndHaveNoBound)
{
    const SolidPtr slab = both({plane({0, 0, 1}, {0, 0, 1}), plane({0, 0, -1}, {0, 0, -1})});
    for (const SolidPtr& s : {plane({0, 0, 0}, {0, 0, 1}), slab, cuboid({0, 0, 0}, {1, 1, 0}),
                              complement(sphere({0, 0, 0}, 1)), solid(scene::Cylinder{{0, 0, 0}, {0, 0, 1}}),
                              both({solid(scene::Cylinder{{0, 0, 0}, {0, 0, 1}}), plane({0, 0, 0}, {0, 0, 1})}),
                              both({solid(scene::Cone{{0, 0, 0}, {0, 0, 1}}), plane({1, 0, 0}, {1, 0, 0})}),
                              solid(scene::Union{{sphere({0, 0, 0}, 1), plane({0, 0, 0}, {0, 0, 1})}}),
                              both({solid(scene::Paraboloid{{0, 0, 0}, {0, 0, 1}}), plane({1, 0, 0}, {1, 0, 0})})})
        EXPECT_FALSE(radius_of(s) < scene::unbounded);
}

/// Runs an object's program on the groups' bits; tells how deep its stack gets.
struct Outcome {
    bool inside = false;
    std::size_t deepest = 0;
};
Outcome run(const Native& scene, const LayoutObject& object, const std::function<bool(u32)>& group)
{
    const auto programs = scene.items<u32>(BUFFER_PROGRAMS);
    std::vector<bool> stack;
    Outcome result;
    for (u32 i = 0; i < object.program_count; i++) {
        const u32 op = programs[object.program_begin + i], n = op >> OP_SHIFT;
        if ((op & OP_MASK) == OP_GROUP) {
            EXPECT_LT(n, object.group_count);
            stack.push_back(group(n));
        } else {
            EXPECT_LE(n, stack.size());
            bool value = (op & OP_MASK) == OP_AND;
            for (u32 k = 0; k < n; k++) {
                value = (op & OP_MASK) == OP_AND ? value && stack.back() : value || stack.back();
                stack.pop_back();
            }
            stack.push_back(value);
        }
        result.deepest = std::max(result.deepest, stack.size());
    }
    EXPECT_EQ(stack.size(), 1U);
    result.inside = stack.back();
    return result;
}

TEST(CompileSolids, ProgramsOfAThousandLeavesStayWithinTheStackHoweverNested)
{
    Random random(3);
    const auto leaf = [&] { return sphere(random_in_box(random, 10), uniform(random, .1, 1)); };
    const auto joined = [](bool any, SolidPtr a, SolidPtr b) {
        return any ? solid(scene::Union{{std::move(a), std::move(b)}})
                   : solid(scene::Difference{std::move(a), std::move(b)});
    };
    const std::function<SolidPtr(int, bool)> balanced = [&](int depth, bool any) {
        return depth == 0 ? leaf() : joined(any, balanced(depth - 1, !any), balanced(depth - 1, !any));
    };
    SolidPtr left = leaf(), right = leaf(), zigzag = leaf();
    for (int i = 1; i < 1000; i++) {
        left = joined(i % 2, left, leaf());
        right = joined(i % 2, leaf(), right);
        zigzag = i % 4 < 2 ? joined(i % 2, zigzag, leaf()) : joined(i % 2, leaf(), zigzag);
    }
    for (const SolidPtr& s : {left, right, zigzag, balanced(9, true), balanced(9, false)}) {
        const Native scene(scene_of({s}));
        const LayoutObject& object = scene.items<LayoutObject>(BUFFER_OBJECTS)[0];
        ASSERT_GT(object.program_count, 500U);
        const Outcome result = run(scene, object, [&](u32) { return random() % 2 != 0; });
        EXPECT_LE(result.deepest, std::size_t{PROGRAM_MAX_DEPTH});
    }
}

TEST(CompileSolids, ProgramsSayWhatTheTreeSays)
{
    Random random(4);
    unsigned programs = 0;
    for (int i = 0; i < 1000; i++) {
        const Tree tree = random_tree(random, 2 + i % 4);
        const Native scene(scene_of({tree.solid}));
        const LayoutObject& object = scene.items<LayoutObject>(BUFFER_OBJECTS)[0];
        if (object.program_count == 0) continue;
        programs++;
        for (int k = 0; k < 20; k++) {
            const Vec3 p = random_in_box(random, 2.5);
            const std::vector<u32> in(tree.holds(p) ? 1 : 0, 0U);
            // A wrong interior shows as a parity fault at the start.
            Stats stats{};
            next_hit<Double>(scene, {p, {0, 0, 1}, MEMBER_NONE, false}, in, stats);
            ASSERT_EQ(stats[STAT_PARITY], 0U) << "tree " << i;
        }
    }
    EXPECT_GT(programs, 100U);
}

TEST(CompileSolids, SharedPrimitivesAreStoredOnceInAnObject)
{
    const SolidPtr a = sphere({0, 0, 0}, 1), b = sphere({1, 0, 0}, 1), c = cuboid({0, 0, 0}, {1, 1, 1});
    const SolidPtr tree = solid(scene::Union{{both({a, c}), both({complement(a), b}), both({b, complement(c)})}});
    const Native scene(scene_of({tree}));
    EXPECT_EQ(scene.compiled.objects[0].spheres, 2U);
    EXPECT_EQ(scene.compiled.objects[0].planes, 6U);
    EXPECT_EQ(scene.items<LayoutSphere>(BUFFER_SPHERES).size(), 2U);
    EXPECT_EQ(scene.items<LayoutPlane>(BUFFER_PLANES).size(), 6U);
    const auto same = scene::normal_form(*both({a, a, a}));
    EXPECT_EQ(same.kind, scene::Form::Kind::group);
    EXPECT_EQ(same.group.members.size(), 1U);
}

/// The error of compiling one solid, its place line 7.
std::string error_of(SolidPtr s, scene::Location& at)
{
    Scene scene = scene_of({std::move(s)});
    scene.objects[0].at = {7, 3};
    try {
        scene::compile(scene, {});
    } catch (const scene::Error& error) {
        at = error.at;
        return error.what();
    }
    return "";
}

TEST(CompileSolids, WhatIsTooLargeOrFlatIsAnErrorThatNamesItsPlace)
{
    Random random(5);
    scene::Location at;
    std::vector<SolidPtr> many;
    for (int i = 0; i < 1025; i++) many.push_back(sphere(random_in_box(random, 10), 1));
    EXPECT_NE(error_of(solid(scene::Union{many}), at).find("1025"), std::string::npos);
    EXPECT_EQ(at.line, 7U);
    many.pop_back();
    EXPECT_EQ(error_of(solid(scene::Union{many}), at), "");
    SolidPtr doubled = sphere({0, 0, 0}, 1);
    for (int i = 0; i < 40; i++) doubled = solid(scene::Union{{doubled, doubled}});
    EXPECT_NE(error_of(doubled, at).find("too many"), std::string::npos);
    EXPECT_EQ(at.line, 7U);
    const SolidPtr flat =
        scene::make_solid(scene::Transformed{scene::Scale{{1e-15, 1e-15, 1e-15}}, sphere({0, 0, 0}, 1)}, {9, 2});
    EXPECT_NE(error_of(flat, at).find("flattens"), std::string::npos);
    EXPECT_EQ(at.line, 9U);
    const SolidPtr nothing = scene::make_solid(scene::Cuboid{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 0}}, {4, 2});
    EXPECT_NE(error_of(nothing, at).find("boundary"), std::string::npos);
    EXPECT_EQ(at.line, 4U);
}

} // namespace
} // namespace clucida::test
